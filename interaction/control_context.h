// What a session is at, for those who make commands that change it.
#pragma once

#include "interaction/commands.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace isochron::interaction {

/// What commands are relative to; owned by the session, passed in every frame.
struct ControlContext {
    double isovalue = 0;
    double low = 0, high = 1; ///< value range of the data
    std::uint32_t step = 0;
    std::vector<double> const* times = nullptr; ///< physical times of the steps, increasing
    PlaybackState playback;
    Similarity room_from_physical;
    Similarity home;       ///< what reset returns to
    glm::dvec3 pivot{0.0}; ///< center of the volume, physical space: what orbit turns about
    QualityMode quality = QualityMode::automatic;
    float eye_separation = 0.063f;
    std::string stereo;
    bool panel = true;
    RoomPanel room_panel;
    float panel_distance = 0.65f; ///< [m] from the eyes to the room's panel, where it appears
    bool grid = false;
    std::vector<Viewpoint> const* views = nullptr; ///< saved so far; may be null
    bool bounding_box = true;
    std::uint32_t isosurfaces = 1, picked = 0; ///< how many there are, and the one that is moved
    Coloring coloring;
    bool has_second_array = false;                          ///< something to color by
    std::vector<std::string> const* stereo_modes = nullptr; ///< what V cycles through; may be null
};

} // namespace isochron::interaction
