// Indexes of data that were only to be looked at, in the user's folder for such things.
#pragma once

#include "app/commands/build_arguments.h"
#include "index/progress.h"

#include <cstdint>
#include <filesystem>
#include <functional>

namespace isochron::app {

/// Of all kept indexes together; the one in use stays however large it is.
constexpr std::uint64_t kMostKeptBytes = std::uint64_t{20} << 30;

/// Who is told how the making of an index goes; all on the thread that makes it.
struct KeptIndexReports {
    /// The files could be opened: a series of so many steps.
    std::function<void(std::size_t steps)> opened = {};
    /// The index is at `path` and has its first steps, so that they can be shown. Called again
    /// whenever it has more.
    std::function<void(const std::filesystem::path& path, std::size_t steps)> held = {};
    /// The fraction is of the whole series. Throwing ends the work; the steps that the index has
    /// by then stay.
    index::Progress progress = {};
};

/// The index of these files, read with these options: one that is kept, as long as no file has been
/// written to since it was made, or a new one. A small series is indexed as `isochron build` does
/// it; of a large one only bricks are made, a few steps at a time, so that the first can be shown
/// at once. One that was not finished is gone on with. Those that were not used for the longest
/// time go where all take more than `most_bytes`.
/// @param arguments their `out` is not used
/// @param folder made where it is missing
/// @throws index::Error as opening and building do
std::filesystem::path kept_index(const BuildArguments& arguments,
                                 const std::filesystem::path& folder,
                                 const KeptIndexReports& reports = {},
                                 std::uint64_t most_bytes = kMostKeptBytes);

/// Whether the arguments say nothing but which files to read.
bool has_no_options(const BuildArguments& arguments);

} // namespace isochron::app
