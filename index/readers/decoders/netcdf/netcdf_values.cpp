// Finds missing values, and reads the hyperslab of a step.
#include "index/readers/decoders/netcdf/netcdf_values.h"

#include <cmath>
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
    case StoredType::f32: return static_cast<double>(static_cast<float>(value));
    default: return value;
    }
}

bool is_integer(StoredType type) {
    return type != StoredType::f32 && type != StoredType::f64;
}

} // namespace

MissingValues::MissingValues(const NetcdfFile& file, const NetcdfVariable& variable) {
    const StoredType type = *variable.type;
    std::vector<double> values = file.numbers(variable, "missing_value");
    if (const auto fill = file.fill(variable))
        values.push_back(*fill);
    for (const double value : values)
        if (!std::isnan(value))
            values_.push_back(as_stored(value, type));

    const std::vector<double> range = file.numbers(variable, "valid_range");
    const auto limit = [&](const char* attribute, std::size_t i, double none) {
        const std::vector<double> given = file.numbers(variable, attribute);
        const double value = !given.empty() ? given.front() : range.size() == 2 ? range[i] : none;
        return std::isnan(value) ? none : value;
    };
    low_ = limit("valid_min", 0, low_);
    high_ = limit("valid_max", 1, high_);
    const bool real = file.is_real(variable, "valid_range") ||
                      file.is_real(variable, "valid_min") || file.is_real(variable, "valid_max");
    if (!is_integer(type) || !real) {
        low_ = as_stored(low_, type);
        high_ = as_stored(high_, type);
        return;
    }
    // If integers have limits that are real numbers, the limits are of the scaled values.
    const Scaling scaling = file.scaling(variable);
    low_ = (low_ - scaling.intercept) / scaling.slope;
    high_ = (high_ - scaling.intercept) / scaling.slope;
    if (scaling.slope < 0)
        std::swap(low_, high_);
    constexpr double kSlack = 1e-3; // so that rounding does not exclude the integer at the limit
    low_ -= kSlack;
    high_ += kSlack;
}

void read_netcdf_slab(const NetcdfFile& file, const NetcdfVariable& variable,
                      const NetcdfLayout& layout, std::size_t step, Slices slices,
                      const ChosenScalar& chosen, const MissingValues& missing, const Grid& grid,
                      const std::optional<VolumePart>& part, std::span<std::byte> out) {
    std::vector<std::size_t> start(variable.dimensions.size()), count;
    for (const NetcdfDimension& dimension : variable.dimensions)
        count.push_back(dimension.length);
    if (layout.time) {
        start[*layout.time] = step;
        count[*layout.time] = 1;
    }
    for (std::size_t axis = 0; part && axis < 3; ++axis) {
        start[layout.space[axis]] = part->first[axis];
        count[layout.space[axis]] = part->count[axis];
    }
    start[layout.space[2]] += slices.first;
    count[layout.space[2]] = slices.count;
    Grid slab = grid;
    slab.vertices[2] = slices.count;
    const std::size_t values = slab.vertex_count();
    const bool converts = stored_type_of(chosen.value_type()) != *variable.type;
    std::vector<std::byte> stored(converts ? values * size_of(*variable.type) : 0);
    const std::span<std::byte> read = converts ? std::span(stored) : out;
    file.read(variable, start, count, read);

    std::vector<bool> gaps; // for integers, which have no NaN
    if (missing.possible())
        visit_stored_type(*variable.type, [&]<class T>(std::type_identity<T>) {
            if constexpr (std::is_integral_v<T>)
                gaps.resize(values);
            T* value = reinterpret_cast<T*>(read.data());
            for (std::size_t i = 0; i < values; ++i) {
                if (!missing.contain(static_cast<double>(value[i])))
                    continue;
                if constexpr (std::is_integral_v<T>) {
                    gaps[i] = true;
                    value[i] = 0; // since the number in a gap may have no exact f64
                } else {
                    value[i] = std::numeric_limits<T>::quiet_NaN();
                }
            }
        });
    if (converts)
        convert(chosen, stored, slab, out, file.name());
    if (!gaps.empty())
        visit_value_type(chosen.value_type(), [&]<class T>(std::type_identity<T>) {
            T* value = reinterpret_cast<T*>(out.data());
            for (std::size_t i = 0; i < values; ++i)
                if (gaps[i])
                    value[i] = std::numeric_limits<T>::quiet_NaN();
        });
}

} // namespace isochron::index
