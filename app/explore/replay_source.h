// The options that all replaying commands share: recording, data, windows and drawing.
#pragma once

#include "app/command_line/command_line.h"
#include "app/config/config.h"
#include "app/explore/cluster_job.h"
#include "app/loop/replay.h"
#include "app/output/guarded_outputs.h"
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
    std::optional<std::string> background;
    std::optional<double> dpi;
    std::vector<int> size;
    std::vector<std::string> models; ///< files of triangles that may be opened
};

/// Adds these options to a command. @param source lives until the command has run
/// @param what `source.recording` is
void add_replay_source(Command& command, ReplaySource& source,
                       const std::string& what = "Recording made by `explore --record`");

/// The recorded configuration, or the given one, with the changes that the options make.
/// @throws ConfigError
Config config_of(const ReplaySource& options, const interaction::RecordingHeader& header);

/// The index to replay on.
/// @throws index::Error, interaction::Error when it is missing, or holds other data and
/// `any_data` is not set
std::shared_ptr<const index::IndexFile> data_of(const ReplaySource& options,
                                                const interaction::RecordingHeader& header,
                                                const Config& config);

/// What a replay reads. @param file null: no data
Reads reads_of(const ReplaySource& options, const index::IndexFile* file);

/// The file name of these data, without its folder.
std::string data_name(const ReplaySource& options, const interaction::RecordingHeader& header);

/// The recording's data hash if these data neither have it now nor had it earlier; else empty.
std::string other_data(const interaction::RecordingHeader& header, const index::IndexFile& file);

/// @throws render::Error
stereo::Windows windows_of(const ReplaySource& options, const Config& config,
                           const interaction::RecordingHeader& header, const ClusterJob& job);

/// Lets models be opened that lie in the recording's folder, and those of the options.
void let_show_models(const ReplaySource& options, Session& session);
/// Says on stderr why models are not shown.
void say_faults(const ModelSupply& models);

/// What the options show differently from the recording.
ReplayOptions replay_options(const ReplaySource& options);

} // namespace isochron::app
