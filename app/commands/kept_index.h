// Indexes of data that were only to be looked at, in the user's folder for such things.
#pragma once

#include "app/commands/build_arguments.h"

#include <cstdint>
#include <filesystem>

namespace isochron::app {

/// Of all kept indexes together; the one in use stays however large it is.
constexpr std::uint64_t kMostKeptBytes = std::uint64_t{20} << 30;

/// The index of these files, read with these options: one that is kept, as long as no file has been
/// written to since it was made, or a new one. Those that were not used for the longest time go
/// where all take more than `most_bytes`.
/// @param arguments their `out` is not used
/// @param folder made where it is missing
/// @throws index::Error as opening and building do
std::filesystem::path kept_index(const BuildArguments& arguments,
                                 const std::filesystem::path& folder,
                                 std::uint64_t most_bytes = kMostKeptBytes);

} // namespace isochron::app
