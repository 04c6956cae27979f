// Reads and writes the settings in links.
#include "app/explore/link_view.h"

#include "app/explore/link_tools.h"
#include "app/explore/link_words.h"

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

namespace isochron::app {
namespace {

/// Half the height of the page's picture at distance 1: its camera sees 40 degrees.
const double kPageHalf = std::tan(glm::radians(20.0));

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
std::string surface_word(const interaction::Isosurface& surface, const index::IndexFile& file) {
    std::string word =
        fmt::format("{:.9g}/{}/{:.3g}", surface.isovalue, hex_of(surface.color), surface.opacity);
    if (!surface.of_shown_array())
        word += fmt::format("/{}", file.array_called(surface.array).value_or(0));
    return word;
}

} // namespace

std::size_t array_of_link(const LinkWords& settings, const index::IndexFile& file) {
    const auto number = number_in(settings, "array");
    return number && *number >= 0 && *number < static_cast<double>(file.arrays())
               ? static_cast<std::size_t>(*number)
               : 0;
}

ExplorerState as_linked(ExplorerState state, const LinkWords& settings,
                        const index::IndexFile& file, const LinkScreen& screen) {
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
    tools_as_linked(state, settings, file);
    if (const auto view = numbers_of(word_of(settings, "view")); view.size() == 6)
        see_as_linked(state, view, numbers_of(word_of(settings, "up")), file, screen);
    return state;
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
        list += (list.empty() ? "" : ",") + surface_word(each, file);
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
    link += tool_words(state, file);
    if (state.coloring.by == interaction::ColorBy::value)
        if (const auto number = file.array_called(state.coloring.array)) {
            link += fmt::format("&colors={}&map={}", *number, state.coloring.map);
            if (const auto& range = state.coloring.range)
                link += fmt::format("&range={:.9g},{:.9g}", (*range)[0], (*range)[1]);
        }
    return link;
}

} // namespace isochron::app
