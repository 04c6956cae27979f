// Ticks, numbers and titles along the edges of the volume's box.
#include "app/scene/axes.h"

#include "app/scene/ticks.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace isochron::app {
namespace {

constexpr float kTickLength = 0.02f; ///< share of the longest side
constexpr int kMostTicks = 6;        ///< along the longest side
constexpr float kLeftness = 0.35f;   ///< weight of being left, relative to being low

glm::vec3 in_room(const render::Placement& placement, const glm::vec3& at) {
    return glm::vec3(placement.room_from_index * glm::vec4(at, 1.0f));
}

glm::vec3 edge_middle(int axis, const EdgeSides& sides, const glm::vec3& extent) {
    glm::vec3 middle = 0.5f * extent;
    for (int i = 0; i < 2; ++i) {
        const int other = (axis + 1 + i) % 3;
        middle[other] = sides[i] ? extent[other] : 0.0f;
    }
    return middle;
}

/// Lengths of the box's sides in the room.
glm::vec3 side_lengths(const render::Placement& placement) {
    glm::vec3 lengths;
    for (int axis = 0; axis < 3; ++axis)
        lengths[axis] =
            placement.extent[axis] * glm::length(glm::vec3(placement.room_from_index[axis]));
    return lengths;
}

/// The part of a line that lies in all views, as shares of its length; empty: none of it does.
std::optional<std::array<double, 2>> seen_part(const glm::vec3& from, const glm::vec3& to,
                                               const render::Placement& placement,
                                               std::span<const render::View> views) {
    constexpr double kInside = 0.97; // share of a view's width and height
    double low = 0, high = 1;
    for (const render::View& view : views) {
        const glm::mat4 clip =
            view.steady().clip_from_eye * view.eye_from_room * placement.room_from_index;
        const glm::dvec4 a(clip * glm::vec4(from, 1)), b(clip * glm::vec4(to, 1));
        for (const int axis : {0, 1})
            for (const double side : {-1.0, 1.0}) {
                const double at_a = kInside * a.w + side * a[axis];
                const double at_b = kInside * b.w + side * b[axis];
                if (at_a <= 0 && at_b <= 0)
                    return std::nullopt;
                if (at_a < 0)
                    low = std::max(low, at_a / (at_a - at_b));
                if (at_b < 0)
                    high = std::min(high, at_a / (at_a - at_b));
            }
    }
    return low < high ? std::optional(std::array{low, high}) : std::nullopt;
}

/// Ticks of an axis, of which at least two are in the part that is seen.
Ticks ticks_of(const AxisScale& scale, const std::array<double, 2>& seen, int most) {
    const auto at = [&](double share) { return scale.low + share * (scale.high - scale.low); };
    const auto [low, high] = std::minmax({scale.low, scale.high});
    const auto [first, last] = std::minmax({at(seen[0]), at(seen[1])});
    Ticks ticks = nice_ticks(low, high, most);
    constexpr int kNearlyAlways = 8;
    for (int finer = 2; finer <= kNearlyAlways; ++finer) {
        const double rim = 1e-9 * (last - first);
        const auto count = std::ranges::count_if(ticks.values, [&](double value) {
            return value >= first - rim && value <= last + rim;
        });
        if (count >= 2)
            break;
        ticks = nice_ticks(first, last, finer);
    }
    return ticks;
}

/// A direction in the viewer's picture (x right, y up), of length 1; labels lean that way, away
/// from the box.
glm::vec2 on_view(const glm::vec3& direction, const interaction::Pose& head) {
    const glm::vec3 seen = glm::inverse(head.orientation) * direction;
    const float length = glm::length(glm::vec2(seen));
    return length > 1e-6f ? glm::vec2(seen) / length : glm::vec2(0.0f, -1.0f);
}

} // namespace

AxisScale axis_scale(const index::SeriesInfo& info, int axis) {
    const index::Grid& grid = info.grid;
    const std::string unit = info.length_unit.empty() ? "" : fmt::format(" [{}]", info.length_unit);
    const auto titled = [&](int physical) {
        const std::string& name = info.axis_names[static_cast<std::size_t>(physical)];
        if (name.ends_with(')')) // a unit of its own
            return name;
        return (name.empty() ? std::string(1, "xyz"[physical]) : name) + unit;
    };
    const double length = grid.spacing[axis] * (grid.vertices[axis] - 1);
    for (int physical = 0; physical < 3; ++physical) {
        const double along = grid.direction[axis][physical];
        constexpr double kParallel = 1.0 - 1e-6;
        if (std::abs(along) > kParallel)
            return {titled(physical), grid.origin[physical],
                    grid.origin[physical] + std::copysign(length, along)};
    }
    return {fmt::format("{}{}", "ijk"[axis], unit), 0.0, length};
}

std::optional<EdgeSides> labeled_edge(int axis, const render::Placement& placement,
                                      const interaction::Pose& head) {
    const glm::vec3 eye(glm::inverse(placement.room_from_index) * glm::vec4(head.position, 1.0f));
    const glm::vec3 center = in_room(placement, 0.5f * placement.extent);
    const auto faces_viewer = [&](int face_axis, bool far) {
        return far ? eye[face_axis] > placement.extent[face_axis] : eye[face_axis] < 0.0f;
    };
    std::optional<EdgeSides> best;
    float best_score = 0.0f;
    for (int edge = 0; edge < 4; ++edge) {
        const EdgeSides sides{(edge & 1) != 0, (edge & 2) != 0};
        if (faces_viewer((axis + 1) % 3, sides[0]) == faces_viewer((axis + 2) % 3, sides[1]))
            continue;
        const glm::vec3 seen =
            glm::inverse(head.orientation) *
            (in_room(placement, edge_middle(axis, sides, placement.extent)) - center);
        const float score = -seen.y - kLeftness * seen.x;
        if (!best || score > best_score) {
            best = sides;
            best_score = score;
        }
    }
    return best;
}

Axes axes_for(const index::SeriesInfo& info, const render::Placement& placement,
              const interaction::Pose& head, std::span<const render::View> views) {
    Axes axes;
    const glm::vec3 lengths = side_lengths(placement);
    const float longest = std::max({lengths.x, lengths.y, lengths.z});
    const glm::mat3 index_from_room = glm::inverse(glm::mat3(placement.room_from_index));
    for (int axis = 0; axis < 3; ++axis) {
        const auto sides = labeled_edge(axis, placement, head);
        if (!sides)
            continue;
        AxisScale scale = axis_scale(info, axis);
        const double higher = glm::length(placement.room_from_physical[2]) /
                              glm::length(placement.room_from_physical[0]);
        if (std::abs(info.grid.direction[axis].z) > 0.5 && std::abs(higher - 1) > 1e-4)
            scale.title += fmt::format(", {:.3g}x", higher);
        const int most = std::max(2, static_cast<int>(kMostTicks * lengths[axis] / longest));
        const glm::vec3 middle = edge_middle(axis, *sides, placement.extent);
        const glm::vec3 outwards = glm::normalize(in_room(placement, middle) -
                                                  in_room(placement, 0.5f * placement.extent));
        const glm::vec3 tick = index_from_room * (kTickLength * longest * outwards);
        glm::vec3 begin = middle, end = middle;
        begin[axis] = 0.0f;
        end[axis] = placement.extent[axis];
        const auto seen = seen_part(begin + 1.4f * tick, end + 1.4f * tick, placement, views);
        if (!seen)
            continue;
        const Ticks ticks = ticks_of(scale, *seen, most);
        const glm::vec2 away = on_view(outwards, head);
        const glm::vec2 anchor =
            0.5f - 0.5f * away; // the side of the text that is next to the tick
        std::size_t widest = 0;
        AxisLabels& labels = axes.labels.emplace_back();
        for (const double value : ticks.values) {
            glm::vec3 at = middle;
            at[axis] = placement.extent[axis] *
                       static_cast<float>((value - scale.low) / (scale.high - scale.low));
            axes.ticks.push_back({at, at + tick});
            const std::string text = tick_text(value, ticks.step);
            widest = std::max(widest, text.size());
            labels.numbers.push_back(
                {.label = {.text = text, .at = at + 1.4f * tick, .anchor = anchor},
                 .multiple = std::llround(value / ticks.step)});
        }
        // The title stands beyond the numbers: below, above or beside them, whichever is nearer.
        const glm::vec2 room(0.6f * static_cast<float>(widest) + 0.8f, 1.3f);
        const glm::vec2 ways = room / glm::max(glm::abs(away), glm::vec2(1e-3f));
        const auto share = static_cast<float>(0.5 * ((*seen)[0] + (*seen)[1]));
        labels.title = {.text = scale.title,
                        .at = glm::mix(begin, end, share) + 1.4f * tick,
                        .anchor = anchor,
                        .offset = away * std::min(ways.x, ways.y)};
    }
    return axes;
}

} // namespace isochron::app
