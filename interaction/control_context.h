// The session's current state, from which controls and tools make commands.
#pragma once

#include "interaction/commands.h"
#include "interaction/pointed.h"

#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace isochron::interaction {

/// What tools have made.
struct ToolState {
    Mark mark;
    ClipPlane clip;
    Ruler ruler;
};

/// The box of the data in its physical space.
struct DataFrame {
    glm::dmat4 physical_from_box{1.0}; ///< from the unit cube
    std::string unit;                  ///< of lengths; may be empty

    glm::dvec3 at(const glm::dvec3& in_box) const {
        return glm::dvec3(physical_from_box * glm::dvec4(in_box, 1.0));
    }
    glm::dvec3 in_box(const glm::dvec3& physical) const {
        return glm::dvec3(glm::inverse(physical_from_box) * glm::dvec4(physical, 1.0));
    }
    double longest_side() const {
        double longest = 0;
        for (int axis = 0; axis < 3; ++axis)
            longest = std::max(longest, glm::length(glm::dvec3(physical_from_box[axis])));
        return longest;
    }
};

/// The state that new commands start from; owned by the session, passed in every frame.
struct ControlContext {
    double isovalue = 0;
    double low = 0, high = 1; ///< value range of the data
    std::uint32_t step = 0;
    std::vector<double> const* times = nullptr; ///< physical times of the steps, increasing
    PlaybackState playback;
    bool follow = false;
    Similarity room_from_physical;
    Similarity home;       ///< what reset returns to
    glm::dvec3 pivot{0.0}; ///< center of the volume, physical space: orbit turns about it
    QualityMode quality = QualityMode::automatic;
    float eye_separation = 0.063f;
    std::string stereo;
    bool panel = true;
    RoomPanel room_panel;
    float panel_distance = 0.65f; ///< [m] from the eyes to the room's panel, where it appears
    /// Where the panel appears for an emulated head, in the head's frame; nothing: `beside`.
    std::optional<Pose> panel_place;
    bool grid = false;
    std::vector<Viewpoint> const* views = nullptr; ///< saved so far; may be null
    bool bounding_box = true;
    std::uint32_t isosurfaces = 1, picked = 0; ///< their number, and the one the isovalue moves
    Coloring coloring;
    /// Names of the arrays to color by, which may be null or empty; and the number of the one whose
    /// values are the colors, or would be if surfaces were colored by an array.
    std::vector<std::string> const* color_arrays = nullptr;
    std::size_t color_array = 0;
    const Commands* next_array =
        nullptr; ///< commands that show the next array; null: there is none
    std::vector<std::string> const* stereo_modes = nullptr; ///< what V cycles through; may be null
    Tools tools;
    ToolState state;
    DataFrame data;
    SurfaceFinder find_surface; ///< on the surfaces that are shown; may be empty
    bool orthographic = false;
    const Commands* start = nullptr; ///< commands that restore the view of the start; may be null
    bool leaving = false;            ///< the program is asking whether to quit
    const Commands* undo = nullptr;  ///< commands that undo the newest change; null: none
    const Commands* redo = nullptr;  ///< commands that redo what was undone last; null: none
};

} // namespace isochron::interaction
