// Converts values for volume blocks so that a GPU sees every value on the right side of an
// isovalue.
#pragma once

#include "index/volume/order_key.h"
#include "index/volume/value_type.h"

#include <cstddef>
#include <span>
#include <vector>

namespace isochron::index {

/// The isovalues of a query in block units.
struct BlockLevels {
    /// In the order of the query's isovalues, in block units: a vertex is below isovalue i, as
    /// `Query` defines it, if and only if `held * factor < units[i]`.
    std::vector<float> units;
    /// `units`, and the isovalues themselves; both ascending, without repetition.
    std::vector<float> rounded;
    std::vector<double> exact;
};

/// Values of 8 and 16 bits and f32 are held as they are stored. i32 and f64 become f32: the scaled
/// value relative to the middle of the data's range, in units of a power of two, rounded to the
/// nearest f32, or, if that would cross an isovalue, to the last f32 on the value's own side.
/// Isovalues that f32 cannot tell apart get neighboring levels, so that this is always possible.
///
/// *Block units* are `held * factor`. They have the order of the scaled values, and their size is
/// at most about 1 over the whole data set (4 near the end of the range of floating point).
class BlockValues {
  public:
    /// @param low, high range of the finite scaled values of the data set
    BlockValues(ValueType type, Scaling scaling, double low, double high);

    ValueType stored() const { return type_; }
    /// i8, u8, i16, u16 or f32.
    ValueType held() const { return held_; }
    /// A power of two, or its negative if larger stored values are smaller scaled ones.
    float factor() const { return factor_; }
    /// `high - low` in block units, at least the smallest normal f32.
    float range() const { return range_; }

    BlockLevels levels(std::span<const double> isovalues) const;

    /// Converts stored values of one row to held ones.
    /// @param stored `count` aligned values of the stored type
    /// @param out `count` values of the held type
    void convert(const std::byte* stored, std::size_t count, const BlockLevels& levels,
                 std::byte* out) const;

  private:
    bool converts() const { return type_ == ValueType::i32 || type_ == ValueType::f64; }
    double relative(double scaled) const { return (scaled - middle_) * to_units_; }
    float stored_level(double isovalue) const;

    ValueType type_, held_;
    Scaling scaling_;
    KeyMap keys_;
    /// How values are converted: their middle, and the factor to block units.
    double middle_ = 0, to_units_ = 1;
    float factor_ = 1, range_ = 1;
};

} // namespace isochron::index
