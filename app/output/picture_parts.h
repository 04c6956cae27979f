// The pictures of a frame to write: one for each window, or one for each eye.
#pragma once

#include "app/output/outputs.h"
#include "app/output/picture_names.h"
#include "app/output/picture_note.h"

#include <functional>
#include <string>

namespace isochron::app {

/// Receives one picture. @param suffix of its file name: `_front_left`
using TakePart =
    std::function<void(const PictureNote& note, const std::string& suffix, render::Image image)>;

/// Draws the pictures to keep of the last frame.
/// @param each_eye one picture for each eye and viewport; else one for each window, as its stereo
/// mode composes it
/// @param names of the installation; windows without one, such as the operator's, are left out
/// @param frame note about the frame; each picture's note adds which part it is
void each_part(Outputs& outputs, bool each_eye, const PictureNames& names, const PictureNote& frame,
               const TakePart& take);

} // namespace isochron::app
