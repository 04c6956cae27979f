// The description of a figure of what is seen.
#pragma once

#include "interaction/commands.h"

#include <string>

namespace isochron::app {

/// A file for `isochron figure`: one panel of the index, with all that the key holds.
/// @param index path of the index @param aspect height of the picture, in widths
std::string figure_text(const std::string& index, const interaction::KeyFrame& key, double aspect);

} // namespace isochron::app
