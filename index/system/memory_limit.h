// How much memory this process may have.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace isochron::index {

/// [bytes] the machine's memory, or less if a control group (version 1 or 2) or a resource limit is
/// lower. @param root folder that holds `proc` and `sys`, for tests
std::uint64_t memory_limit(const std::filesystem::path& root = "/");

/// [bytes] of address space that this process may still use; without a limit (`ulimit -v`), all.
std::uint64_t addresses_left();

/// What a user is told where memory ends: that there is not enough, and the limit if one is set.
std::string shortage_of_memory();

} // namespace isochron::index
