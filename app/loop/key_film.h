// A film of key frames as a recording, seen with a session's data and settings.
#pragma once

#include "app/session/session.h"
#include "interaction/recording/recording.h"

#include <span>

namespace isochron::app {

/// @param session what keys do not hold is as this session shows it
/// @param header of the session
/// @param keys fit the data; not empty
/// @param rate frames a second
/// @param titled the recording has the keys, and says when the title of which one is seen
interaction::Recording film_of_keys(const Session& session, interaction::RecordingHeader header,
                                    std::span<const interaction::KeyFrame> keys, double rate,
                                    bool titled = false);

} // namespace isochron::app
