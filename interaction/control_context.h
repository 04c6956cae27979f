// The session's settings and what surrounds them, from which controls and tools make commands.
#pragma once

#include "interaction/commands.h"
#include "interaction/pointed.h"
#include "interaction/step_gaps.h"

#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace isochron::interaction {

/// The box of the data in its physical space.
struct DataFrame {
    glm::dmat4 physical_from_box{1.0}; ///< from the unit cube
    std::string unit;                  ///< unit of lengths; may be empty
    glm::dvec3 cells{1.0};             ///< number of cells along each axis
    /// Distances of the vertices along an axis from the first, where they are uneven; null: even.
    std::array<const std::vector<double>*, 3> distances{};

    glm::dvec3 at(const glm::dvec3& in_box) const {
        return glm::dvec3(physical_from_box * glm::dvec4(in_box, 1.0));
    }
    glm::dvec3 in_box(const glm::dvec3& physical) const {
        return glm::dvec3(glm::inverse(physical_from_box) * glm::dvec4(physical, 1.0));
    }
    /// Index of vertices along an axis, at a share of the box, 0 to 1; between vertices in proportion.
    double index_along(int axis, double share) const {
        const std::vector<double>* at = distances[static_cast<std::size_t>(axis)];
        if (!at)
            return share * cells[axis];
        const double distance = share * at->back();
        const auto above = std::upper_bound(at->begin() + 1, at->end() - 1, distance);
        return static_cast<double>(above - at->begin() - 1) +
               (distance - above[-1]) / (above[0] - above[-1]);
    }
    /// The inverse of `index_along`.
    double share_along(int axis, double index) const {
        const std::vector<double>* at = distances[static_cast<std::size_t>(axis)];
        if (!at)
            return index / cells[axis];
        const auto low = static_cast<std::size_t>(std::clamp(index, 0.0, cells[axis] - 1));
        const double rest = index - static_cast<double>(low);
        return ((*at)[low] + rest * ((*at)[low + 1] - (*at)[low])) / at->back();
    }
    double longest_side() const {
        double longest = 0;
        for (int axis = 0; axis < 3; ++axis)
            longest = std::max(longest, glm::length(glm::dvec3(physical_from_box[axis])));
        return longest;
    }
};

/// The series as controls move through it.
struct ControlledSeries {
    double low = 0, high = 1;                   ///< range of its values
    const std::vector<double>* times = nullptr; ///< physical times of the steps, increasing
    const StepGaps* gaps = nullptr;             ///< gaps between these steps; null: none
    glm::dvec3 pivot{0.0}; ///< center of the volume, physical space: orbit turns about it
    Similarity home;       ///< room from physical space: what reset returns to
};

/// The arrays to color by.
struct ColorArrays {
    const std::vector<std::string>* names = nullptr; ///< may be null or empty
    std::size_t chosen = 0; ///< number of the array that gives the colors, or that would give them
                            ///< if surfaces were colored by an array
};

/// Where the room's panel appears when it is called.
struct CalledPanel {
    float distance = 0.65f; ///< [m] from the eyes
    /// Pose in the frame of an emulated head; empty: the place that `called` chooses.
    std::optional<Pose> place;
};

/// Commands that lead to other states; null: there is no such way.
struct Ways {
    const Commands* next_array = nullptr; ///< shows the next array
    const Commands* start = nullptr;      ///< restores the view of the start
    const Commands* undo = nullptr;       ///< undoes the newest change
    const Commands* redo = nullptr;       ///< redoes what was undone last
};

/// What new commands start from; made by the session and passed in every frame.
struct ControlContext {
    const Settings& settings;
    ControlledSeries series{};
    ColorArrays color_arrays{};
    CalledPanel called_panel{};
    Ways ways{};
    const std::vector<std::string>* stereo_modes = nullptr; ///< what V cycles through; may be null
    DataFrame data{};
    SurfaceFinder find_surface{}; ///< on the surfaces that are shown; may be empty
    bool fades = false; ///< steps of a story come by a fade, as in headsets, and not by a motion
};

} // namespace isochron::interaction
