// Words, lines and label of a picked place.
#include "app/scene/mark.h"

#include "app/scene/legend.h"
#include "app/text.h"

#include <fmt/format.h>

namespace isochron::app {
namespace {

constexpr float kArm = 0.6f, kHalfWidth = 0.07f, kRim = 0.07f; ///< of the cross, heights of text
constexpr glm::vec4 kColor(1.0f, 0.45f, 0.85f, 1.0f), kMarkInk(0.95f, 0.96f, 0.98f, 1.0f),
    kMarkPaper(0.05f, 0.06f, 0.07f, 0.78f);

std::string place_text(const interaction::MarkedPoint& point, const index::SeriesInfo& info) {
    const glm::dvec3& p = point.position;
    return fmt::format("{:.5g}, {:.5g}, {:.5g}{}", p.x, p.y, p.z, with_space(info.length_unit));
}

std::string time_text(const interaction::MarkedPoint& point, const index::SeriesInfo& info) {
    return with_unit(info.times[point.step], info.time_unit);
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
    const std::array lines{with_unit(point.value, info.value_unit), place_text(point, info),
                           "at " + time_text(point, info)};
    constexpr float kAside = 0.9f, kMargin = 0.4f, kLine = 1.15f; // heights of the text
    const float height = text_height(picture);
    float width = 0.0f;
    for (const std::string& line : lines)
        width = std::max(width, render::text_width(text.atlas(), line));
    const float top = kLine * static_cast<float>(lines.size());
    std::vector<render::ScreenQuad> quads;
    for (const float rim : {kRim, 0.0f})
        for (const bool upright : {false, true}) {
            const glm::vec2 arm(kArm + rim, kHalfWidth + rim);
            const glm::vec2 reach = height * (upright ? glm::vec2(arm.y, arm.x) : arm);
            text.fill(in_room, -reach, reach, rim > 0 ? kMarkPaper : kColor, quads);
        }
    text.fill(in_room, height * glm::vec2(kAside - kMargin, kAside - kMargin),
              height * glm::vec2(kAside + width + kMargin, kAside + top + kMargin), kMarkPaper,
              quads);
    for (std::size_t i = 0; i < lines.size(); ++i)
        text.set({.text = lines[i],
                  .at = in_room,
                  .anchor = {0.0f, 0.0f},
                  .offset = {kAside, kAside + top - kLine * static_cast<float>(i + 1)},
                  .color = i == 0 ? kColor : kMarkInk},
                 height, quads);
    return quads;
}

} // namespace isochron::app
