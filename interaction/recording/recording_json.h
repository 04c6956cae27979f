// Recorded values to JSON and back, with every value checked on the way in.
#pragma once

#include "interaction/recording/recorded_frame.h"

#include <nlohmann/json.hpp>

namespace isochron::interaction {

nlohmann::json to_json(const RecordingHeader& header);
/// @param before the frame that was written before this one, or null
nlohmann::json to_json(const RecordedFrame& frame, const RecordedFrame* before);

/// @throws Error without file and line: `scale: expected a number, got "big"`
RecordingHeader header_from_json(const nlohmann::json& json);
RecordedFrame frame_from_json(const nlohmann::json& json, const RecordedFrame* before);

/// Turns the bits of version 1 into actions: those of the device `keys`, and from the 65th on of
/// `more_keys`, which goes.
void take_old_bits(InputState& input);

/// @throws Error naming the first value that is not finite
void require_finite(const RecordedFrame& frame);

} // namespace isochron::interaction
