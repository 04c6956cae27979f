// The data's axes in a corner of the picture, and a scale bar.
#include "app/scene/orientation.h"

#include "app/config/first_placement.h"
#include "app/scene/legend.h"
#include "app/text.h"
#include "interaction/navigation/navigation.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace isochron::app {
namespace {

constexpr std::array<glm::vec4, 3> kAxisColors{glm::vec4(0.95f, 0.42f, 0.38f, 1.0f),
                                               glm::vec4(0.50f, 0.85f, 0.45f, 1.0f),
                                               glm::vec4(0.45f, 0.65f, 1.0f, 1.0f)};
constexpr std::array<const char*, 3> kAxisNames{"x", "y", "z"};
// Heights of the text.
constexpr float kAxisLength = 2.6f, kLeastAxisLength = 1.2f;
constexpr float kLetterAt = 1.22f; ///< in lengths of an axis from the origin

/// The length of axes whose letters end below a height; 0: there is no room for any.
/// @param highest in heights of the text
float axis_length(float highest) {
    constexpr float kBelow = 1.0f, kHalfLetter = 0.6f;
    const float length = (highest - kBelow - kHalfLetter) / (1.0f + kLetterAt);
    return length >= kLeastAxisLength ? std::min(kAxisLength, length) : 0.0f;
}

struct SeenAxis {
    int axis;
    glm::vec3 way; ///< direction in the eye's frame, of length 1
};

std::array<SeenAxis, 3> seen_axes(const render::View& view, const glm::dquat& turn) {
    std::array<SeenAxis, 3> axes{};
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 unit(0.0);
        unit[axis] = 1;
        axes[static_cast<std::size_t>(axis)] = {axis, glm::mat3(view.eye_from_room) *
                                                          glm::vec3(turn * unit)};
    }
    std::ranges::sort(axes, {}, [](const SeenAxis& each) { return each.way.z; });
    return axes;
}

} // namespace

std::optional<ScaleBar> scale_bar(const render::View& view,
                                  const interaction::Similarity& room_from_physical,
                                  const glm::dvec3& center) {
    constexpr double kMostOfWidth = 0.2;
    const glm::dvec4 at(interaction::transform(room_from_physical, center), 1.0);
    const glm::dvec4 clip = glm::dmat4(view.clip_from_eye) * glm::dmat4(view.eye_from_room) * at;
    if (!(clip.w > 0))
        return std::nullopt;
    // Pixels per meter across the view, at the center's depth.
    const double meter = 0.5 * view.size.x * static_cast<double>(view.clip_from_eye[0][0]) / clip.w;
    const double unit = meter * room_from_physical.scale;
    const double most = kMostOfWidth * view.size.x / unit;
    if (!(most > 0) || !std::isfinite(most))
        return std::nullopt;
    const double power = std::pow(10.0, std::floor(std::log10(most)));
    const double digit = most / power >= 5 ? 5 : most / power >= 2 ? 2 : 1;
    return ScaleBar{digit * power, static_cast<float>(digit * power * unit)};
}

Orientation orientation_in(const render::View& view,
                           const interaction::Similarity& room_from_physical,
                           const index::SeriesInfo& info, const render::TextPass& text,
                           const OverlayColors& overlay, float share, float highest) {
    const float height = text_height(view.size, share);
    const float length = highest > 0.0f ? axis_length(highest / height) : kAxisLength;
    const glm::vec2 origin = glm::floor(glm::vec2((length + 1.0f) * height));
    Orientation shown;
    for (const SeenAxis& each : seen_axes(view, room_from_physical.rotation)) {
        const auto axis = static_cast<std::size_t>(each.axis);
        if (length == 0.0f)
            break;
        const glm::vec2 end = origin + length * height * glm::vec2(each.way);
        const glm::vec4 color(overlay.bright * glm::vec3(kAxisColors[axis]), 1.0f);
        shown.lines.push_back({glm::vec3(origin, 0), glm::vec3(end, 0), color});
        text.set({.text = kAxisNames[axis],
                  .at = glm::vec3(origin + kLetterAt * (end - origin), 0.0f),
                  .color = color,
                  .halo = overlay.halo()},
                 height, shown.quads);
    }
    const auto bar = scale_bar(view, room_from_physical, physical_center(info.grid));
    if (!bar)
        return shown;
    const glm::vec3 left(glm::floor(glm::vec2(origin.x + (length + 1.2f) * height, height)), 0.0f);
    const float pixels = std::round(bar->pixels);
    const float tick = std::round(0.25f * height),
                thick = std::max(1.0f, std::round(0.12f * height));
    for (const float rim : {std::max(1.0f, thick), 0.0f}) {
        const glm::vec4 color = rim > 0 ? overlay.halo() : overlay.text;
        const auto fill = [&](glm::vec2 low, glm::vec2 high) {
            text.fill(left, low - rim, high + rim, color, shown.quads);
        };
        fill({0, 0}, {pixels, thick});
        for (const float at : {0.0f, pixels - thick})
            fill({at, -tick}, {at + thick, tick + thick});
    }
    text.set({.text = human_number(bar->length) + with_space(info.length_unit),
              .at = left + glm::vec3(std::floor(0.5f * pixels), 0, 0),
              .anchor = {0.5f, 0.0f},
              .offset = {0.0f, 0.5f},
              .color = overlay.text,
              .halo = overlay.halo()},
             height, shown.quads);
    return shown;
}

} // namespace isochron::app
