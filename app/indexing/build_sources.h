// What an index is built of.
#pragma once

#include "app/indexing/build_arguments.h"
#include "index/progress.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

/// One array, and the options that select it in the files.
struct ArraySource {
    std::unique_ptr<index::VolumeSeries> series;
    std::optional<std::string> array, component;
};

/// The first array, the array to color by, and the further arrays; no volume when there is nothing
/// to append.
struct BuildSources {
    std::unique_ptr<index::VolumeSeries> volume, colors;
    std::optional<std::string> array, component; ///< names that select the volume
    std::vector<ArraySource> further;
    std::vector<std::string> notes; ///< on arrays that were left out
};

/// Opens the array that options name, of whatever holds the values.
using OpenSource =
    std::function<std::unique_ptr<index::VolumeSeries>(const index::ReadOptions& options)>;
/// Opens the arrays that the arguments name. @throws index::Error, UsageError
BuildSources open_sources(const OpenSource& open, const BuildArguments& arguments);

/// Opens files of values, or one index, which may have an older file version.
/// @param progress of many files; may be empty
/// @throws index::Error, UsageError
BuildSources open_sources(const std::vector<std::filesystem::path>& files,
                          const BuildArguments& arguments, const index::Progress& progress = {});

/// The arrays among which files leave the choice, as `--array` takes them; empty where one is named,
/// all are taken, or there are no several arrays.
std::vector<std::string> arrays_to_choose(const std::vector<std::filesystem::path>& files,
                                          const BuildArguments& arguments);

/// One array, whatever the arguments say of arrays.
/// @param name as `--array` takes it @throws index::Error
ArraySource open_array(const std::vector<std::filesystem::path>& files,
                       const BuildArguments& arguments, const std::string& name);

/// As `open_sources`; where files leave the choice among several arrays, it opens all of one shape,
/// and the arguments say so.
BuildSources open_one_or_all(const std::vector<std::filesystem::path>& files,
                             BuildArguments& arguments);

/// For `build --append`: leaves of each series only the steps that the index does not have yet.
/// @throws index::Error when the index has other arrays, or as `index::append_to`
void append_sources(BuildSources& sources, const std::shared_ptr<const index::IndexFile>& held,
                    const std::string& name);

/// The options of the arguments, with the colors and further arrays of `sources`, which outlive it.
index::BuildOptions build_options(const BuildArguments& arguments, const BuildSources& sources);

} // namespace isochron::app
