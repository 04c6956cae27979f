// The pictures of a frame that can be written: one for each window, or one for each eye.
#pragma once

#include "app/output/outputs.h"
#include "app/output/picture_names.h"
#include "app/output/picture_note.h"

#include <functional>
#include <string>

namespace isochron::app {

/// @param suffix of its file's name: `_front_left`
using TakePart =
    std::function<void(const PictureNote& note, const std::string& suffix, render::Image image)>;

/// Draws the pictures of the last frame once more, to be kept.
/// @param each_eye one for each eye and viewport; else as the windows' modes compose them
/// @param names of the installation; windows beyond them, such as the operator's, are left out
/// @param frame what the frame shows; each picture's note adds what it is
void each_part(Outputs& outputs, bool each_eye, const PictureNames& names, const PictureNote& frame,
               const TakePart& take);

} // namespace isochron::app
