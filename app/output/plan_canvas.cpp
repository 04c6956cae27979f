// Draws a figure on the processor.
#include "app/output/plan_canvas.h"

#include "app/scene/font.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace isochron::app {
namespace {

constexpr int kFontPixels = 20;

float cross(glm::vec2 a, glm::vec2 b) {
    return a.x * b.y - a.y * b.x;
}

float distance_to_line(glm::vec2 place, glm::vec2 from, glm::vec2 to) {
    const glm::vec2 way = to - from;
    const float length = glm::dot(way, way);
    const float share =
        length > 0 ? std::clamp(glm::dot(place - from, way) / length, 0.0f, 1.0f) : 0.0f;
    return glm::distance(place, from + share * way);
}

} // namespace

PlanCanvas::PlanCanvas(glm::ivec2 size, glm::vec3 paper)
    : font_(room_font(kFontPixels)), clip_high_(size) {
    image_.width = size.x;
    image_.height = size.y;
    for (std::size_t i = 0; i < std::size_t{1} * size.x * size.y; ++i)
        for (const float channel : {paper.x, paper.y, paper.z, 1.0f})
            image_.rgba.push_back(static_cast<std::uint8_t>(std::lround(255 * channel)));
}

void PlanCanvas::clip(glm::vec2 low, glm::vec2 high) {
    const glm::vec2 end(image_.width, image_.height);
    clip_low_ = glm::clamp(low, glm::vec2(0), end);
    clip_high_ = glm::clamp(high, clip_low_, end);
}

template <class Coverage>
void PlanCanvas::blend(glm::vec2 low, glm::vec2 high, glm::vec4 color, const Coverage& coverage) {
    const glm::ivec2 first(glm::clamp(low, clip_low_, clip_high_)),
        last(glm::clamp(high + 1.0f, clip_low_, clip_high_));
    for (int y = first.y; y < last.y; ++y)
        for (int x = first.x; x < last.x; ++x) {
            const float share = color.w * coverage(glm::vec2(x, y) + 0.5f);
            std::uint8_t* pixel =
                image_.rgba.data() + 4 * (static_cast<std::size_t>(y) * image_.width + x);
            for (int i = 0; i < 3 && share > 0; ++i)
                pixel[i] = static_cast<std::uint8_t>(
                    std::lround(pixel[i] + share * (255 * color[i] - pixel[i])));
        }
}

void PlanCanvas::line(glm::vec2 from, glm::vec2 to, float width, glm::vec4 color) {
    const float reach = 0.5f * width + 1;
    blend(glm::min(from, to) - reach, glm::max(from, to) + reach, color, [&](glm::vec2 place) {
        return std::clamp(reach - 0.5f - distance_to_line(place, from, to), 0.0f, 1.0f);
    });
}

void PlanCanvas::dashed(glm::vec2 from, glm::vec2 to, float width, glm::vec4 color) {
    constexpr float kDash = 9, kStep = 16; // pixels
    const float length = glm::distance(from, to);
    const glm::vec2 way = length > 0 ? (to - from) / length : glm::vec2(0);
    for (float at = 0; at < length; at += kStep)
        line(from + at * way, from + std::min(at + kDash, length) * way, width, color);
}

void PlanCanvas::arrow(glm::vec2 from, glm::vec2 to, float width, glm::vec4 color) {
    if (glm::distance(from, to) < 1)
        return;
    const glm::vec2 way = glm::normalize(to - from), side(-way.y, way.x);
    const float head = 3.5f * width;
    line(from, to - head * way, width, color);
    const glm::vec2 tip[]{to, to - 2 * head * way + head * side, to - 2 * head * way - head * side};
    area(tip, color);
}

void PlanCanvas::area(std::span<const glm::vec2> corners, glm::vec4 color) {
    glm::vec2 low = corners.front(), high = corners.front();
    float turned = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        low = glm::min(low, corners[i]);
        high = glm::max(high, corners[i]);
        turned += cross(corners[i], corners[(i + 1) % corners.size()]);
    }
    if (turned == 0)
        return;
    blend(low - 1.0f, high + 1.0f, color, [&](glm::vec2 place) {
        float within = std::numeric_limits<float>::max();
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const glm::vec2 edge = corners[(i + 1) % corners.size()] - corners[i];
            if (const float length = glm::length(edge); length > 0)
                within = std::min(within, std::copysign(1.0f, turned) *
                                              cross(edge, place - corners[i]) / length);
        }
        return std::clamp(within + 0.5f, 0.0f, 1.0f);
    });
}

void PlanCanvas::words(glm::vec2 at, float height, const std::string& text, glm::vec4 color) {
    at = glm::round(at);
    for (const char32_t character : render::characters(text)) {
        const render::Glyph* glyph = font_.find(character);
        if (!glyph)
            continue;
        const glm::vec2 low = at + height * glyph->low, high = at + height * glyph->high;
        if (glyph->high.x > glyph->low.x)
            blend(low, high, color, [&](glm::vec2 place) {
                const glm::vec2 share = (place - low) / (high - low);
                if (share.x < 0 || share.y < 0 || share.x > 1 || share.y > 1)
                    return 0.0f;
                const glm::vec2 texel = glm::mix(glyph->texture_low, glyph->texture_high, share) *
                                            glm::vec2(font_.size) -
                                        0.5f;
                const glm::vec2 corner = glm::floor(texel), part = texel - corner;
                const auto value = [&](int x, int y) {
                    const glm::ivec2 where = glm::clamp(glm::ivec2(corner) + glm::ivec2(x, y),
                                                        glm::ivec2(0), font_.size - 1);
                    return font_.coverage[static_cast<std::size_t>(where.y) * font_.size.x +
                                          where.x] /
                           255.0f;
                };
                return glm::mix(glm::mix(value(0, 0), value(1, 0), part.x),
                                glm::mix(value(0, 1), value(1, 1), part.x), part.y);
            });
        at.x += height * glyph->advance;
    }
}

float PlanCanvas::width_of(const std::string& text, float height) const {
    return height * render::text_width(font_, text);
}

} // namespace isochron::app
