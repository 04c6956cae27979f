// Fills the record of an array from attributes, and from one-dimensional arrays beside it.
#include "index/readers/decoders/zarr/zarr_stated.h"

#include "index/readers/decoders/zarr/zarr_groups.h"
#include "index/readers/formats/stated/axis_roles.h"
#include "index/readers/formats/stated/stated_attributes.h"
#include "index/readers/formats/stated/stated_times.h"
#include "index/readers/formats/stated/stated_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <sstream>
#include <string>
#include <utility>

namespace isochron::index {
namespace {

using nlohmann::json;

/// The paths of the groups around an array, the nearest first; the root's is empty.
std::vector<std::string> groups_around(const ZarrArray& array) {
    std::vector<std::string> groups;
    std::string path = array.path();
    while (!path.empty()) {
        const std::size_t slash = path.rfind('/');
        path.resize(slash == std::string::npos ? 0 : slash);
        groups.push_back(path);
    }
    return groups;
}

/// A one-dimensional array with coordinates.
struct Coordinates {
    StatedAxis axis;
    ZarrArray array;
};

std::optional<Coordinates> coordinates_in(const ZarrStore& store, const std::string& path,
                                          const std::vector<std::uint64_t>& shape) {
    auto array = ZarrArray::open(store, path);
    if (!array || array->shape() != shape)
        return std::nullopt;
    StatedAxis axis;
    axis.coordinate = path.substr(path.rfind('/') + 1); // npos + 1 is 0
    if (!array->type()) {
        axis.dates = array->texts();
        if (!are_dates(axis.dates))
            return std::nullopt;
    }
    take_cf_attributes(attributes_of(array->attributes()), axis);
    return Coordinates{std::move(axis), std::move(*array)};
}

std::vector<double> scaled_values(const ZarrStore& store, ZarrArray& array) {
    if (!array.type())
        return {}; // dates
    const Scaling scaling = scaling_by(attributes_of(array.attributes()),
                                       fmt::format("{}: {}", store.name(), array.path()));
    const std::uint64_t length = array.shape().empty() ? 1 : array.shape().front();
    const std::vector<std::uint64_t> first(array.shape().size()), count = array.shape();
    std::vector<std::byte> stored(length * size_of(*array.type()));
    array.read(first, count, stored);
    std::vector<double> values(length);
    visit_stored_type(*array.type(), [&]<class T>(std::type_identity<T>) {
        for (std::size_t i = 0; i < length; ++i) {
            T value;
            std::memcpy(&value, &stored[i * sizeof(T)], sizeof(T));
            values[i] = scaling(static_cast<double>(value));
        }
    });
    return values;
}

/// The arrays with coordinates along a dimension: the one of its name, those that the array's
/// attribute names, and others beside it that have this dimension alone.
std::vector<Coordinates> coordinates_along(const ZarrStore& store, const ZarrArray& array,
                                           std::size_t dimension, const std::string& named) {
    constexpr std::size_t kMostBeside = 200; // arrays that are opened to look for coordinates
    const std::string& name = array.names()[dimension];
    const std::vector<std::uint64_t> shape{array.shape()[dimension]};
    std::vector<Coordinates> found;
    const auto take = [&](const std::string& group, const std::string& of) {
        const std::string path = zarr_key(group, of);
        if (path == array.path() || of.empty() || of.find('/') != std::string::npos ||
            std::ranges::any_of(found,
                                [&](const Coordinates& each) { return each.array.path() == path; }))
            return;
        if (auto beside = coordinates_in(store, path, shape);
            beside && (of == name || beside->array.names() == std::vector{name}))
            found.push_back(std::move(*beside));
    };
    for (const std::string& group : groups_around(array)) {
        take(group, name);
        if (!found.empty())
            return found;
    }
    for (const std::string& group : groups_around(array)) {
        std::istringstream names(named);
        for (std::string each; names >> each;)
            take(group, each);
        const std::vector<std::string> beside = store.names(group);
        if (beside.size() <= kMostBeside)
            for (const std::string& each : beside)
                if (!each.starts_with('.') && each != "zarr.json")
                    take(group, each);
    }
    return found;
}

/// A number as xarray writes `_FillValue` into Zarr of version 3: the 8 bytes of an f64 in base64.
std::optional<double> number_in_base64(const std::string& text) {
    static const std::string kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    if (text.size() != 12 || text.back() != '=')
        return std::nullopt;
    std::array<std::uint8_t, 9> bytes{};
    for (std::size_t i = 0; i < 11; ++i) {
        const std::size_t digit = kDigits.find(text[i]);
        if (digit == std::string::npos)
            return std::nullopt;
        for (std::size_t bit = 0; bit < 6; ++bit)
            if (digit >> (5 - bit) & 1u)
                bytes[(i * 6 + bit) / 8] |= static_cast<std::uint8_t>(0x80u >> ((i * 6 + bit) % 8));
    }
    double number = 0;
    std::memcpy(&number, bytes.data(), sizeof(number));
    return number;
}

void transform(const json& transformation, std::vector<StatedAxis>& axes) {
    for (const bool scales : {true, false}) {
        const auto found = transformation.find(scales ? "scale" : "translation");
        if (found == transformation.end() || found->size() != axes.size())
            continue;
        for (std::size_t i = 0; i < axes.size(); ++i) {
            const double number = found->at(i);
            axes[i].first = scales ? axes[i].first * number : axes[i].first + number;
            axes[i].step *= scales ? number : 1;
        }
    }
}

} // namespace

StatedAttributes attributes_of(const json& attributes) {
    const auto at = [attributes](const char* name) {
        const auto found = attributes.is_object() ? attributes.find(name) : attributes.end();
        return attributes.is_object() && found != attributes.end() ? *found : json();
    };
    return {.text =
                [at](const char* name) {
                    const json value = at(name);
                    return value.is_string()   ? value.get<std::string>()
                           : value.is_object() ? value.dump()
                                               : std::string();
                },
            .texts =
                [at](const char* name) {
                    std::vector<std::string> texts;
                    const json value = at(name);
                    if (value.is_array())
                        for (const json& each : value)
                            texts.push_back(each.is_string() ? each.get<std::string>() : "");
                    return texts;
                },
            .numbers =
                [at](const char* name) {
                    const json value = at(name);
                    std::vector<double> numbers;
                    if (value.is_string())
                        if (const auto number = number_in_base64(value.get<std::string>()))
                            return std::vector{*number};
                    for (const json& each : value.is_array() ? value : json::array({value})) {
                        if (!each.is_number())
                            return std::vector<double>();
                        numbers.push_back(each.get<double>());
                    }
                    return numbers;
                },
            .is_real =
                [at](const char* name) {
                    const json value = at(name);
                    return value.is_number_float() ||
                           (value.is_array() && !value.empty() && value.front().is_number_float());
                },
            .names =
                [attributes] {
                    std::vector<std::string> names;
                    for (const auto& [name, value] : attributes.items())
                        names.push_back(name);
                    return names;
                }};
}

std::vector<StatedAttributes> objects_of(const ZarrStore& store, const ZarrArray& array) {
    std::vector<StatedAttributes> objects{attributes_of(array.attributes())};
    for (const std::string& group : groups_around(array))
        objects.push_back(attributes_of(attributes_of_group(store, group)));
    return objects;
}

std::vector<StatedAxis> axes_of(const ZarrStore& store, const ZarrArray& array) {
    constexpr std::uint64_t kMost = 1 << 24;
    const std::string named = attributes_of(array.attributes()).text("coordinates");
    std::vector<StatedAxis> axes(array.shape().size());
    for (std::size_t i = 0; i < axes.size(); ++i) {
        if (i < array.names().size() && !array.names()[i].empty() && array.shape()[i] <= kMost) {
            std::vector<Coordinates> along = coordinates_along(store, array, i, named);
            std::vector<StatedAxis> candidates;
            for (const Coordinates& each : along)
                candidates.push_back(each.axis);
            if (const auto chosen = coordinate_of(array.names()[i], named, candidates)) {
                axes[i] = std::move(candidates[*chosen]);
                axes[i].at = scaled_values(store, along[*chosen].array);
            }
        }
        if (i < array.names().size())
            axes[i].name = array.names()[i];
        axes[i].length = array.shape()[i];
    }
    return axes;
}

std::vector<StatedAxis> axes_of(const json& image, const json& dataset, const ZarrArray& array) {
    std::vector<StatedAxis> axes(array.shape().size());
    for (std::size_t i = 0; i < axes.size(); ++i) {
        axes[i].length = array.shape()[i];
        if (i < array.names().size())
            axes[i].name = array.names()[i];
    }
    if (const auto list = image.find("axes"); list != image.end())
        for (std::size_t i = 0; i < std::min(axes.size(), list->size()); ++i) {
            const json& axis = list->at(i);
            axes[i].name =
                axis.is_string() ? axis.get<std::string>() : axis.at("name").get<std::string>();
            if (axis.is_object()) {
                axes[i].kind = axis.value("type", "");
                axes[i].unit = tidy_unit_of_ome(axis.value("unit", ""));
            }
        }
    for (const json* object : {&dataset, &image})
        if (const auto all = object->find("coordinateTransformations"); all != object->end())
            for (const json& transformation : *all)
                transform(transformation, axes);
    for (StatedAxis& axis : axes) {
        const bool is_time = axis.kind == "time" || role_by_name(axis.name) == AxisRole::time;
        axis.regular = !is_time || axis.step != 1 || !axis.unit.empty();
    }
    return axes;
}

std::optional<StatedAxis> time_in(const ZarrStore& store, const std::string& group) {
    auto found = coordinates_in(store, zarr_key(group, "time"), {});
    if (!found)
        found = coordinates_in(store, zarr_key(group, "time"), {1});
    if (!found)
        return std::nullopt;
    found->axis.at = scaled_values(store, found->array);
    return found->axis;
}

std::size_t long_dimensions_of(const ZarrStore& store, const ZarrArray& array,
                               const std::string& beside) {
    for (const std::string& group : groups_around(array))
        if (const auto found = ZarrArray::open(store, zarr_key(group, beside)))
            return static_cast<std::size_t>(std::ranges::count_if(
                found->shape(), [](std::uint64_t length) { return length > 1; }));
    return 0;
}

std::vector<double> fills_of(const ZarrArray& array) {
    if (const auto never_written = array.fill(); never_written &&
                                                 array.attributes().contains("_ARRAY_DIMENSIONS") &&
                                                 !std::isnan(*never_written))
        return {*never_written};
    return {};
}

} // namespace isochron::index
