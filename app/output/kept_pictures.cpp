// Draws the pictures to keep.
#include "app/output/kept_pictures.h"

namespace isochron::app {

stereo::DisplayOptions KeptPictures::options(std::size_t window) const {
    return picture_options(gl, config, shown[window].size());
}

bool KeptPictures::serves(std::size_t window) const {
    return !differ && shown[window].fills() &&
           options(window).samples == display_options(gl, config).samples;
}

void KeptPictures::each(const TakePicture& take) const {
    for (std::size_t i = 0; i < shown.size(); ++i) {
        if (serves(i)) {
            shown[i].draw_overlay_again({});
            take(i, shown[i]);
            continue;
        }
        stereo::Display picture(gl, windows.drawing(), windows[i], shown[i].window(), options(i));
        draw(picture);
        take(i, picture);
    }
}

render::Image KeptPictures::of_room() const {
    std::deque<stereo::Display> walls;
    for (std::size_t i = 0; i < shown.size(); ++i)
        draw(walls.emplace_back(gl, windows.drawing(), windows[i], shown[i].window(), options(i)));
    return room->picture(walls, picture_options(gl, config, room->size()).samples);
}

} // namespace isochron::app
