// The last exact picture, moved to where its cells are seen now, in the place of a worse one.
#pragma once

#include "app/scene/picture.h"
#include "index/volume/query.h"

namespace isochron::app {

/// How far a viewer's head may have gone, relative to the data, before the picture is no longer
/// moved [m in the room]. A moved picture lacks what was hidden from the old eyes: the farther the
/// eyes have gone, the more it lacks.
constexpr double kMovedAtMost = 0.04;

/// Whether an exact picture of the same cells, looks and viewers shows, once it is moved, what is to
/// be seen now.
/// @param exact picture that is kept @param now its place and viewers count
/// @param asked what the frame asks for
bool may_be_moved(const Picture& exact, const Picture& now, const index::SurfacesQuery& asked);

/// Whether eyes and data are where they were for a picture, which differs at most in the size of
/// its views.
bool stand_as(const Picture& then, const Picture& now);

/// How far the heads have come from where they saw a picture, as the data see it [m in the room].
double moved_by(const Picture& then, const Picture& now);

} // namespace isochron::app
