// Files that a folder of a cache keeps for later.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>

namespace isochron::index {

/// How much a folder keeps.
struct KeptMost {
    std::uint64_t bytes;
    std::size_t files = SIZE_MAX;
};

/// Removes what was used longest ago, by the time of its last change, until the rest is within bounds.
/// Files with other extensions stay. What cannot be removed is no error.
/// @param stays is not removed
void make_room(const std::filesystem::path& folder, std::string_view extension,
               const std::filesystem::path& stays, const KeptMost& most);

} // namespace isochron::index
