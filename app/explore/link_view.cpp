// Reads and writes the settings in links.
#include "app/explore/link_view.h"

#include "app/config/first_placement.h"
#include "interaction/tools/clip_box.h"
#include "interaction/tools/plane_hold.h"
#include "render/passes/color_map.h"

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

namespace isochron::app {
namespace {

using Words = std::map<std::string, std::string>;

constexpr std::size_t kMostLinkedCuts = 6; ///< planes that cut in a page

/// Half the height of the page's picture at distance 1: its camera sees 40 degrees.
const double kPageHalf = std::tan(glm::radians(20.0));

std::optional<double> number_of(std::string_view text) {
    double value = 0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
    return !text.empty() && read.ec == std::errc() && read.ptr == text.data() + text.size() &&
                   std::isfinite(value)
               ? std::optional(value)
               : std::nullopt;
}

std::vector<std::string_view> split(std::string_view text, char at) {
    std::vector<std::string_view> words;
    for (;;) {
        const std::size_t end = std::min(text.find(at), text.size());
        words.push_back(text.substr(0, end));
        if (end == text.size())
            return words;
        text.remove_prefix(end + 1);
    }
}

/// The numbers of a list; empty if one of them is none.
std::vector<double> numbers_of(std::string_view text) {
    std::vector<double> numbers;
    for (const std::string_view word : split(text, ','))
        if (const auto number = number_of(word))
            numbers.push_back(*number);
        else
            return {};
    return numbers;
}

std::optional<glm::vec3> color_of(std::string_view text) {
    std::uint32_t rgb = 0;
    if (text.starts_with('#'))
        text.remove_prefix(1);
    const auto read = std::from_chars(text.data(), text.data() + text.size(), rgb, 16);
    if (text.size() != 6 || read.ec != std::errc() || read.ptr != text.data() + text.size())
        return std::nullopt;
    return glm::vec3(rgb >> 16, rgb >> 8 & 255, rgb & 255) / 255.0f;
}
std::string hex_of(const glm::vec3& color) {
    const glm::ivec3 c = glm::ivec3(glm::round(glm::clamp(color, 0.0f, 1.0f) * 255.0f));
    return fmt::format("{:02x}{:02x}{:02x}", c.x, c.y, c.z);
}

const std::string& word_of(const Words& words, const std::string& name) {
    static const std::string none;
    const auto found = words.find(name);
    return found == words.end() ? none : found->second;
}
std::optional<double> number_in(const Words& words, const std::string& name) {
    return number_of(word_of(words, name));
}

/// How the screen shows what is in front of the head.
struct LinkSight {
    double half = 1;     ///< half the height of the picture at distance 1
    double distance = 1; ///< [m] to the screen
    glm::dmat3 room_from_eye{1.0};
    glm::dvec3 middle{0.0}; ///< middle of the screen, room space
};
LinkSight sight_of(const LinkScreen& of) {
    const render::View view =
        stereo::view_of(of.screen, of.head, stereo::Eye::center, 0, 0.05f, 50.0f, of.pixels);
    const glm::dmat4 eye_from_room(view.eye_from_room);
    glm::dvec3 middle(0.0);
    for (const glm::vec3& corner : stereo::corners_in_room(of.screen, of.head, of.pixels))
        middle += glm::dvec3(corner) / 4.0;
    return {.half = 1 / static_cast<double>(view.clip_from_eye[1][1]),
            .distance = std::max(0.1, -(eye_from_room * glm::dvec4(middle, 1)).z),
            .room_from_eye = glm::transpose(glm::dmat3(eye_from_room)),
            .middle = middle};
}

/// The axes of a camera of the page: right, up, and back to the viewer.
/// @param wanted what is up in its picture
glm::dmat3 page_axes(const glm::dvec3& back, const glm::dvec3& wanted = {0, 0, 1}) {
    const auto along = [&](const glm::dvec3& up) {
        return glm::length(glm::cross(up, back)) < 1e-9;
    };
    const glm::dvec3 up = !along(wanted)                ? wanted
                          : !along(glm::dvec3{0, 0, 1}) ? glm::dvec3(0, 0, 1)
                                                        : glm::dvec3(0, 1, 0);
    const glm::dvec3 right = glm::normalize(glm::cross(up, back));
    return {right, glm::cross(back, right), back};
}

/// @param up in the picture; empty: the data's z
void see_as_linked(ExplorerState& state, const std::vector<double>& view,
                   const std::vector<double>& up, const index::IndexFile& file,
                   const LinkScreen& screen) {
    const glm::dvec3 origin = file.info().grid.origin; // where the page's points count from
    const glm::dvec3 eye = glm::dvec3(view[0], view[1], view[2]) + origin,
                     target = glm::dvec3(view[3], view[4], view[5]) + origin;
    const double distance = glm::distance(eye, target);
    if (!(distance > 0) || !std::isfinite(distance))
        return;
    const LinkSight sight = sight_of(screen);
    interaction::Similarity& seen = state.room_from_physical;
    const interaction::Similarity before = seen;
    seen.exaggeration = 1;
    const glm::dvec3 wanted = up.size() == 3 ? glm::dvec3(up[0], up[1], up[2]) : glm::dvec3(0);
    const double length = glm::length(wanted);
    seen.rotation = glm::normalize(glm::quat_cast(
        sight.room_from_eye *
        glm::transpose(page_axes((eye - target) / distance,
                                 length > 0 ? wanted / length : glm::dvec3(0, 0, 1)))));
    // At the target the page's picture is as large as this one.
    seen.scale = sight.distance * sight.half / (distance * kPageHalf);
    seen.translation = sight.middle - seen.scale * (seen.rotation * target);
    if (!std::isfinite(seen.scale) || seen.scale <= 0)
        seen = before;
}

/// Adds the surfaces of a list, as many as there may be.
void add_surfaces(const std::string& text, const index::IndexFile& file,
                  std::vector<interaction::Isosurface>& surfaces) {
    for (const std::string_view one : split(text, ',')) {
        const auto words = split(one, '/');
        const auto isovalue = number_of(words[0]);
        if (!isovalue || surfaces.size() == interaction::kMostIsosurfaces)
            break;
        interaction::Isosurface surface{.isovalue = *isovalue};
        if (words.size() > 1)
            surface.color = color_of(words[1]).value_or(surface.color);
        if (const auto opacity = words.size() > 2 ? number_of(words[2]) : std::nullopt)
            surface.opacity = static_cast<float>(std::clamp(*opacity, 0.0, 1.0));
        if (const auto array = words.size() > 3 ? number_of(words[3]) : std::nullopt;
            array && *array >= 0 && *array < static_cast<double>(file.arrays()))
            surface.array = file.array(static_cast<std::size_t>(*array)).info().array;
        surfaces.push_back(surface);
    }
}

/// `isovalue/color/opacity`, and the number of the array where it is not the shown one.
std::string word_of(const interaction::Isosurface& surface, const index::IndexFile& file) {
    std::string word =
        fmt::format("{:.9g}/{}/{:.3g}", surface.isovalue, hex_of(surface.color), surface.opacity);
    if (!surface.of_shown_array())
        word += fmt::format("/{}", file.array_called(surface.array).value_or(0));
    return word;
}

/// Planes, each as x/y/z and its unit normal; what is none is left out.
std::vector<interaction::Plane> planes_of(const std::string& text, std::size_t most) {
    std::vector<interaction::Plane> planes;
    for (const std::string_view one : split(text, ',')) {
        std::string word(one);
        std::ranges::replace(word, '/', ',');
        const auto n = numbers_of(word);
        if (n.size() != 6 || !(glm::length(glm::dvec3(n[3], n[4], n[5])) > 0))
            continue;
        planes.push_back({{n[0], n[1], n[2]}, glm::normalize(glm::dvec3(n[3], n[4], n[5]))});
        if (planes.size() == most)
            break;
    }
    return planes;
}

std::string word_of(const interaction::Plane& plane) {
    const auto& [point, normal, shown] = plane;
    return fmt::format("{:.9g}/{:.9g}/{:.9g}/{:.7g}/{:.7g}/{:.7g}", point.x, point.y, point.z,
                       normal.x, normal.y, normal.z);
}

/// The clip planes of a link: a list, or the one plane that earlier versions wrote.
std::vector<interaction::Plane> cuts_of(const Words& settings) {
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
void cut_as_linked(ExplorerState& state, const Words& settings, const index::SeriesInfo& info) {
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
        words += "&planes=" + word_of(interaction::Plane{clip.point, clip.normal});
    if (const auto& [shown, low, high] = box; shown)
        words += fmt::format("&box={:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}", low.x, low.y, low.z,
                             high.x, high.y, high.z);
    return words;
}

void ghosts_as_linked(interaction::Ghosts& ghosts, const Words& settings) {
    std::string word = word_of(settings, "ghosts");
    std::ranges::replace(word, '/', ',');
    const auto n = numbers_of(word);
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

/// Sets the map and its range. @param map, range names of the settings
void color_as_linked(interaction::Coloring& coloring, const Words& settings, const std::string& map,
                     const std::string& range) {
    if (const auto known = render::color_map_from_name(word_of(settings, map)))
        coloring.map = render::name_of(*known);
    if (const auto ends = numbers_of(word_of(settings, range));
        ends.size() == 2 && ends[0] < ends[1])
        coloring.range = {ends[0], ends[1]};
}

void slice_as_linked(interaction::Slices& slices, const Words& settings,
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
            list += (list.empty() ? "" : ",") + word_of(plane);
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

std::size_t array_of_link(const Words& settings, const index::IndexFile& file) {
    const auto number = number_in(settings, "array");
    return number && *number >= 0 && *number < static_cast<double>(file.arrays())
               ? static_cast<std::size_t>(*number)
               : 0;
}

ExplorerState as_linked(ExplorerState state, const Words& settings, const index::IndexFile& file,
                        const LinkScreen& screen) {
    const std::size_t steps = file.info().steps();
    std::vector<interaction::Isosurface> surfaces;
    add_surfaces(word_of(settings, "surfaces"), file, surfaces);
    if (!surfaces.empty()) {
        add_surfaces(word_of(settings, "further"), file, surfaces);
        state.isosurfaces = std::move(surfaces);
        state.picked = 0;
    } else {
        state.set_isovalue(number_in(settings, "isovalue").value_or(state.isovalue()));
        interaction::Isosurface& surface = state.isosurfaces[state.picked];
        surface.color = color_of(word_of(settings, "color")).value_or(surface.color);
        if (const auto opacity = number_in(settings, "opacity"))
            surface.opacity = static_cast<float>(std::clamp(*opacity, 0.0, 1.0));
    }
    if (const auto picked = number_in(settings, "picked");
        picked && *picked >= 0 && *picked < static_cast<double>(state.isosurfaces.size()))
        state.picked = static_cast<std::uint32_t>(*picked);
    if (const auto step = number_in(settings, "step");
        step && *step >= 0 && *step < static_cast<double>(steps)) {
        const double share = std::floor(number_in(settings, "fraction").value_or(0));
        const bool blends = share > 0 && share < index::Instant::kFractions &&
                            *step + 1 < static_cast<double>(steps);
        state.instant = {static_cast<std::uint32_t>(*step),
                         blends ? static_cast<std::uint32_t>(share) : 0};
        if (blends)
            state.between = interaction::BetweenSteps::blend;
    }
    if (const auto number = number_in(settings, "colors");
        number && *number >= 0 && *number < static_cast<double>(file.arrays())) {
        state.coloring.by = interaction::ColorBy::value;
        state.coloring.array = file.array(static_cast<std::size_t>(*number)).info().array;
        color_as_linked(state.coloring, settings, "map", "range");
    }
    slice_as_linked(state.slices, settings, file);
    cut_as_linked(state, settings, file.info());
    ghosts_as_linked(state.ghosts, settings);
    if (const auto view = numbers_of(word_of(settings, "view")); view.size() == 6)
        see_as_linked(state, view, numbers_of(word_of(settings, "up")), file, screen);
    return state;
}

std::string lost_of_link(const Words& settings, const index::IndexFile& file) {
    const interaction::DataFrame data = data_frame(file.info());
    const auto oblique = std::ranges::count_if(cuts_of(settings), [&](const auto& plane) {
        return !interaction::axis_across(plane.normal, data);
    });
    return oblique < 2
               ? ""
               : fmt::format("the link has {} oblique clip planes; the first is shown", oblique);
}

std::string link_to(const std::string& address, const ExplorerState& state,
                    const index::IndexFile& file, const LinkScreen& screen) {
    const interaction::Similarity& seen = state.room_from_physical;
    const LinkSight sight = sight_of(screen);
    const auto to_physical = [&](const glm::dvec3& room) {
        return glm::conjugate(seen.rotation) * ((room - seen.translation) / seen.scale);
    };
    const glm::dvec3 back = sight.room_from_eye[2];
    const glm::dvec3 target = to_physical(sight.middle);
    const double distance = sight.distance * sight.half / kPageHalf / seen.scale;
    const glm::dvec3 to = target - file.info().grid.origin,
                     eye = to + glm::conjugate(seen.rotation) * back * distance;
    // A page shows those of one array, and counts the picked one among them.
    std::string surfaces, further;
    std::size_t picked = 0, count = 0;
    double isovalue = state.isovalue();
    for (std::size_t i = 0; i < state.isosurfaces.size(); ++i) {
        const interaction::Isosurface& each = state.isosurfaces[i];
        std::string& list = each.of_shown_array() ? surfaces : further;
        list += (list.empty() ? "" : ",") + word_of(each, file);
        if (!each.of_shown_array())
            continue;
        if (i == state.picked || count == 0) {
            picked = count;
            isovalue = each.isovalue;
        }
        ++count;
    }
    std::string link =
        fmt::format("{}#array={}&step={}&isovalue={:.9g}&surfaces={}&picked={}&view="
                    "{:.7g},{:.7g},{:.7g},{:.7g},{:.7g},{:.7g}",
                    address, file.array_called(state.array).value_or(0), state.shown_instant().step,
                    isovalue, surfaces, picked, eye.x, eye.y, eye.z, to.x, to.y, to.z);
    if (!further.empty())
        link += "&further=" + further;
    if (const std::uint32_t fraction = state.shown_instant().fraction)
        link += fmt::format("&fraction={}", fraction);
    constexpr double kTilted = 1e-4, kDigits = 1e7;
    const glm::dvec3 up = glm::conjugate(seen.rotation) * sight.room_from_eye[1],
                     said = glm::round(up * kDigits) / kDigits + 0.0; // no -0
    const glm::dmat3 upright = page_axes(glm::conjugate(seen.rotation) * back);
    if (glm::distance(up, upright[1]) > kTilted)
        link += fmt::format("&up={:.7g},{:.7g},{:.7g}", said.x, said.y, said.z);
    link += words_of(state.clip, state.clip_box) + words_of(state.ghosts);
    link += words_of(state.slices, file);
    if (state.coloring.by == interaction::ColorBy::value)
        if (const auto number = file.array_called(state.coloring.array)) {
            link += fmt::format("&colors={}&map={}", *number, state.coloring.map);
            if (const auto& range = state.coloring.range)
                link += fmt::format("&range={:.9g},{:.9g}", (*range)[0], (*range)[1]);
        }
    return link;
}

} // namespace isochron::app
