// Monotone 32-bit keys for values of every type, so that search structures compare integers only.
#pragma once

#include "index/volume/ordinal.h"
#include "index/volume/value_type.h"

#include <cstdint>

namespace isochron::index {

/// A key with `value a < value b` (scaled) implies `key a < key b`, and equal keys mean equal
/// values. Every type but f64 keeps the order of its stored values exactly; f64 is rounded to f32:
/// down for minima, up for maxima, so that an interval of keys never loses an isovalue.
using OrderKey = std::uint32_t;

/// Turns stored values into keys and isovalues into key thresholds, for one type and scaling.
///
/// The thresholds are exact although several stored values may round to one scaled value:
/// multiplying by a constant and adding a constant are monotone in floating point, so the scaled
/// values never decrease with the key, and the keys with `value >= isovalue` are all those from the
/// threshold on.
class KeyMap {
  public:
    KeyMap(ValueType type, Scaling scaling);

    /// Key of a stored value, which must not be NaN. -0 and +0 have one key.
    /// For f64: the nearest f32 not above (`low_key`) or not below (`high_key`) the scaled value.
    template <class T>
    OrderKey low_key(T stored) const {
        if constexpr (std::is_same_v<T, double>)
            return ordinal(rounded_down(scaling_(stored)));
        else
            return ordinal(stored) ^ flip_;
    }
    template <class T>
    OrderKey high_key(T stored) const {
        if constexpr (std::is_same_v<T, double>)
            return ordinal(-rounded_down(-scaling_(stored)));
        else
            return ordinal(stored) ^ flip_;
    }

    /// Smallest key whose scaled value is >= isovalue: `min < v` <=> `low_key(min) < threshold(v)`
    /// and `max >= v` <=> `high_key(max) >= threshold(v)` (for f64 only `=>`). One above the
    /// highest key, which may be 2^32, when no value of the type reaches the isovalue.
    /// The isovalue is finite.
    std::uint64_t threshold(double isovalue) const;

    /// Scaled value of a key, for reports. For f64: the f32 that the key stands for.
    double value(OrderKey key) const;

    /// True when larger stored values are smaller scaled ones.
    bool reversed() const { return scaling_.slope < 0; }

  private:
    static float rounded_down(double value);

    ValueType type_;
    Scaling scaling_;
    OrderKey flip_;         ///< all ones when the order of keys is not that of the stored values
    OrderKey first_, last_; ///< of the type's values
};

} // namespace isochron::index
