// The controls of a film's key frames: adding, removing and visiting them.
#pragma once

#include "interaction/commands.h"
#include "interaction/input/actions.h"
#include "interaction/pose.h"

#include <array>
#include <string>
#include <vector>

namespace isochron::interaction {

inline constexpr std::array kKeyFrameActions{Action::add_key, Action::remove_key, Action::next_key,
                                             Action::previous_key};

/// Adds what one of these actions leads to.
/// @param commands of the frame so far, whose view a new key has
/// @param notes messages for people
void press_key_frames(Action action, const Settings& now, const Pose& viewer, Commands& commands,
                      std::vector<std::string>& notes);

} // namespace isochron::interaction
