// The input and output paths of the specification's interaction profiles.
#pragma once

#include <string>

namespace isochron::played {

/// Whether a profile has a path, by OpenXR 1.0, section 6.4, "Interaction Profile Paths".
/// @param path `/user/hand/left/input/x/click`
bool has_path(const std::string& profile, const std::string& path);
bool is_profile(const std::string& profile);

} // namespace isochron::played
