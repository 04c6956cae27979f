// What an index is built of.
#pragma once

#include "app/commands/build_arguments.h"

#include <filesystem>
#include <memory>
#include <vector>

namespace isochron::app {

/// The volume and the array to color by; no volume when there is nothing to append.
struct BuildSources {
    std::unique_ptr<index::VolumeSeries> volume, colors;
};

/// Files of values, or one index, also of an older file version.
/// @throws index::Error, UsageError
BuildSources open_sources(const std::vector<std::filesystem::path>& files,
                          const BuildArguments& arguments);

/// What was asked for, with the colors of the sources, which outlive it.
index::BuildOptions build_options(const BuildArguments& arguments, const BuildSources& sources);

} // namespace isochron::app
