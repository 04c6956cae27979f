// Words of a picked place.
#include "app/scene/mark.h"

#include "app/scene/caption.h"
#include "app/text.h"
#include "index/volume/instant_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace isochron::app {
namespace {

/// The smallest distance between neighboring vertices along an axis of the grid.
double finest_spacing(const index::Grid& grid, int axis) {
    const auto number = static_cast<std::size_t>(axis);
    double finest = 1.0;
    if (!grid.positions[number].even())
        for (std::uint32_t vertex = 1; vertex < grid.vertices[number]; ++vertex)
            finest =
                std::min(finest, grid.even_place(axis, vertex) - grid.even_place(axis, vertex - 1));
    return finest * grid.spacing[axis];
}

/// A coordinate to a tenth of the spacing, or to five digits where that would take too many.
std::string coordinate_text(double coordinate, double spacing) {
    constexpr double kMostDecimals = 6, kLargest = 1e9;
    const double decimals = std::max(0.0, std::round(1.0 - std::log10(spacing)));
    return decimals <= kMostDecimals && std::abs(coordinate) < kLargest
               ? fmt::format("{:.{}f}", coordinate, static_cast<int>(decimals))
               : fmt::format("{:.5g}", coordinate);
}

/// `x 3.42 y 4.41 z 5.60 m`; an axis with a unit of its own has that: `longitude 12.5 degrees`.
std::string place_text(const interaction::MarkedPoint& point, const index::SeriesInfo& info) {
    std::vector<std::string> parts;
    const bool own_units = std::ranges::any_of(
        info.axis_names, [](const std::string& name) { return name.ends_with(')'); });
    for (int axis = 0; axis < 3; ++axis) {
        int along = 0; // axis of the grid
        for (int each = 1; each < 3; ++each)
            if (std::abs(info.grid.direction[each][axis]) >
                std::abs(info.grid.direction[along][axis]))
                along = each;
        const std::string& named = info.axis_names[static_cast<std::size_t>(axis)];
        const std::size_t bracket = named.ends_with(')') ? named.find(" (") : named.npos;
        const bool own = bracket != named.npos;
        const std::string unit =
            own ? named.substr(bracket + 2, named.size() - bracket - 3) : info.length_unit;
        const std::string name =
            named.empty() ? std::string(1, "xyz"[axis]) : named.substr(0, bracket);
        parts.push_back(
            fmt::format("{} {}", name,
                        coordinate_text(point.position[axis], finest_spacing(info.grid, along))));
        if (own_units || axis == 2) // one unit for all of them, or one each
            parts.back() += with_space(unit);
    }
    return fmt::format("{}", fmt::join(parts, " "));
}

/// Digits that values of a type carry, as interpolation uses them.
int digits_of(index::ValueType type) {
    return type == index::ValueType::f64 || type == index::ValueType::i32 ? 10 : 6;
}

std::string named_value(const interaction::MarkedPoint& point, const index::SeriesInfo& info) {
    const std::string& array = point.array.empty() ? info.array : point.array;
    return fmt::format("{} {}", array.empty() ? "value" : array, value_text(point, info));
}

std::string time_text(const interaction::MarkedPoint& point, const index::SeriesInfo& info) {
    const index::Instant at = point.instant.within(info.steps());
    const std::string time = "t " + index::instant_text(info.times, at, info.time_unit);
    return at.between() ? fmt::format("{}, {}", time, steps_text(at)) : time;
}

} // namespace

std::string value_text(const interaction::MarkedPoint& point, const index::SeriesInfo& info) {
    const int carried = digits_of(info.type);
    return point.array.empty() || point.array == info.array
               ? with_unit(point.value, info.value_unit, std::max(carried, info.digits))
               : with_unit(point.value, point.unit, carried);
}

std::string mark_text(const interaction::MarkedPoint& point, const index::SeriesInfo& info,
                      const std::function<bool(const std::string&)>& fits) {
    const std::string place = place_text(point, info), value = named_value(point, info);
    const std::array texts{fmt::format("{}, {}, {}", place, value, time_text(point, info)),
                           fmt::format("{}, {}", place, value), value, value_text(point, info)};
    for (const std::string& text : texts)
        if (!fits || fits(text))
            return text;
    return texts.back();
}

std::vector<std::string> mark_lines(const interaction::MarkedPoint& point,
                                    const index::SeriesInfo& info) {
    return {named_value(point, info), place_text(point, info), time_text(point, info)};
}

std::vector<std::string> pointed_lines(const interaction::Pointed& pointed, std::size_t surfaces,
                                       const index::SeriesInfo& info) {
    std::vector<std::string> lines{named_value(pointed.point, info),
                                   place_text(pointed.point, info)};
    if (pointed.point.instant.between())
        lines.push_back(steps_text(pointed.point.instant));
    if (surfaces > 1 && !pointed.on_slice)
        lines.push_back(fmt::format("surface {} of {}", pointed.surface + 1, surfaces));
    return lines;
}

} // namespace isochron::app
