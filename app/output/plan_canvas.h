// A picture that is drawn by the processor: lines, areas and words of a figure, with soft edges.
#pragma once

#include "render/gl/image.h"
#include "render/passes/glyph_atlas.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <span>
#include <string>

namespace isochron::app {

/// Places are pixels from the upper left; colors are sRGB with opacity.
class PlanCanvas {
  public:
    PlanCanvas(glm::ivec2 size, glm::vec3 paper);

    /// A line with round ends; a disk where both ends are the same.
    void line(glm::vec2 from, glm::vec2 to, float width, glm::vec4 color);
    void dashed(glm::vec2 from, glm::vec2 to, float width, glm::vec4 color);
    void arrow(glm::vec2 from, glm::vec2 to, float width, glm::vec4 color);
    /// A convex area, its corners in either order.
    void area(std::span<const glm::vec2> corners, glm::vec4 color);
    /// Words whose upper left corner is at a place. @param height of a line, pixels
    void words(glm::vec2 at, float height, const std::string& text, glm::vec4 color);
    /// Nothing is drawn outside of a rectangle from now on.
    void clip(glm::vec2 low, glm::vec2 high);
    void clip_nothing() { clip(glm::vec2(0), glm::vec2(image_.width, image_.height)); }
    float width_of(const std::string& text, float height) const;

    const render::Image& image() const { return image_; }

  private:
    /// Calls `coverage(pixel's middle)`, 0 to 1, for each pixel of a rectangle, and blends.
    template <class Coverage>
    void blend(glm::vec2 low, glm::vec2 high, glm::vec4 color, const Coverage& coverage);

    render::Image image_;
    render::GlyphAtlas font_;
    glm::vec2 clip_low_{0.0f}, clip_high_;
};

} // namespace isochron::app
