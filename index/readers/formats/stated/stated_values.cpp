// Reads the attributes of values, and finds missing ones.
#include "index/readers/formats/stated/stated_values.h"

#include "index/error.h"

#include <cmath>
#include <cstring>
#include <initializer_list>
#include <type_traits>
#include <utility>

namespace isochron::index {
namespace {

// An attribute's value as it appears among the stored values: unsigned numbers may be written with
// a sign, and 1e35 in f64 differs from 1e35 in f32.
double as_stored(double value, StoredType type) {
    switch (type) {
    case StoredType::u8:
    case StoredType::u16:
    case StoredType::u32:
    case StoredType::u64:
        return value < 0 ? value + std::exp2(8.0 * static_cast<double>(size_of(type))) : value;
    case StoredType::f32:
        return std::abs(value) <= static_cast<double>(std::numeric_limits<float>::max())
                   ? static_cast<double>(static_cast<float>(value))
                   : value;
    default: return value;
    }
}

bool is_integer(StoredType type) {
    return type != StoredType::f32 && type != StoredType::f64;
}

/// Makes NaN, or 0 in integers, of the missing values.
/// @param gaps set to 1 where one is missing; as many as there are values
void take_out(const MissingValues& missing, StoredType type, std::span<std::byte> values,
              std::span<std::uint8_t> gaps) {
    visit_stored_type(type, [&]<class T>(std::type_identity<T>) {
        T* value = reinterpret_cast<T*>(values.data());
        for (std::size_t i = 0; i < gaps.size(); ++i) {
            if (!missing.contain(static_cast<double>(value[i])))
                continue;
            gaps[i] = 1;
            // 0, since the number in a gap may have no exact f64
            value[i] = std::is_integral_v<T> ? T{} : std::numeric_limits<T>::quiet_NaN();
        }
    });
}

} // namespace

Scaling scaling_by(const StatedAttributes& array, const std::string& where) {
    const auto number = [&](std::initializer_list<const char*> names, double otherwise) {
        for (const char* name : names)
            if (const auto found = array.numbers(name); !found.empty())
                return found.front();
        return otherwise;
    };
    const Scaling scaling{number({"scale_factor", "unitSI"}, 1), number({"add_offset"}, 0)};
    if (scaling.slope == 0 || !std::isfinite(scaling.slope) || !std::isfinite(scaling.intercept))
        throw Error("{}: scale_factor {} and add_offset {}, expected finite numbers and a factor "
                    "that is not 0",
                    where, scaling.slope, scaling.intercept);
    return scaling;
}

std::string value_unit_by(const StatedAttributes& array) {
    for (const char* name : {"units", "unit", "Units", "UNITS"})
        if (std::string unit = array.text(name); !unit.empty())
            return unit == "1" ? "" : unit;
    return {};
}

MissingValues::MissingValues(const StatedAttributes& array, StoredType type,
                             const std::vector<double>& fills, const std::string& where) {
    std::vector<double> values = fills;
    for (const char* name : {"_FillValue", "missing_value"})
        for (const double value : array.numbers(name))
            values.push_back(value);
    for (const double value : values)
        if (!std::isnan(value))
            values_.push_back(as_stored(value, type));

    const std::vector<double> range = array.numbers("valid_range");
    const auto limit = [&](const char* attribute, std::size_t i, double none) {
        const std::vector<double> given = array.numbers(attribute);
        const double value = !given.empty() ? given.front() : range.size() == 2 ? range[i] : none;
        return std::isnan(value) ? none : value;
    };
    low_ = limit("valid_min", 0, low_);
    high_ = limit("valid_max", 1, high_);
    const bool real =
        array.is_real("valid_range") || array.is_real("valid_min") || array.is_real("valid_max");
    if (!is_integer(type) || !real) {
        low_ = as_stored(low_, type);
        high_ = as_stored(high_, type);
        return;
    }
    // If integers have limits that are real numbers, the limits are of the scaled values.
    const Scaling scaling = scaling_by(array, where);
    low_ = (low_ - scaling.intercept) / scaling.slope;
    high_ = (high_ - scaling.intercept) / scaling.slope;
    if (scaling.slope < 0)
        std::swap(low_, high_);
    constexpr double kSlack = 1e-3; // so that rounding does not exclude the integer at the limit
    low_ -= kSlack;
    high_ += kSlack;
}

void read_stored(
    const ChosenScalar& chosen, const MissingValues& missing, std::size_t count, const Grid& slab,
    std::span<std::byte> out, const std::string& file,
    const std::function<void(std::size_t component, std::span<std::byte> plane)>& load) {
    const StoredType type = *chosen.array.type;
    const std::size_t size = size_of(type);
    const bool all = chosen.component == ChosenScalar::kMagnitude;
    const bool converts =
        all || chosen.array.on_cells || stored_type_of(chosen.value_type()) != type;
    const std::size_t components = all ? chosen.array.components : 1;
    std::vector<std::byte> plane(converts ? count * size : 0),
        tuples(components > 1 ? count * size * components : 0);
    std::vector<std::uint8_t> gaps(missing.possible() ? count : 0);
    const std::span<std::byte> to = converts ? std::span(plane) : out;
    for (std::size_t c = 0; c < components; ++c) {
        load(all ? c : chosen.component, to);
        if (missing.possible())
            take_out(missing, type, to, gaps);
        for (std::size_t i = 0; components > 1 && i < count; ++i)
            std::memcpy(&tuples[(i * components + c) * size], &plane[i * size], size);
    }
    if (!converts)
        return;
    ChosenScalar alone = chosen;
    if (!all) {
        alone.array.components = 1;
        alone.component = 0;
    }
    convert(alone, components > 1 ? tuples : plane, slab, out, file,
            std::span<const std::uint8_t>(gaps));
}

} // namespace isochron::index
