// How much memory this process may have.
#pragma once

#include <cstdint>
#include <filesystem>

namespace isochron::index {

/// [bytes] the machine's memory, or less if a control group (version 1 or 2) or a resource limit is
/// lower. @param root folder that holds `proc` and `sys`, for tests
std::uint64_t memory_limit(const std::filesystem::path& root = "/");

} // namespace isochron::index
