// Words, lines and label of a picked place.
#include "app/scene/mark.h"

#include "app/scene/legend.h"
#include "app/text.h"
#include "index/volume/time_unit.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace isochron::app {
namespace {

constexpr float kArm = 0.6f, kHalfWidth = 0.07f, kRim = 0.07f,
                kDot = 0.12f; ///< of the cross, heights of text
constexpr glm::vec4 kColor(1.0f, 0.45f, 0.85f, 1.0f), kMarkInk(0.95f, 0.96f, 0.98f, 1.0f),
    kMarkPaper(0.05f, 0.06f, 0.07f, 0.78f);

std::string place_text(const interaction::MarkedPoint& point, const index::SeriesInfo& info) {
    const glm::dvec3& p = point.position;
    return fmt::format("{:.5g}, {:.5g}, {:.5g}{}", p.x, p.y, p.z, with_space(info.length_unit));
}

std::string time_text(const interaction::MarkedPoint& point, const index::SeriesInfo& info) {
    return index::time_text(info.times, point.step, info.time_unit);
}

/// Lines of text on their paper, right above the point.
/// @param first color of the first line @param height of the text, pixels
void read_out(std::span<const std::string> lines, const glm::vec4& first, const glm::vec3& in_room,
              const render::TextPass& text, float height, std::vector<render::ScreenQuad>& quads) {
    constexpr float kOff = 0.9f, kPad = 0.4f, kRow = 1.15f; // heights of the text
    float width = 0.0f;
    for (const std::string& line : lines)
        width = std::max(width, render::text_width(text.atlas(), line));
    const float top = kRow * static_cast<float>(lines.size());
    text.fill(in_room, height * glm::vec2(kOff - kPad, kOff - kPad),
              height * glm::vec2(kOff + width + kPad, kOff + top + kPad), kMarkPaper, quads);
    for (std::size_t i = 0; i < lines.size(); ++i)
        text.set({.text = lines[i],
                  .at = in_room,
                  .anchor = {0.0f, 0.0f},
                  .offset = {kOff, kOff + top - kRow * static_cast<float>(i + 1)},
                  .color = i == 0 ? first : kMarkInk},
                 height, quads);
}

} // namespace

std::string mark_text(const interaction::MarkedPoint& point, const index::SeriesInfo& info) {
    return fmt::format("{}: {} at {}", place_text(point, info),
                       with_unit(point.value, info.value_unit), time_text(point, info));
}

std::vector<render::ScreenQuad> mark_quads(const interaction::MarkedPoint& point,
                                           const glm::vec3& in_room, const index::SeriesInfo& info,
                                           const render::TextPass& text,
                                           const glm::ivec2& picture) {
    const float height = text_height(picture);
    std::vector<render::ScreenQuad> quads;
    for (const float rim : {kRim, 0.0f})
        for (const bool upright : {false, true}) {
            const glm::vec2 arm(kArm + rim, kHalfWidth + rim);
            const glm::vec2 reach = height * (upright ? glm::vec2(arm.y, arm.x) : arm);
            text.fill(in_room, -reach, reach, rim > 0 ? kMarkPaper : kColor, quads);
        }
    const std::array lines{with_unit(point.value, info.value_unit), place_text(point, info),
                           "at " + time_text(point, info)};
    read_out(lines, kColor, in_room, text, height, quads);
    return quads;
}

std::vector<render::ScreenQuad> pointed_quads(const interaction::Pointed& pointed,
                                              std::span<const interaction::Isosurface> surfaces,
                                              const glm::vec3& in_room,
                                              const index::SeriesInfo& info,
                                              const render::TextPass& text,
                                              const glm::ivec2& picture) {
    const interaction::MarkedPoint& point = pointed.point;
    std::vector<std::string> lines{with_unit(point.value, info.value_unit),
                                   place_text(point, info)};
    if (surfaces.size() > 1)
        lines.push_back(fmt::format("surface {} of {}", pointed.surface + 1, surfaces.size()));
    const float height = text_height(picture);
    const glm::vec2 dot(height * kDot), rim(height * (kDot + kRim));
    std::vector<render::ScreenQuad> quads;
    text.fill(in_room, -rim, rim, kMarkPaper, quads);
    text.fill(in_room, -dot, dot, kMarkInk, quads);
    read_out(lines, glm::vec4(surfaces[pointed.surface].color, 1.0f), in_room, text, height, quads);
    return quads;
}

void add_label(const std::string& words, const glm::vec3& in_room, const render::TextPass& text,
               const glm::ivec2& picture, std::vector<render::ScreenQuad>& quads) {
    const float height = text_height(picture);
    const glm::vec2 half =
        height * glm::vec2(render::text_width(text.atlas(), words) / 2 + 0.4f, 0.8f);
    text.fill(in_room, -half, half, kMarkPaper, quads);
    text.set({.text = words, .at = in_room, .color = kMarkInk}, height, quads);
}

} // namespace isochron::app
