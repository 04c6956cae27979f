// Chooses the labels along the box that are shown, so that no label covers another one.
#pragma once

#include "app/scene/axes.h"
#include "render/gl/view.h"
#include "render/passes/glyph_atlas.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>

#include <optional>
#include <span>
#include <vector>

namespace isochron::app {

/// Part of a picture, pixels from its lower left.
struct TextRectangle {
    glm::vec2 low{0.0f}, high{0.0f};
    bool operator==(const TextRectangle&) const = default;
};

/// What words cover in each view; empty where they are not seen.
using Covered = std::vector<std::optional<TextRectangle>>;

/// The part of a picture that a line of text covers; empty if its place is behind the eye.
/// @param height of the text, pixels
std::optional<TextRectangle> covered_by(const render::Label& label, float height,
                                        const render::GlyphAtlas& atlas,
                                        const glm::mat4& clip_from_model, glm::ivec2 picture);

/// The labels to draw into all of the views, which are the eyes of one viewer: both must see the
/// same labels. Titles take precedence. An axis on which numbers would touch shows every second,
/// fifth or tenth of them, counted from zero; where two axes meet, only the first one's number is
/// shown.
/// @param share height of the labels, see `text_height`
/// @param taken words that stand elsewhere in the picture, such as the legend
std::vector<render::Label> labels_with_room(std::span<const AxisLabels> axes,
                                            const render::GlyphAtlas& atlas,
                                            const render::Placement& placement,
                                            std::span<const render::View> views, float share = 0.0f,
                                            std::vector<Covered> taken = {});

} // namespace isochron::app
