// Imports ParaView's description of a CAVE, a .pvx file, as an installation.
#pragma once

#include "stereo/installation.h"

#include <filesystem>
#include <string>
#include <vector>

namespace isochron::app {

struct PvxOptions {
    float meters_per_unit = 1.0f; ///< unit of the file's corners and eye separations
    glm::vec3 origin{0.0f};       ///< [m] where the file's origin is in the room
};

struct PvxImport {
    stereo::Installation installation;
    std::vector<std::string> notes; ///< what of the file an installation cannot hold, a line each
};

/// Makes a window with one viewport for each `Machine`, and a viewer for each `ViewerId`, who
/// stands at the file's origin until a tracker gives a position. Reads the attributes that
/// ParaView's `Remoting/Core/vtkDisplayConfiguration.cxx` reads.
/// @param name of the file, for messages
/// @throws ConfigError in one line, with the file and the line
PvxImport parse_pvx(const std::string& text, const std::string& name, const PvxOptions& options);

/// Reads a file. @throws ConfigError also when it cannot be read
PvxImport read_pvx(const std::filesystem::path& path, const PvxOptions& options);

} // namespace isochron::app
