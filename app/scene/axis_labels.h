// Which of the labels along the box are shown, so that none covers another one.
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

/// What a line of text covers. Nothing where it is fastened to a place behind the eye.
/// @param height of the text, pixels
std::optional<TextRectangle> covered_by(const render::Label& label, float height,
                                        const render::GlyphAtlas& atlas,
                                        const glm::mat4& clip_from_model, glm::ivec2 picture);

/// The labels to draw into all of the views, which are one viewer's eyes: what one eye misses the
/// other must not see. Titles go first. An axis on which numbers would touch shows every second,
/// fifth or tenth of them, counted from zero; where two axes meet, the first one has its number.
/// @param clip_from_model of each view, model space being that of the labels
std::vector<render::Label> labels_with_room(std::span<const AxisLabels> axes,
                                            const render::GlyphAtlas& atlas,
                                            const glm::mat4& room_from_model,
                                            std::span<const render::View> views);

} // namespace isochron::app
