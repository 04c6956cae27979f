// Reads and writes slices, what cuts the surfaces, and ghosts in links.
#include "app/explore/link_tools.h"

#include "app/config/first_placement.h"
#include "interaction/tools/clip_box.h"
#include "interaction/tools/plane_hold.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace isochron::app {
namespace {

constexpr std::size_t kMostLinkedCuts = 6; ///< planes that cut in a page

/// Planes, each as x/y/z and its unit normal; what is none is left out.
std::vector<interaction::Plane> planes_of(const std::string& text, std::size_t most) {
    std::vector<interaction::Plane> planes;
    for (const std::string_view one : split(text, ',')) {
        const auto n = numbers_of(one, '/');
        if (n.size() != 6 || !(glm::length(glm::dvec3(n[3], n[4], n[5])) > 0))
            continue;
        planes.push_back({{n[0], n[1], n[2]}, glm::normalize(glm::dvec3(n[3], n[4], n[5]))});
        if (planes.size() == most)
            break;
    }
    return planes;
}

std::string plane_word(const interaction::Plane& plane) {
    const auto& [point, normal, shown] = plane;
    return fmt::format("{:.9g}/{:.9g}/{:.9g}/{:.7g}/{:.7g}/{:.7g}", point.x, point.y, point.z,
                       normal.x, normal.y, normal.z);
}

/// The clip planes of a link: a list, or the one plane that earlier versions wrote.
std::vector<interaction::Plane> cuts_of(const LinkWords& settings) {
    std::string planes = word_of(settings, "planes");
    if (planes.empty()) {
        planes = word_of(settings, "plane");
        std::ranges::replace(planes, ',', '/');
    }
    return planes_of(planes, kMostLinkedCuts);
}

/// Cuts by planes: a state has one in any direction, and others across an axis are faces of its box. Of
/// several oblique ones the first cuts.
void cut_by(const std::vector<interaction::Plane>& planes, const index::SeriesInfo& info,
            ExplorerState& state) {
    const interaction::DataFrame data = data_frame(info);
    const auto axis_of = [&](const interaction::Plane& plane) {
        return interaction::axis_across(plane.normal, data);
    };
    const auto oblique =
        std::ranges::find_if(planes, [&](const auto& plane) { return !axis_of(plane); });
    const auto one = oblique == planes.end() ? planes.begin() : oblique;
    for (auto plane = planes.begin(); plane != planes.end(); ++plane) {
        const std::optional<int> axis = axis_of(*plane);
        if (plane == one) {
            state.clip = {true, plane->point, plane->normal};
        } else if (axis) {
            interaction::ClipBox& box = state.clip_box;
            if (!box.shown)
                box = interaction::whole_box(data);
            const bool high =
                glm::dot(plane->normal, glm::dvec3(data.physical_from_box[*axis])) > 0;
            const auto moved = interaction::with_face(box, {*axis, high}, *plane, data);
            box.low[*axis] = std::max(box.low[*axis], moved.low[*axis]);
            box.high[*axis] = std::min(box.high[*axis], moved.high[*axis]);
        }
    }
}

/// Sets what cuts the surfaces.
void cut_as_linked(ExplorerState& state, const LinkWords& settings, const index::SeriesInfo& info) {
    const index::Grid& grid = info.grid;
    const glm::dvec3 cells(grid.vertices[0] - 1.0, grid.vertices[1] - 1.0, grid.vertices[2] - 1.0);
    // The page of earlier versions clipped at a share of an axis.
    if (const auto clip = numbers_of(word_of(settings, "clip"));
        clip.size() == 2 && (clip[0] == 0 || clip[0] == 1 || clip[0] == 2) && clip[1] >= 0 &&
        clip[1] <= 1) {
        const int axis = static_cast<int>(clip[0]);
        glm::dvec4 at(0, 0, 0, 1), along(0);
        at[axis] = clip[1] * cells[axis];
        along[axis] = 1;
        const glm::dmat4 physical = grid.physical_from_index();
        state.clip = {true, glm::dvec3(physical * at),
                      glm::normalize(glm::dvec3(physical * along))};
    }
    if (const auto n = numbers_of(word_of(settings, "box")); n.size() == 6) {
        const glm::dvec3 none(0.0), low = glm::clamp(glm::dvec3(n[0], n[1], n[2]), none, cells),
                                    high = glm::clamp(glm::dvec3(n[3], n[4], n[5]), none, cells);
        if (glm::all(glm::lessThan(low, high)))
            state.clip_box = {true, low, high};
    }
    cut_by(cuts_of(settings), info, state);
}

/// The settings of what cuts the surfaces; empty: nothing does.
std::string words_of(const interaction::ClipPlane& clip, const interaction::ClipBox& box) {
    std::string words;
    if (clip.shown)
        words += "&planes=" + plane_word(interaction::Plane{clip.point, clip.normal});
    if (const auto& [shown, low, high] = box; shown)
        words += fmt::format("&box={:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}", low.x, low.y, low.z,
                             high.x, high.y, high.z);
    return words;
}

void ghosts_as_linked(interaction::Ghosts& ghosts, const LinkWords& settings) {
    const auto n = numbers_of(word_of(settings, "ghosts"), '/');
    const auto is_count = [&](std::size_t i, double low, double high) {
        return n[i] >= low && n[i] <= high && n[i] == std::floor(n[i]);
    };
    if (n.size() != 4 || !is_count(0, 0, interaction::kMostGhosts) ||
        !is_count(1, 0, interaction::kMostGhosts) || !is_count(2, 1, interaction::kWidestGhosts) ||
        n[3] < 0 || n[3] > 1)
        return;
    const auto count = [&](std::size_t i) { return static_cast<std::uint32_t>(n[i]); };
    const interaction::Ghosts linked{count(0), count(1), count(2), static_cast<float>(n[3])};
    if (linked.shown())
        ghosts = linked;
}

/// The setting of ghosts; empty: none are shown.
std::string words_of(const interaction::Ghosts& ghosts) {
    const auto& [earlier, later, every, opacity] = ghosts;
    return ghosts.shown() ? fmt::format("&ghosts={}/{}/{}/{:.3g}", earlier, later, every, opacity)
                          : std::string();
}

void slice_as_linked(interaction::Slices& slices, const LinkWords& settings,
                     const index::IndexFile& file) {
    const auto planes = planes_of(word_of(settings, "slices"), interaction::kMostSlices);
    if (planes.empty())
        return;
    slices = {.planes = planes};
    slices.isolines = word_of(settings, "isolines") != "0";
    slices.alone = word_of(settings, "alone") == "1";
    if (const auto number = number_in(settings, "sliceof");
        number && *number >= 0 && *number < static_cast<double>(file.arrays()))
        slices.coloring.array = file.array(static_cast<std::size_t>(*number)).info().array;
    color_as_linked(slices.coloring, settings, "slicemap", "slicerange");
}

/// The settings of slices; empty: none is seen.
std::string words_of(const interaction::Slices& slices, const index::IndexFile& file) {
    std::string list;
    for (const interaction::Plane& plane : slices.planes)
        if (plane.shown)
            list += (list.empty() ? "" : ",") + plane_word(plane);
    if (list.empty())
        return {};
    std::string words = fmt::format("&slices={}&slicemap={}", list, slices.coloring.map);
    if (!slices.coloring.array.empty())
        if (const auto number = file.array_called(slices.coloring.array))
            words += fmt::format("&sliceof={}", *number);
    if (const auto& range = slices.coloring.range)
        words += fmt::format("&slicerange={:.9g},{:.9g}", (*range)[0], (*range)[1]);
    return words + (slices.isolines ? "" : "&isolines=0") + (slices.alone ? "&alone=1" : "");
}

} // namespace

void tools_as_linked(ExplorerState& state, const LinkWords& settings,
                     const index::IndexFile& file) {
    slice_as_linked(state.slices, settings, file);
    cut_as_linked(state, settings, file.info());
    ghosts_as_linked(state.ghosts, settings);
}

std::string tool_words(const ExplorerState& state, const index::IndexFile& file) {
    return words_of(state.clip, state.clip_box) + words_of(state.ghosts) +
           words_of(state.slices, file);
}

std::string lost_of_link(const LinkWords& settings, const index::IndexFile& file) {
    const interaction::DataFrame data = data_frame(file.info());
    const auto oblique = std::ranges::count_if(cuts_of(settings), [&](const auto& plane) {
        return !interaction::axis_across(plane.normal, data);
    });
    return oblique < 2
               ? ""
               : fmt::format("the link has {} oblique clip planes; the first is shown", oblique);
}

} // namespace isochron::app
