// Names and sizes of the value types.
#include "index/volume/value_type.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace isochron::index {
namespace {

constexpr std::array kAll{ValueType::i8,  ValueType::u8,  ValueType::i16, ValueType::u16,
                          ValueType::i32, ValueType::f32, ValueType::f64};
constexpr std::array<std::string_view, kAll.size()> kNames{"i8",  "u8",  "i16", "u16",
                                                           "i32", "f32", "f64"};

} // namespace

std::size_t size_of(ValueType type) {
    return visit_value_type(type, []<class T>(std::type_identity<T>) { return sizeof(T); });
}

std::string_view name_of(ValueType type) {
    return kNames[static_cast<std::size_t>(type)];
}

std::optional<ValueType> value_type_from_name(std::string_view name) {
    for (ValueType type : kAll)
        if (name_of(type) == name)
            return type;
    return std::nullopt;
}

int telling_digits(double low, double high) {
    constexpr int kMost = 12;
    const auto power = [](double number) {
        return number == 0 ? 0 : static_cast<int>(std::floor(std::log10(std::abs(number))));
    };
    const double apart = std::abs(high - low), larger = std::max(std::abs(low), std::abs(high));
    return std::isfinite(apart) && apart > 0
               ? std::clamp(power(larger) - power(apart) + 4, kFewestDigits, kMost)
               : kFewestDigits;
}

} // namespace isochron::index
