// Draws several views into parts of one target.
#include "stereo/views_in_target.h"

#include "render/gl/viewport.h"

#include <glm/vec4.hpp>

namespace isochron::stereo {

void draw_views(const render::Gl& gl, std::optional<render::RenderTarget>& target, glm::ivec2 size,
                const DisplayOptions& options, std::span<const render::View> views,
                const DrawViews& scene) {
    draw_views_on(gl, target, size, options, views, true, [&](std::span<const render::View> all) {
        scene(all);
        return true;
    });
}

bool draw_views_on(const render::Gl& gl, std::optional<render::RenderTarget>& target,
                   glm::ivec2 size, const DisplayOptions& options,
                   std::span<const render::View> views, bool begins, const DrawPart& scene) {
    if (begins) {
        if (target)
            target->resize(size);
        else
            target.emplace(gl, size, options.samples);
        target->clear(options.transparent ? glm::vec4(0.0f) : glm::vec4(options.background, 1.0f));
    }
    target->bind();
    gl.Enable(GL_SCISSOR_TEST);
    for (std::size_t i = 0; i < views.size(); ++i)
        set_viewport(gl, views[i], static_cast<GLuint>(i));
    const bool whole = scene(views);
    gl.Disable(GL_SCISSOR_TEST);
    if (whole)
        target->resolve();
    return whole;
}

} // namespace isochron::stereo
