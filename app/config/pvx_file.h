// ParaView's description of a CAVE, a .pvx file, as an installation.
#pragma once

#include "stereo/installation.h"

#include <filesystem>
#include <string>
#include <vector>

namespace isochron::app {

struct PvxOptions {
    float meters_per_unit = 1.0f; ///< of the file's corners and eye separations
    glm::vec3 origin{0.0f};       ///< [m] where the file's origin is in the room
};

struct PvxImport {
    stereo::Installation installation;
    std::vector<std::string> notes; ///< what the file says that an installation does not hold
};

/// A window with one viewport for each `Machine`, a viewer for each `ViewerId`, who stands at the
/// file's origin until a tracker tells. The attributes are those of ParaView's
/// `Remoting/Core/vtkDisplayConfiguration.cxx`.
/// @param name of the file, for messages
/// @throws ConfigError in one line, with the file and the line
PvxImport parse_pvx(const std::string& text, const std::string& name, const PvxOptions& options);

/// As above, of a file. @throws ConfigError also when it cannot be read
PvxImport read_pvx(const std::filesystem::path& path, const PvxOptions& options);

} // namespace isochron::app
