// Draws several views into parts of one target.
#pragma once

#include "render/gl/render_target.h"
#include "stereo/display_options.h"

#include <optional>
#include <span>

namespace isochron::stereo {

/// Draws the scene into a cleared target, each view into its part of it, and resolves the target.
/// @param target is made or resized if needed
/// @param size of the whole target, pixels; the views lie inside
void draw_views(const render::Gl& gl, std::optional<render::RenderTarget>& target, glm::ivec2 size,
                const DisplayOptions& options, std::span<const render::View> views,
                const DrawViews& scene);

/// Draws the views in several calls; each call draws something more.
/// @param begins this is the first one: the target is cleared
/// @param scene returns whether the picture is complete now
/// @return what `scene` returned; if true, the target is resolved
bool draw_views_on(const render::Gl& gl, std::optional<render::RenderTarget>& target,
                   glm::ivec2 size, const DisplayOptions& options,
                   std::span<const render::View> views, bool begins, const DrawPart& scene);

} // namespace isochron::stereo
