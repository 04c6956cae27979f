// Chooses and converts stored scalar arrays.
#include "index/readers/formats/stored_scalar.h"

#include "index/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>

namespace isochron::index {
namespace {

constexpr std::array<std::string_view, 10> kNames{"i8",  "u8",  "i16", "u16", "i32",
                                                  "u32", "i64", "u64", "f32", "f64"};

bool fits_f32(StoredType type) {
    return type == StoredType::f32 || size_of(type) <= 2;
}

/// Whether the array can be chosen: it holds numbers.
bool is_offered(const StoredArray& array) {
    return array.type.has_value();
}

std::vector<std::string> offered_of(std::span<const StoredArray> arrays) {
    std::vector<std::string> list;
    for (const StoredArray& array : arrays)
        if (is_offered(array))
            list.push_back(
                fmt::format("{} ({}{}{}{})", array.name, name_of(*array.type),
                            array.components == 1 ? "" : fmt::format(" x {}", array.components),
                            array.shape.empty() ? "" : ", " + array.shape,
                            array.on_cells ? ", cell data" : ""));
    return list;
}

std::string listed(const std::vector<std::string>& offered) {
    constexpr std::size_t kShown = 20;
    const std::size_t shown = std::min(offered.size(), kShown);
    std::string list =
        fmt::format("{}", fmt::join(offered.begin(),
                                    offered.begin() + static_cast<std::ptrdiff_t>(shown), ", "));
    if (offered.size() > kShown)
        list += fmt::format(" and {} more", offered.size() - kShown);
    return list;
}

using Families = std::map<std::string, std::vector<const StoredArray*>>; ///< by how names begin

/// The first family of so many arrays that are alike; null: there is none.
const Families::value_type* alike_in(const Families& families, std::size_t least,
                                     std::size_t most) {
    for (const auto& family : families) {
        const StoredArray& first = *family.second.front();
        if (family.second.size() >= least && family.second.size() <= most &&
            std::ranges::all_of(family.second, [&](const StoredArray* array) {
                return array->type == first.type && array->shape == first.shape &&
                       array->components == 1;
            }))
            return &family;
    }
    return nullptr;
}

/// What else may be meant by arrays that are alike and whose names end in numbers, or in x, y and z,
/// as options of commands behind those that choose one.
std::string advice_on_families(std::span<const StoredArray> arrays) {
    Families numbered, lettered;
    for (const StoredArray& array : arrays) {
        const std::size_t end = array.name.find_last_not_of("0123456789") + 1; // npos + 1 is 0
        if (!is_offered(array) || array.name.empty())
            continue;
        if (array.by_pattern && end < array.name.size())
            numbered[array.name.substr(0, end)].push_back(&array);
        if (std::string_view("xyz").find(array.name.back()) != std::string_view::npos)
            lettered[array.name.substr(0, array.name.size() - 1)].push_back(&array);
    }
    std::string advice;
    if (const auto* family = alike_in(numbered, 2, arrays.size())) {
        const auto begins = std::ranges::count_if(arrays, [&](const StoredArray& array) {
            return array.name.starts_with(family->first);
        });
        const bool alone = static_cast<std::size_t>(begins) == family->second.size();
        advice = fmt::format("; --array '{}{}*' takes {} as the steps of one", family->first,
                             alone ? "" : "[0-9]", family->second.size());
    }
    if (const auto* family = alike_in(lettered, 3, 3)) {
        std::vector<std::string> names;
        for (const StoredArray* array : family->second)
            names.push_back(array->name);
        std::ranges::sort(names);
        advice += fmt::format("; --array {} takes the length of a vector", fmt::join(names, ","));
    }
    return advice;
}

std::uint32_t component_of(const StoredArray& array, const ReadOptions& options,
                           const std::string& file) {
    if (!options.component) {
        if (array.components == 1)
            return 0;
        if (options.any_array)
            return ChosenScalar::kMagnitude;
        throw Error("{}: array {} has {} components, choose one with --component 0 to {} or "
                    "--component magnitude{}",
                    file, array.name, array.components, array.components - 1,
                    array.maybe_steps ? "; --extra-axis-is-time reads them as steps" : "");
    }
    const std::string& text = *options.component;
    if (text == "magnitude")
        return ChosenScalar::kMagnitude;
    std::uint32_t number = 0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (failure != std::errc{} || end != text.data() + text.size() || number >= array.components)
        throw Error(
            array.components == 1
                ? fmt::format("{}: array {} is a scalar, without a component {}", file, array.name,
                              text)
                : fmt::format("{}: array {} has no component {}, expected 0 to {} or magnitude",
                              file, array.name, text, array.components - 1));
    return number;
}

/// Values of tuples in double, for any stored type.
template <class T>
class TupleValues {
  public:
    TupleValues(const ChosenScalar& chosen, std::span<const std::byte> tuples)
        : first_(reinterpret_cast<const T*>(tuples.data())), components_(chosen.array.components),
          component_(chosen.component) {}

    double operator()(std::size_t i) const {
        const T* tuple = first_ + i * components_;
        if (component_ != ChosenScalar::kMagnitude)
            return static_cast<double>(tuple[component_]);
        double sum = 0;
        for (std::uint32_t c = 0; c < components_; ++c)
            sum += static_cast<double>(tuple[c]) * static_cast<double>(tuple[c]);
        return std::sqrt(sum);
    }

  private:
    const T* first_;
    std::uint32_t components_, component_;
};

// The value at a vertex is the mean of the up to 8 cells around it, NaN if one of them is NaN.
// Missing cells are ignored.
template <class T, class Values>
void average_to_vertices(const Values& cell, const Grid& grid, T* out,
                         std::span<const std::uint8_t> missing) {
    const auto [nx, ny, nz] = grid.vertices;
    const auto [cx, cy, cz] = grid.cells();
    for (std::uint32_t z = 0; z < nz; ++z)
        for (std::uint32_t y = 0; y < ny; ++y)
            for (std::uint32_t x = 0; x < nx; ++x) {
                double sum = 0;
                int around = 0;
                for (std::uint32_t k = z ? z - 1 : 0; k <= std::min(z, cz - 1); ++k)
                    for (std::uint32_t j = y ? y - 1 : 0; j <= std::min(y, cy - 1); ++j)
                        for (std::uint32_t i = x ? x - 1 : 0; i <= std::min(x, cx - 1); ++i) {
                            const std::size_t at = (std::size_t{k} * cy + j) * cx + i;
                            if (!missing.empty() && missing[at])
                                continue;
                            sum += cell(at);
                            ++around;
                        }
                *out++ = static_cast<T>(sum / around); // 0 / 0: NaN
            }
}

// Integers wider than 53 bits have no exact double; 2^63 and above cannot be cast back safely.
template <class T>
double exact(T stored, const std::string& file) {
    const double value = static_cast<double>(stored);
    if constexpr (sizeof(T) < sizeof(double))
        return value;
    if (value >= static_cast<double>(std::numeric_limits<T>::max()) ||
        static_cast<T>(value) != stored)
        throw Error("{}: the value {} has no exact f64, expected integers of up to 53 bits", file,
                    stored);
    return value;
}

} // namespace

void swap_bytes(std::span<std::byte> values, std::size_t size) {
    for (std::size_t i = 0; i + size <= values.size(); i += size)
        std::ranges::reverse(values.subspan(i, size));
}

std::size_t size_of(StoredType type) {
    return visit_stored_type(type, []<class T>(std::type_identity<T>) { return sizeof(T); });
}

std::string_view name_of(StoredType type) {
    return kNames[static_cast<std::size_t>(type)];
}

StoredType stored_type_of(ValueType type) {
    const auto found = std::find(kNames.begin(), kNames.end(), name_of(type));
    return static_cast<StoredType>(found - kNames.begin());
}

ValueType ChosenScalar::value_type() const {
    const StoredType stored = *array.type;
    if (component == kMagnitude || array.on_cells || array.gaps)
        return fits_f32(stored) ? ValueType::f32 : ValueType::f64;
    return value_type_from_name(name_of(stored)).value_or(ValueType::f64);
}

void ChosenScalar::describe(SeriesInfo& info) const {
    info.arrays = offered;
    info.array = label();
    info.type = value_type();
}

std::string ChosenScalar::label() const {
    if (component == kMagnitude)
        return array.name + ".magnitude";
    return array.components == 1 ? array.name : fmt::format("{}.{}", array.name, component);
}

std::vector<std::string> ChosenScalar::notes() const {
    std::vector<std::string> notes;
    if (array.on_cells)
        notes.push_back("cell data averaged to vertices");
    if (!array.on_cells && component != kMagnitude && stored_type_of(value_type()) != *array.type)
        notes.push_back(fmt::format("{} values converted to {}{}", name_of(*array.type),
                                    name_of(value_type()),
                                    array.gaps ? ", missing ones to NaN" : ""));
    return notes;
}

ChosenScalar choose_scalar(std::span<const StoredArray> arrays, const ReadOptions& options,
                           const std::string& file) {
    const StoredArray* found = nullptr;
    bool open = false;
    for (const StoredArray& array : arrays) {
        if (options.array ? array.name != *options.array : !is_offered(array))
            continue;
        if (!found || (found->name == array.name && found->on_cells))
            found = &array;
        else if (found->name != array.name)
            open = true;
    }
    std::vector<std::string> offered = offered_of(arrays);
    const std::string list = listed(offered);
    if (list.empty() && !found)
        throw Error("{}: holds no array{}", file,
                    arrays.empty() ? "" : " of numbers that can be read");
    if (open && !options.any_array)
        throw Error("{}: several arrays, choose one with --array: {}; --all-arrays takes all of "
                    "one shape{}",
                    file, list, advice_on_families(arrays));
    if (!found)
        throw Error("{}: no array {}, expected one of: {}", file, *options.array, list);
    if (!found->type)
        throw Error("{}: array {} does not hold numbers that can be read", file, found->name);
    return {*found, component_of(*found, options, file), std::move(offered)};
}

void convert(const ChosenScalar& chosen, std::span<const std::byte> tuples, const Grid& grid,
             std::span<std::byte> out, const std::string& file,
             std::span<const std::uint8_t> missing) {
    const ValueType type = chosen.value_type();
    const std::size_t count = out.size() / size_of(type);
    visit_stored_type(*chosen.array.type, [&]<class S>(std::type_identity<S>) {
        visit_value_type(type, [&]<class T>(std::type_identity<T>) {
            T* to = reinterpret_cast<T*>(out.data());
            const S* from = reinterpret_cast<const S*>(tuples.data());
            const TupleValues<S> value(chosen, tuples);
            if (chosen.array.on_cells) {
                average_to_vertices(value, grid, to, missing);
            } else if (chosen.component == ChosenScalar::kMagnitude) {
                for (std::size_t i = 0; i < count; ++i)
                    to[i] = static_cast<T>(value(i));
            } else if constexpr (std::is_same_v<S, T>) { // NOLINT: discarded branches are alike
                if (chosen.array.components == 1)
                    std::memcpy(to, from, count * sizeof(T));
                else
                    for (std::size_t i = 0; i < count; ++i)
                        to[i] = from[i * chosen.array.components + chosen.component];
            } else if constexpr (std::is_integral_v<S> && std::is_floating_point_v<T>) {
                for (std::size_t i = 0; i < count; ++i)
                    to[i] = static_cast<T>(
                        exact(from[i * chosen.array.components + chosen.component], file));
            } else { // what value_type() never chooses
                throw Error("{}: values of this type cannot be kept", file);
            }
            if constexpr (std::is_floating_point_v<T>)
                if (!chosen.array.on_cells)
                    for (std::size_t i = 0; i < missing.size(); ++i)
                        if (missing[i])
                            to[i] = std::numeric_limits<T>::quiet_NaN();
        });
    });
}

void convert_planes(
    const ChosenScalar& chosen, const Grid& grid, std::span<std::byte> out, const std::string& file,
    const std::function<void(std::size_t component, std::span<std::byte> plane)>& load) {
    const StoredType stored = *chosen.array.type;
    const bool magnitude = chosen.component == ChosenScalar::kMagnitude;
    if (!magnitude && stored_type_of(chosen.value_type()) == stored)
        return load(chosen.component, out);
    const std::size_t size = size_of(stored), values = grid.vertex_count();
    ChosenScalar of_tuples = chosen;
    if (!magnitude) {
        of_tuples.array.components = 1;
        of_tuples.component = 0;
    }
    const std::size_t components = of_tuples.array.components;
    std::vector<std::byte> tuples(values * size * components), plane(values * size);
    for (std::size_t c = 0; c < components; ++c) {
        load(magnitude ? c : chosen.component, plane);
        for (std::size_t i = 0; i < values; ++i)
            std::copy_n(&plane[i * size], size, &tuples[(i * components + c) * size]);
    }
    convert(of_tuples, tuples, grid, out, file);
}

} // namespace isochron::index
