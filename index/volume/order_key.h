// Monotone 32-bit keys for values of every type, so that search structures compare integers only.
#pragma once

#include "index/volume/ordinal.h"
#include "index/volume/value_type.h"

#include <cstdint>

namespace isochron::index {

/// An integer that orders values: if scaled value a < b, then key a < key b, and equal keys mean
/// equal values. That holds exactly for every type but f64. f64 is rounded to f32, down for minima
/// and up for maxima, so that an interval of keys never loses an isovalue.
using OrderKey = std::uint32_t;

/// Turns stored values into keys and isovalues into key thresholds, for one type and scaling.
///
/// The thresholds are exact although several stored values may round to one scaled value. In
/// floating point, multiplying by a constant and adding a constant are monotone. So scaled values
/// never decrease as keys increase, and `value >= isovalue` holds for all keys from the threshold
/// on.
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

    /// The smallest key whose scaled value is >= isovalue: `min < v` <=> `low_key(min) <
    /// threshold(v)` and `max >= v` <=> `high_key(max) >= threshold(v)` (for f64 only `=>`). If all
    /// values of the type are below the isovalue, it is the highest key + 1, which may be 2^32.
    /// The isovalue must be finite.
    std::uint64_t threshold(double isovalue) const;

    /// Scaled value of a key, for reports. For f64: the f32 that the key stands for.
    double value(OrderKey key) const;

    /// True when larger stored values are smaller scaled ones.
    bool reversed() const { return scaling_.slope < 0; }

  private:
    static float rounded_down(double value);

    ValueType type_;
    Scaling scaling_;
    OrderKey flip_;         ///< all ones if keys run against the stored values, else 0
    OrderKey first_, last_; ///< range of the keys of the type's values
};

} // namespace isochron::index
