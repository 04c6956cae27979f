// Recorded values to JSON and back, with every value checked on the way in.
#pragma once

#include "interaction/recording/recorded_frame.h"

#include <nlohmann/json.hpp>

namespace isochron::interaction {

inline constexpr int kRecordingVersion = 1;

nlohmann::json to_json(const RecordingHeader& header);
/// @param before the frame that was written before this one, or null
nlohmann::json to_json(const RecordedFrame& frame, const RecordedFrame* before);

/// These throw Error without file and line: `scale: expected a number, got "big"`.
RecordingHeader header_from_json(const nlohmann::json& json);
RecordedFrame frame_from_json(const nlohmann::json& json, const RecordedFrame* before);

/// Complains about the first number that a recording cannot hold.
void require_finite(const RecordedFrame& frame);

} // namespace isochron::interaction
