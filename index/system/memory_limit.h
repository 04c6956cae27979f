// How much memory this process may have.
#pragma once

#include <cstdint>
#include <filesystem>

namespace isochron::index {

/// Bytes: the machine's memory, or less where a control group (version 1 or 2) or a resource limit
/// says so. @param root where `proc` and `sys` are, for tests
std::uint64_t memory_limit(const std::filesystem::path& root = "/");

} // namespace isochron::index
