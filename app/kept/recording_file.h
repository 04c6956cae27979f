// Reads recordings from files.
#pragma once

#include "interaction/recording/recording.h"

#include <filesystem>

namespace isochron::app {

/// @throws index::Error when the file cannot be opened, interaction::Error as the recording reads
interaction::Recording read_recording(const std::filesystem::path& path);

} // namespace isochron::app
