// What is replayed, on which data, and in what pictures: for the commands that replay a recording.
#pragma once

#include "app/commands/cluster_job.h"
#include "app/commands/command_line.h"
#include "app/config/config.h"
#include "app/session/replay.h"
#include "index/file/index_file.h"
#include "interaction/recording/recording.h"
#include "stereo/windows.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

struct ReplaySource {
    std::string recording;
    std::optional<std::string> data, config, context, stereo, quality, footprint, shape;
    bool any_data = false, emulate = false, live = false, ray = false, caption = false;
    std::optional<int> samples;
    std::vector<int> size;
};

/// Adds the options that say so. @param source lives until the command has run
void add_replay_source(Command& command, ReplaySource& source);

/// The recorded configuration, or the one that is given, with what the options change.
/// @throws ConfigError
Config config_of(const ReplaySource& options, const interaction::RecordingHeader& header);

/// @throws index::Error, interaction::Error when they are not there, or others
std::shared_ptr<const index::IndexFile> data_of(const ReplaySource& options,
                                                const interaction::RecordingHeader& header,
                                                const Config& config);

/// The file name of these data, without its folder.
std::string data_name(const ReplaySource& options, const interaction::RecordingHeader& header);

/// The hash that the recording names, where these data neither have it nor ever had; else empty.
std::string other_data(const interaction::RecordingHeader& header, const index::IndexFile& file);

/// @throws render::Error
stereo::Windows windows_of(const ReplaySource& options, const Config& config,
                           const interaction::RecordingHeader& header, const ClusterJob& job);

/// What is shown otherwise than recorded.
ReplayOptions replay_options(const ReplaySource& options);

} // namespace isochron::app
