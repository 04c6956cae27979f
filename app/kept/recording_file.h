// Reads recordings from files.
#pragma once

#include "interaction/recording/recording.h"

#include <filesystem>

namespace isochron::app {

/// @throws index::Error when the file cannot be opened, interaction::Error naming the recording that a
/// crash has left in its place
void expect_recording(const std::filesystem::path& path);

/// @throws as `expect_recording`, and interaction::Error as the recording reads
interaction::Recording read_recording(const std::filesystem::path& path);

} // namespace isochron::app
