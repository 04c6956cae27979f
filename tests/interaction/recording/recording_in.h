// Reads a recording from a test's file.
#pragma once

#include "interaction/recording/recording.h"

#include <filesystem>
#include <fstream>

namespace isochron::interaction {

inline Recording recording_in(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return read_recording(file, path.filename().string());
}

} // namespace isochron::interaction
