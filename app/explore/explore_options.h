// The command line options of `explore`.
#pragma once

#include "app/indexing/build_arguments.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

struct ExploreOptions {
    BuildArguments sources;          ///< what was given: an index, or files of values
    std::optional<std::string> data; ///< the index that is shown
    std::string data_name;           ///< what the user knows it by
    /// The array of files with several shapes that was chosen; empty: the user is asked.
    std::optional<std::string> array;
    std::string config = "desktop";
    std::optional<std::string> check_config, picture, context, stereo, quality, footprint, shape;
    std::optional<std::string> record, report, between, control;
    std::optional<double> isovalue, seconds;
    std::optional<std::uint32_t> step;
    std::vector<int> size;
    std::string screenshots = ".";
    std::vector<std::string> models; ///< files of triangles
    std::optional<std::string> session;
    std::optional<std::string> story; ///< file or link of the story that is told
    std::uint32_t told = 0; ///< key of the story that is told first, from 1; 0: its first step
    bool force = false, resume = false, follow = false;
    bool no_panel = false, emulate = false, list_devices = false, test_pattern = false;
};

/// Adds the options of `explore`, and the text below them in `--help`.
/// @param options live until the command has run
void add_explore_options(Command& command, ExploreOptions& options);

} // namespace isochron::app
