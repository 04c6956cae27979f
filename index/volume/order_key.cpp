// Monotone 32-bit keys for values of every type.
#include "index/volume/order_key.h"

#include <algorithm>

namespace isochron::index {
namespace {

/// Calls `f` with the type whose ordinals are the keys: the stored type, or f32 for f64.
template <class F>
auto visit_key_type(ValueType type, F&& f) {
    return visit_value_type(type == ValueType::f64 ? ValueType::f32 : type, f);
}

} // namespace

KeyMap::KeyMap(ValueType type, Scaling scaling) : type_(type), scaling_(scaling) {
    flip_ = type != ValueType::f64 && reversed() ? ~OrderKey{0} : 0;
    visit_key_type(type, [&]<class T>(std::type_identity<T>) {
        first_ = static_cast<OrderKey>(lowest_ordinal<T>()) ^ flip_;
        last_ = static_cast<OrderKey>(highest_ordinal<T>()) ^ flip_;
    });
    if (flip_)
        std::swap(first_, last_);
}

float KeyMap::rounded_down(double value) {
    constexpr double kHighest = std::numeric_limits<float>::max();
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    if (value > kHighest)
        return std::isinf(value) ? kInfinity : static_cast<float>(kHighest);
    if (value < -kHighest)
        return -kInfinity;
    const auto nearest = static_cast<float>(value);
    return nearest > value ? std::nextafter(nearest, -kInfinity) : nearest;
}

std::uint64_t KeyMap::threshold(double isovalue) const {
    return first_that(first_, std::uint64_t{last_} + 1, [&](std::uint64_t key) {
        return value(static_cast<OrderKey>(key)) >= isovalue;
    });
}

double KeyMap::value(OrderKey key) const {
    return visit_key_type(type_, [&]<class T>(std::type_identity<T>) {
        const auto stored =
            static_cast<double>(from_ordinal<T>(static_cast<Ordinal<T>>(key ^ flip_)));
        return type_ == ValueType::f64 ? stored : scaling_(stored);
    });
}

} // namespace isochron::index
