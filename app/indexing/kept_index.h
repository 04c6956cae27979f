// Indexes of data that the user only wants to look at; they are kept in the user's cache folder.
#pragma once

#include "app/indexing/array_offers.h"
#include "app/indexing/build_arguments.h"
#include "index/progress.h"

#include <cstdint>
#include <filesystem>
#include <functional>

namespace isochron::app {

/// Most bytes of all kept indexes together; the one in use stays however large it is.
constexpr std::uint64_t kMostKeptBytes = std::uint64_t{20} << 30;

/// Callbacks that report the progress of an index, called on the thread that makes it.
struct KeptIndexReports {
    /// Which array to show, where files have several of different shapes. Throwing ends the work.
    ChooseArray choose = {};
    /// The files could be opened: a series of so many steps.
    std::function<void(std::size_t steps)> opened = {};
    /// The index is at `path` and has its first steps, so that they can be shown. Called again
    /// whenever it has more.
    std::function<void(const std::filesystem::path& path, std::size_t steps)> held = {};
    /// The fraction is of the whole series. Throwing ends the work; the steps that the index has
    /// by then stay.
    index::Progress progress = {};
};

/// The index of these files, read with these options. A kept one is used if no file has been
/// written to since it was made, and completed if it was not finished; else a new one is made. A
/// small series is indexed as by `isochron build`; a large one gets bricks only, a few steps at a
/// time, so that the first can be shown at once. If all kept indexes then take more than
/// `most_bytes`, those that have not been used for the longest time are deleted.
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
