// The picture of a place in the data that a user picked: a cross and its read-out.
#pragma once

#include "index/volume/volume_series.h"
#include "interaction/commands.h"
#include "interaction/pointed.h"
#include "render/passes/text_pass.h"

#include <span>
#include <string>
#include <vector>

namespace isochron::app {

/// `12.5, 3, -4.25 mm: 37.2 K at 0.35 s`: the place, the data there, and when.
std::string mark_text(const interaction::MarkedPoint& point, const index::SeriesInfo& info);

/// A cross on the point and the read-out on its background beside it, at the point's depth, to be
/// drawn over the surface on which the point lies.
/// @param in_room the point in the room @param picture its size, pixels
std::vector<render::ScreenQuad> mark_quads(const interaction::MarkedPoint& point,
                                           const glm::vec3& in_room, const index::SeriesInfo& info,
                                           const render::TextPass& text, const glm::ivec2& picture);

/// The same for the place under the cursor, with the name of its surface.
std::vector<render::ScreenQuad> pointed_quads(const interaction::Pointed& pointed,
                                              std::span<const interaction::Isosurface> surfaces,
                                              const glm::vec3& in_room,
                                              const index::SeriesInfo& info,
                                              const render::TextPass& text,
                                              const glm::ivec2& picture);

/// A line of text on its background, centered at a point.
void add_label(const std::string& words, const glm::vec3& in_room, const render::TextPass& text,
               const glm::ivec2& picture, std::vector<render::ScreenQuad>& quads);

} // namespace isochron::app
