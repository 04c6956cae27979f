// Draws the pictures to keep.
#include "app/output/kept_pictures.h"

namespace isochron::app {

stereo::DisplayOptions KeptPictures::options(std::size_t window) const {
    const glm::ivec2 size = shown[window].size();
    return drawn_with ? drawn_with(size) : picture_options(gl, config, size);
}

bool KeptPictures::serves(std::size_t window) const {
    const stereo::DisplayOptions wanted = options(window);
    return !differ && shown[window].fills() && (settled || wanted.passes == 1) &&
           wanted.samples == display_options(gl, config).samples;
}

void KeptPictures::each(const TakePicture& take_one) const {
    for (std::size_t i = 0; i < shown.size(); ++i)
        take(i, take_one);
}

void KeptPictures::take(std::size_t window, const TakePicture& take_one) const {
    if (serves(window)) {
        shown[window].draw_overlay_again({});
        return take_one(window, shown[window]);
    }
    stereo::Display picture(gl, windows.drawing(), windows[window], shown[window].window(),
                            options(window));
    draw(picture);
    take_one(window, picture);
}

render::Image KeptPictures::of_room() const {
    std::deque<stereo::Display> walls;
    for (std::size_t i = 0; i < shown.size(); ++i)
        draw(walls.emplace_back(gl, windows.drawing(), windows[i], shown[i].window(), options(i)));
    return room->picture(walls, picture_options(gl, config, room->size()).samples);
}

} // namespace isochron::app
