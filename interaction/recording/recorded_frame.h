// What a recording says of the session and of each of its frames.
#pragma once

#include "interaction/commands.h"
#include "interaction/tracked_input.h"

#include <array>
#include <string>

namespace isochron::interaction {

struct RecordingHeader {
    int version = 1;
    std::string program;         ///< `isochron 0.1.0`
    std::string configuration;   ///< the whole text of the configuration file
    std::string data;            ///< path of the index as given
    std::string data_hash;       ///< hexadecimal content hash
    std::array<int, 2> window{}; ///< [pixels] at the start; 0: as the configuration says
    Commands start;              ///< everything that commands can set, set
    bool operator==(const RecordingHeader&) const = default;
};

struct RecordedFrame {
    InputState input;    ///< devices as polled, with the frame's time
    Commands commands;   ///< what they and the panel led to
    Commands from_panel; ///< the part of `commands` that no device alone explains; picks too
    /// What the cells were drawn with (`quad`, ...); a report, which no replay obeys. May be empty.
    std::string footprint = {};
    /// Heads as they were right before drawing, for the views alone; no devices: as in `input`.
    InputState latched = {};
    bool operator==(const RecordedFrame&) const = default;
};

} // namespace isochron::interaction
