// The contents of a recording: the session's header and one record per frame.
#pragma once

#include "interaction/commands.h"
#include "interaction/input/tracked_input.h"

#include <array>
#include <cstdint>
#include <string>

namespace isochron::interaction {

inline constexpr int kRecordingVersion = 2; ///< that is written

struct RecordingHeader {
    int version = kRecordingVersion; ///< version of the file that it was read from
    std::string program;             ///< `isochron 0.1.0`
    std::string configuration;       ///< the whole text of the configuration file
    std::string data;                ///< path of the index as given
    std::string data_hash;           ///< hexadecimal content hash
    std::array<int, 2> window{};     ///< [pixels] at the start; 0: as the configuration says
    double text = 0;                 ///< height of words, as a share of the window's; 0: as usual
    Commands start;                  ///< the state at the start: every setting
    std::uint32_t reading = 0; ///< how the data's files were read, as indexes count it; 0: not said
    bool operator==(const RecordingHeader&) const = default;
};

struct RecordedFrame {
    InputState input;    ///< devices as polled, with the frame's time
    Commands commands;   ///< the commands of devices and panel
    Commands from_panel; ///< the part of `commands` that devices alone do not give: panel and picks
    /// Footprint that cells were drawn with (`quad`, ...). For information: replays ignore it. May
    /// be empty.
    std::string footprint = {};
    /// Poses of the heads right before drawing, used for the views only; no devices: as in `input`.
    InputState latched = {};
    bool operator==(const RecordedFrame&) const = default;
};

} // namespace isochron::interaction
