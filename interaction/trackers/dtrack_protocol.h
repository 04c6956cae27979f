// Reads the datagrams that ART's tracking software DTrack sends: lines of ASCII.
#pragma once

#include "interaction/pose.h"

#include <glm/mat3x3.hpp>

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace isochron::interaction {

/// A body, or the body of a Flystick. Rotation: column i is the image of axis i; the protocol sends
/// its nine numbers in that order. DTrack sends zeros while a body is not tracked.
struct DTrackBody {
    int id = 0; ///< from 0
    bool tracked = false;
    glm::dvec3 position{0.0}; ///< [m]
    glm::dmat3 rotation{1.0};
};
struct DTrackFlystick {
    DTrackBody body;
    std::uint64_t buttons = 0;      ///< bit i: button i, from the right one to the left one
    std::vector<float> controllers; ///< [-1, 1], left and up positive; valid even when not tracked
};
struct DTrackMarker {
    int id = 0;
    glm::dvec3 position{0.0}; ///< [m]
};

struct DTrackFrame {
    std::uint32_t counter = 0;
    std::optional<Seconds> time; ///< time of the measurement, since midnight UTC
    std::optional<int> calibrated_bodies;
    std::vector<DTrackBody> bodies;
    std::vector<DTrackFlystick> flysticks;
    std::vector<DTrackMarker> markers;
    int malformed_lines = 0; ///< number of lines that were left out
};

/// Reads the lines `fr`, `ts`, `6dcal`, `6d`, `6di`, `6df2`, `6df` and `3d`, and ignores others. A
/// line is left out as a whole if it is malformed, has a number that is not finite, or does not
/// have the number of blocks that it announces. Source: A.R.T. GmbH, DTrack2 user manual, "Output
/// of measurement data via Ethernet" (appendix B in version 2.12, 2016).
/// @return empty when the datagram does not begin with a frame counter
std::optional<DTrackFrame> parse_dtrack(std::string_view datagram);

} // namespace isochron::interaction
