// The pictures of a frame to write.
#include "app/output/picture_parts.h"

#include <fmt/format.h>

#include <utility>

namespace isochron::app {

void each_part(Outputs& outputs, bool each_eye, const PictureNames& names, const PictureNote& frame,
               const TakePart& take) {
    if (outputs.room())
        return take(outputs.noted(frame, {.shows = "room"}), "",
                    outputs.kept_pictures(frame).of_room());
    outputs.kept_pictures(frame).each([&](std::size_t i, const stereo::Display& display) {
        const std::size_t number = outputs.windows().number(i);
        if (number >=
            names.windows.size()) // the operator's window, which is not part of the installation
            return;
        const PictureNames::Window& named = names.windows[number];
        const auto take_part = [&](const std::string& shows, std::size_t viewport,
                                   const std::string& suffix, render::Image image) {
            take(outputs.noted(frame, {shows, number, viewport}), suffix,
                 outputs.finished(std::move(image), frame));
        };
        if (each_eye) {
            for (std::size_t v = 0; v < named.viewports.size(); ++v)
                for (const stereo::Eye eye : stereo::eyes_of(display.mode()))
                    take_part(std::string(name_of(eye)), v,
                              fmt::format("{}_{}", named.viewports[v], name_of(eye)),
                              display.read_eye(eye, v));
        } else if (stereo::upright(display.mode()) == stereo::StereoMode::quadbuffer) {
            take_part("window", 0, named.suffix + "_left", display.read_window());
            take_part("right_buffer", 0, named.suffix + "_right", display.read_right_buffer());
        } else {
            take_part("window", 0, named.suffix, display.read_window());
        }
    });
}

} // namespace isochron::app
