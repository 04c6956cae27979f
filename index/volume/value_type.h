// The types of stored scalars, and the scaling that turns stored values into the user's values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>

namespace isochron::index {

enum class ValueType : std::uint8_t { i8, u8, i16, u16, i32, f32, f64 };

/// Bytes of one stored value.
std::size_t size_of(ValueType type);

/// `i8`, `u8`, ..., as used on the command line and in files.
std::string_view name_of(ValueType type);
std::optional<ValueType> value_type_from_name(std::string_view name);

/// Significant digits in which values are said where nothing is known of their range.
inline constexpr int kFewestDigits = 6;
/// Significant digits that tell the values of a range apart to a thousandth of it, 6 to 12: 8 for
/// pressures from 101316 to 101326 Pa.
int telling_digits(double low, double high);

/// Calls `f(std::type_identity<T>{})` with the C++ type of `type`.
template <class F>
decltype(auto) visit_value_type(ValueType type, F&& f) {
    switch (type) {
    case ValueType::i8: return std::forward<F>(f)(std::type_identity<std::int8_t>{});
    case ValueType::u8: return std::forward<F>(f)(std::type_identity<std::uint8_t>{});
    case ValueType::i16: return std::forward<F>(f)(std::type_identity<std::int16_t>{});
    case ValueType::u16: return std::forward<F>(f)(std::type_identity<std::uint16_t>{});
    case ValueType::i32: return std::forward<F>(f)(std::type_identity<std::int32_t>{});
    case ValueType::f32: return std::forward<F>(f)(std::type_identity<float>{});
    case ValueType::f64: break;
    }
    return std::forward<F>(f)(std::type_identity<double>{});
}

/// value = slope * stored + intercept, in double: stored values keep their type (NIfTI scl_slope).
/// Isovalues are compared after scaling. The slope is never 0 and may be negative.
struct Scaling {
    double slope = 1.0;
    double intercept = 0.0;
    double operator()(double stored) const { return slope * stored + intercept; }
    bool operator==(const Scaling&) const = default;
};

} // namespace isochron::index
