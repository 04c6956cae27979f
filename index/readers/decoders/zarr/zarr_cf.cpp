// Reads attributes, and one-dimensional arrays beside an array.
#include "index/readers/decoders/zarr/zarr_cf.h"

#include "index/error.h"
#include "index/readers/formats/axis_positions.h"
#include "index/readers/formats/stated_times.h"
#include "index/readers/formats/stored_file.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <limits>

namespace isochron::index {
namespace {

/// Positions along a dimension, or times.
struct Coordinates {
    std::vector<double> at;
    std::string unit;
    nlohmann::json attributes;
    Scaling scaling;
};

std::string text_in(const nlohmann::json& attributes, const char* name) {
    const auto found = attributes.find(name);
    return found != attributes.end() && found->is_string() ? found->get<std::string>() : "";
}

std::optional<Coordinates> coordinates_of(const ZarrStore& store, const ZarrArray& array,
                                          std::size_t dimension) {
    constexpr std::uint64_t kMost = 1 << 24;
    const std::uint64_t length = array.shape()[dimension];
    const std::string name =
        dimension < array.names().size() ? array.names()[dimension] : std::string();
    if (name.empty() || name.find('/') != std::string::npos || length > kMost)
        return std::nullopt;
    const std::size_t group = array.path().rfind('/');
    const std::string path =
        (group == std::string::npos ? "" : array.path().substr(0, group + 1)) + name;
    std::optional<ZarrArray> beside;
    if (path != array.path())
        beside = ZarrArray::open(store, path);
    if (!beside || !beside->type() || beside->shape() != std::vector<std::uint64_t>{length})
        return std::nullopt;
    const Scaling scaling = scaling_of(*beside, fmt::format("{}: {}", store.name(), path));
    Coordinates found{std::vector<double>(length), text_in(beside->attributes(), "units"),
                      beside->attributes(), scaling};
    const std::array<std::uint64_t, 1> first{0}, count{length};
    std::vector<std::byte> values(length * size_of(*beside->type()));
    beside->read(first, count, values);
    visit_stored_type(*beside->type(), [&]<class T>(std::type_identity<T>) {
        for (std::size_t i = 0; i < length; ++i) {
            T value;
            std::memcpy(&value, &values[i * sizeof(T)], sizeof(T));
            found.at[i] = scaling(static_cast<double>(value));
        }
    });
    return found;
}

} // namespace

Scaling scaling_of(const ZarrArray& array, const std::string& name) {
    const auto number = [&](const char* attribute, double otherwise) {
        const auto found = array.attributes().find(attribute);
        return found != array.attributes().end() && found->is_number() ? found->get<double>()
                                                                       : otherwise;
    };
    const Scaling scaling{number("scale_factor", 1), number("add_offset", 0)};
    if (scaling.slope == 0 || !std::isfinite(scaling.slope) || !std::isfinite(scaling.intercept))
        throw Error(fmt::format("{}: scale_factor {} and add_offset {}, expected finite numbers, "
                                "the first not 0",
                                name, scaling.slope, scaling.intercept));
    return scaling;
}

std::vector<double> missing_in(const ZarrArray& array) {
    std::vector<double> missing;
    for (const char* name : {"_FillValue", "missing_value"})
        if (const auto found = array.attributes().find(name);
            found != array.attributes().end() && found->is_number())
            missing.push_back(found->get<double>());
    if (const auto never_written = array.fill(); never_written &&
                                                 array.attributes().contains("_ARRAY_DIMENSIONS") &&
                                                 !std::isnan(*never_written))
        missing.push_back(*never_written);
    return missing;
}

std::vector<std::uint8_t> take_out(std::span<const double> missing, StoredType type,
                                   std::span<std::byte> values) {
    constexpr double kMostFloat = std::numeric_limits<float>::max();
    std::vector<std::uint8_t> gaps;
    visit_stored_type(type, [&]<class T>(std::type_identity<T>) {
        gaps.resize(values.size() / sizeof(T));
        for (std::size_t i = 0; i < gaps.size(); ++i) {
            T value;
            std::memcpy(&value, &values[i * sizeof(T)], sizeof(T));
            for (const double each : missing)
                gaps[i] |= static_cast<double>(value) == each ||
                           (std::is_same_v<T, float> && std::abs(each) <= kMostFloat &&
                            static_cast<float>(value) == static_cast<float>(each));
            if (gaps[i] == 0)
                continue;
            value = std::is_floating_point_v<T> ? std::numeric_limits<T>::quiet_NaN() : T{};
            std::memcpy(&values[i * sizeof(T)], &value, sizeof(T));
        }
    });
    return gaps;
}

void place_by_coordinates(const ZarrStore& store, const ZarrArray& array,
                          const std::array<std::size_t, 3>& space, std::optional<std::size_t> time,
                          const ReadOptions& options, SeriesInfo& info) {
    std::array<std::optional<Coordinates>, 3> axes;
    std::array<AxisSpread, 3> spreads;
    glm::dmat3 steps(1.0);
    bool one_unit = true;
    for (std::size_t a = 0; a < 3; ++a) {
        const int i = static_cast<int>(a);
        axes[a] = coordinates_of(store, array, space[a]);
        one_unit = one_unit && axes[a] && axes[a]->unit == axes[0]->unit;
        if (!axes[a])
            continue;
        try {
            spreads[a] =
                spread_of(axes[a]->at, array.names()[space[a]], axes[a]->unit, store.name());
        } catch (const Error&) {
            if (!options.spacing)
                throw;
        }
        steps[i][i] = spreads[a].step;
        info.grid.origin[i] = spreads[a].first;
        if (spreads[a].note)
            info.notes.push_back(*spreads[a].note);
    }
    if (axes[0] || axes[1] || axes[2])
        set_axes(info.grid, steps, store.name());
    for (std::size_t a = 0; a < 3; ++a)
        if (axes[a]) {
            if (spreads[a].uneven)
                set_positions(info.grid, a, axes[a]->at);
            info.axis_names[a] =
                with_own_unit(array.names()[space[a]], one_unit ? "" : axes[a]->unit);
        }
    if (one_unit)
        info.length_unit = axes[0]->unit;
    else if (axes[0] && axes[1] && axes[2] && !options.spacing)
        info.notes.push_back(fmt::format("units differ: {}, {}, {}; --spacing sets proportions",
                                         info.axis_names[0], info.axis_names[1],
                                         info.axis_names[2]));
    if (auto times = time ? coordinates_of(store, array, *time) : std::nullopt) {
        StatedTimes stated{.name = array.names()[*time],
                           .values = std::move(times->at),
                           .unit = times->unit,
                           .calendar = text_in(times->attributes, "calendar")};
        for (const char* name : {"_FillValue", "missing_value"})
            if (const auto found = times->attributes.find(name);
                found != times->attributes.end() && found->is_number())
                stated.missing.push_back(times->scaling(found->get<double>()));
        place_times(std::move(stated), info);
    }
}

} // namespace isochron::index
