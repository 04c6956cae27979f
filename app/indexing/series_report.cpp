// What a series is.
#include "app/indexing/series_report.h"

#include "app/config/first_placement.h"
#include "app/text.h"
#include "index/volume/step_gaps.h"
#include "index/volume/time_unit.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace isochron::app {
namespace {

using index::Grid;
using index::SeriesInfo;

constexpr std::array kAnatomies{"none", "ras", "lps", "enu"};

std::array<double, 3> numbers(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

bool right_handed(const Grid& grid) {
    return glm::determinant(grid.direction) > 0;
}

/// The least and the greatest distance between neighbors along an axis whose vertices are not even.
nlohmann::ordered_json gaps_of(const Grid& grid) {
    nlohmann::ordered_json gaps = nlohmann::ordered_json::object();
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::vector<double>& at = grid.positions[axis].distances();
        if (at.empty())
            continue;
        double low = at[1] - at[0], high = low;
        for (std::size_t i = 2; i < at.size(); ++i) {
            low = std::min(low, at[i] - at[i - 1]);
            high = std::max(high, at[i] - at[i - 1]);
        }
        gaps[std::string(1, "xyz"[axis])] = {low, high};
    }
    return gaps;
}

/// Equal steps, as far as the rounding of decimal times lets them be.
bool uniform(const std::vector<double>& times) {
    if (times.size() < 3)
        return true;
    const double mean = (times.back() - times.front()) / static_cast<double>(times.size() - 1);
    const double tolerance =
        1e-6 * mean + 1e-12 * std::max(std::abs(times.front()), std::abs(times.back()));
    for (std::size_t t = 1; t < times.size(); ++t)
        if (std::abs(times[t] - times[t - 1] - mean) > tolerance)
            return false;
    return true;
}

std::string times_text(const SeriesInfo& info) {
    const bool dated = index::has_dates(info.times, info.time_unit);
    const auto time = [&](std::size_t step) {
        return dated ? index::time_text(info.times, step, info.time_unit)
                     : human_number(info.times[step]);
    };
    const std::string unit = dated ? "" : with_space(info.time_unit);
    if (info.steps() == 1)
        return fmt::format("1 at time {}{}", time(0), unit);
    return fmt::format("{}, times {} to {}{}, {}", info.steps(), time(0), time(info.steps() - 1),
                       unit, uniform(info.times) ? "uniform" : "not uniform");
}

/// Null unless the unit has a reference date.
nlohmann::ordered_json dates_of(const SeriesInfo& info) {
    if (!index::has_dates(info.times, info.time_unit))
        return nullptr;
    std::vector<std::string> dates;
    for (std::size_t step = 0; step < info.steps(); ++step)
        dates.push_back(index::time_text(info.times, step, info.time_unit));
    return dates;
}

bool is_missing(const SeriesInfo& info, std::uint32_t step) {
    return std::ranges::binary_search(info.missing_after, step);
}

/// The gaps of the series, and why each is one.
nlohmann::ordered_json gaps_of_time(const SeriesInfo& info) {
    nlohmann::ordered_json gaps = nlohmann::ordered_json::array();
    for (const std::uint32_t step : index::gaps_of(info))
        gaps.push_back({{"after_step", step}, {"numbers_are_missing", is_missing(info, step)}});
    return gaps;
}

/// Range of the finite values of a step, scaled.
struct ValueRange {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
    std::uint64_t nan_values = 0;
};

ValueRange range_of(index::VolumeSeries& series, std::size_t step) {
    ValueRange range;
    const SeriesInfo& info = series.info();
    series.stream(step, [&](std::span<const std::byte> piece) {
        index::visit_value_type(info.type, [&]<class T>(std::type_identity<T>) {
            const std::span values(reinterpret_cast<const T*>(piece.data()),
                                   piece.size() / sizeof(T));
            for (const T stored : values) {
                const double value = info.scaling(static_cast<double>(stored));
                range.nan_values += std::isnan(value);
                if (!std::isfinite(value))
                    continue;
                range.low = std::min(range.low, value);
                range.high = std::max(range.high, value);
            }
        });
    });
    return range;
}

} // namespace

std::string gaps_text(const SeriesInfo& info) {
    constexpr std::size_t kNamed = 4;
    const std::vector<std::uint32_t> gaps = index::gaps_of(info);
    std::vector<std::string> named;
    for (const std::uint32_t step : gaps) {
        if (named.size() == kNamed) {
            named.push_back(fmt::format("{} more", gaps.size() - kNamed));
            break;
        }
        named.push_back(fmt::format("between steps {} and {} ({})", step, step + 1,
                                    is_missing(info, step)
                                        ? "numbers are missing in the names"
                                        : "more than three times the usual time"));
    }
    return named.empty() ? ""
                         : fmt::format("{}; there, the step before is shown instead of a blend",
                                       fmt::join(named, ", "));
}

SafeText text_of(const SeriesInfo& info) {
    const Grid& grid = info.grid;
    const std::string length = with_space(info.length_unit);
    SafeText text;
    const auto line = [&](std::string_view label, const std::string& value) {
        text += SafeText("{:<13} {}\n", label, value);
    };
    line("array", info.array.empty() ? "unnamed" : info.array);
    line("vertices", fmt::format("{}", fmt::join(grid.vertices, " x ")));
    line("cells",
         fmt::format("{} = {}", fmt::join(grid.cells(), " x "), grouped(grid.cell_count())));
    line("spacing", fmt::format("{:.10g}{}", fmt::join(numbers(grid.spacing), " x "), length));
    const nlohmann::ordered_json uneven = gaps_of(grid);
    for (const auto& [axis, gaps] : uneven.items())
        line("", fmt::format("along {} the mean of {:.10g} to {:.10g}{}", axis,
                             gaps[0].get<double>(), gaps[1].get<double>(), length));
    if (info.length_unit.empty())
        line("length unit", "none");
    line("size", fmt::format("{:.10g}{}", fmt::join(numbers(physical_size(grid)), " x "), length));
    line("origin", fmt::format("{:.10g}{}", fmt::join(numbers(grid.origin), " "), length));
    for (int axis = 0; axis < 3; ++axis)
        line(
            axis == 0 ? "direction" : "",
            fmt::format("{}: {:.10g}", "xyz"[axis], fmt::join(numbers(grid.direction[axis]), " ")));
    line("handedness", right_handed(grid) ? "right" : "left");
    switch (info.anatomy) {
    case index::Anatomy::ras: line("anatomy", "RAS"); break;
    case index::Anatomy::lps: line("anatomy", "LPS"); break;
    case index::Anatomy::enu: line("up", "z"); break;
    case index::Anatomy::none: break;
    }
    line("steps", times_text(info));
    if (const std::string gaps = gaps_text(info); !gaps.empty())
        line("gaps", gaps);
    line("type", std::string(index::name_of(info.type)));
    if (info.scaling != index::Scaling{})
        line("scaling",
             fmt::format("{} * stored + {}", info.scaling.slope, info.scaling.intercept));
    return text;
}

nlohmann::ordered_json json_of(const SeriesInfo& info) {
    const Grid& grid = info.grid;
    return {{"array", info.array},
            {"vertices", grid.vertices},
            {"cells", grid.cells()},
            {"spacing", numbers(grid.spacing)},
            {"uneven", gaps_of(grid)},
            {"origin", numbers(grid.origin)},
            {"direction",
             {numbers(grid.direction[0]), numbers(grid.direction[1]), numbers(grid.direction[2])}},
            {"handedness", right_handed(grid) ? "right" : "left"},
            {"physical_size", numbers(physical_size(grid))},
            {"length_unit", info.length_unit},
            {"anatomy", kAnatomies[static_cast<std::size_t>(info.anatomy)]},
            {"steps", info.steps()},
            {"times", info.times},
            {"time_unit", info.time_unit},
            {"dates", dates_of(info)},
            {"uniform_time", uniform(info.times)},
            {"gaps", gaps_of_time(info)},
            {"type", index::name_of(info.type)},
            {"slope", info.scaling.slope},
            {"intercept", info.scaling.intercept}};
}

SafeText source_text(const std::string& name, index::VolumeSeries& series) {
    const SeriesInfo& info = series.info();
    SafeText text("{}\n{}", name, text_of(info));
    const auto line = [&](std::string_view label, const std::string& value) {
        text += SafeText("{:<13} {}\n", label, value);
    };
    const ValueRange range = range_of(series, 0);
    line("values", range.low <= range.high
                       ? exact_range_text(range.low, range.high, info) + " in the first step"
                       : "none is finite in the first step");
    line("NaN", fmt::format("{} values in the first step", grouped(range.nan_values)));
    if (info.arrays.size() > 1)
        for (std::size_t i = 0; i < info.arrays.size(); ++i)
            line(i == 0 ? "arrays" : "", info.arrays[i]);
    line("files", fmt::format("{}: {}{}", info.sources.size(), info.sources.front(),
                              info.sources.size() > 1 ? " to " + info.sources.back() : ""));
    line("build reads",
         fmt::format("{} of values{}",
                     human_bytes(static_cast<double>(info.step_bytes()) *
                                 static_cast<double>(info.steps())),
                     info.arrays.size() > 1 ? fmt::format(", with --array {}", info.array) : ""));
    for (const std::string& note : info.notes)
        line("note", note);
    return text;
}

nlohmann::ordered_json source_json(const std::string& name, index::VolumeSeries& series) {
    const SeriesInfo& info = series.info();
    const ValueRange range = range_of(series, 0);
    nlohmann::ordered_json j{{"file", name}};
    j.update(json_of(info));
    const bool any = range.low <= range.high;
    j["first_step"] = {{"low", any ? nlohmann::ordered_json(range.low) : nullptr},
                       {"high", any ? nlohmann::ordered_json(range.high) : nullptr},
                       {"nan_values", range.nan_values}};
    j["arrays"] = info.arrays;
    j["sources"] = info.sources;
    j["notes"] = info.notes;
    return j;
}

} // namespace isochron::app
