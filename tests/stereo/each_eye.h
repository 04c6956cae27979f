// Scenes for tests that draw something different for each eye.
#pragma once

#include "render/gl/viewport.h"
#include "stereo/display.h"

#include <gtest/gtest.h>

namespace isochron::stereo {

/// Draws a frame: calls `scene(view, eye)` for one eye after the other, with the GL viewport set to
/// that eye's.
template <class Scene>
void draw_each_eye(const render::Gl& gl, Display& display, const interaction::Pose& head,
                   float eye_separation, StereoMode mode, Scene scene,
                   const Display::Overlay& overlay = {}) {
    const auto draw = [&](std::span<const render::View> views) {
        const std::vector<Eye> eyes = eyes_of(mode);
        ASSERT_EQ(views.size(), eyes.size());
        for (std::size_t i = 0; i < views.size(); ++i) {
            render::set_viewport(gl, views[i]);
            scene(views[i], eyes[i]);
        }
    };
    display.draw(head, eye_separation, mode, draw, overlay);
}

} // namespace isochron::stereo
