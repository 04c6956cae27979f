// Titles over the frames of a film.
#pragma once

#include "app/scene/picture.h"
#include "interaction/recording/recording.h"

#include <vector>

namespace isochron::app {

/// What stands over each frame of a recording: the name and the text of the key that is told there
/// (`Settings::story`). It fades in and out within half a second, or half of its time.
std::vector<Title> titles_of(const interaction::Recording& recording);

} // namespace isochron::app
