// Several views' pictures in parts of one target, drawn together.
#pragma once

#include "render/gl/render_target.h"
#include "stereo/display_options.h"

#include <optional>
#include <span>

namespace isochron::stereo {

/// Draws the scene into a cleared target, each view within its own part of it, and resolves it.
/// @param target made, or given the size, as needed
/// @param size of the whole, pixels; the views' corners and sizes lie inside
void draw_views(const render::Gl& gl, std::optional<render::RenderTarget>& target, glm::ivec2 size,
                const DisplayOptions& options, std::span<const render::View> views,
                const DrawViews& scene);

} // namespace isochron::stereo
