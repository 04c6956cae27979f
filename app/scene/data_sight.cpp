// Where the data and their surfaces lie in the view of the eyes.
#include "app/scene/data_sight.h"

#include <glm/common.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <limits>

namespace isochron::app {
namespace {

using Cell = std::array<std::uint32_t, 3>; ///< coordinates of its lowest vertex

/// Calls `visit` with every cell of the visible surfaces until it returns false.
/// @return false if it did, or where the cells are of coarser levels
template <class Visit>
bool each_cell(const index::Extraction& cells, const index::Grid& grid, std::uint32_t visible,
               const Visit& visit) {
    if (cells.coarse() || index::has_wide_ids(grid))
        return false;
    for (std::size_t i = 0; i < cells.surfaces.size(); ++i)
        if (visible & std::uint32_t{1} << i)
            for (const index::CellId id : cells.surfaces[i].ids)
                if (!visit(grid.cell_of(id)))
                    return false;
    return true;
}

/// @param low, high vertices at opposite ends, index space
BoxCorners corners_between(const index::Grid& grid, const glm::dvec3& low, const glm::dvec3& high) {
    BoxCorners corners;
    for (int i = 0; i < 8; ++i)
        corners[static_cast<std::size_t>(i)] =
            grid.physical({i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z});
    return corners;
}

} // namespace

BoxCorners corners_of(const index::Grid& grid) {
    return corners_between(
        grid, glm::dvec3(0.0),
        {grid.vertices[0] - 1.0, grid.vertices[1] - 1.0, grid.vertices[2] - 1.0});
}

std::optional<BoxCorners> corners_of(const index::Extraction& cells, const index::Grid& grid,
                                     std::uint32_t visible) {
    constexpr std::uint32_t kMost = std::numeric_limits<std::uint32_t>::max();
    Cell low{kMost, kMost, kMost}, high{0, 0, 0};
    const bool all = each_cell(cells, grid, visible, [&](const Cell& cell) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            low[axis] = std::min(low[axis], cell[axis]);
            high[axis] = std::max(high[axis], cell[axis]);
        }
        return true;
    });
    if (!all || low[0] > high[0])
        return std::nullopt;
    return corners_between(grid, {low[0], low[1], low[2]},
                           {high[0] + 1.0, high[1] + 1.0, high[2] + 1.0});
}

bool is_cut_away(const index::Extraction& cells, const index::Grid& grid, std::uint32_t visible,
                 std::span<const interaction::ClipPlane> cuts) {
    if (cuts.empty())
        return false;
    const auto is_away = [&](const BoxCorners& corners) {
        return std::ranges::any_of(cuts, [&](const interaction::ClipPlane& cut) {
            return std::ranges::all_of(corners,
                                       [&](const glm::dvec3& at) { return cut.beyond(at) > 0; });
        });
    };
    return is_away(corners_of(grid)) || each_cell(cells, grid, visible, [&](const Cell& cell) {
               const glm::dvec3 low{cell[0], cell[1], cell[2]};
               return is_away(corners_between(grid, low, low + 1.0));
           });
}

Sight sight_of(const BoxCorners& box, const interaction::Similarity& room_from_physical,
               std::span<const render::View> views) {
    constexpr float kLeastPixels = 2.0f;
    if (views.empty())
        return Sight::in_view;
    const glm::dmat4 room = interaction::matrix(room_from_physical);
    bool all_behind = true, all_outside = true, all_small = true;
    for (const render::View& view : views) {
        const glm::mat4 clip = view.clip_from_eye * view.eye_from_room;
        std::array<glm::vec4, 8> at;
        std::ranges::transform(box, at.begin(), [&](const glm::dvec3& corner) {
            return clip * glm::vec4(room * glm::dvec4(corner, 1.0));
        });
        const auto all = [&](const auto& is) { return std::ranges::all_of(at, is); };
        const bool behind = all([](const glm::vec4& p) { return p.w <= 0 || p.z < -p.w; });
        bool outside = behind || all([](const glm::vec4& p) { return p.z > p.w; });
        for (int axis = 0; axis < 2; ++axis)
            outside = outside || all([&](const glm::vec4& p) { return p[axis] > p.w; }) ||
                      all([&](const glm::vec4& p) { return p[axis] < -p.w; });
        bool small = all([](const glm::vec4& p) { return p.w > 0; });
        if (small) {
            glm::vec2 low = glm::vec2(at[0]) / at[0].w, high = low;
            for (const glm::vec4& p : at) {
                low = glm::min(low, glm::vec2(p) / p.w);
                high = glm::max(high, glm::vec2(p) / p.w);
            }
            const glm::vec2 pixels = 0.5f * (high - low) * glm::vec2(view.size);
            small = std::max(pixels.x, pixels.y) < kLeastPixels;
        }
        all_behind = all_behind && behind;
        all_outside = all_outside && outside;
        all_small = all_small && small;
    }
    return all_behind    ? Sight::behind
           : all_outside ? Sight::out_of_view
           : all_small   ? Sight::too_small
                         : Sight::in_view;
}

} // namespace isochron::app
