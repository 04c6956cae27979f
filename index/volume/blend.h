// The values between two steps, exactly: on which side of an isovalue a blended vertex lies is never
// a matter of rounding.
#pragma once

#include "index/volume/value_type.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace isochron::index {

/// The blend ((N - n) a + n b) / N of two values, rounded down to a double; N is
/// Instant::kFractions. A double v is at most the result if and only if v is at most the exact
/// blend, so comparing the result with an isovalue is exact. NaN unless both are finite.
/// @param n 0 to N
double blended(double a, double b, std::uint32_t n);

/// Blends the stored values of two steps: scales both as queries do, and blends each pair exactly.
/// Whole numbers of 8 and 16 bits without scaling become i32 in units of 1/N, which hold the exact
/// blend; all other values become f64, as `blended` gives them. If only some isovalues are asked
/// for, f32 stays f32, half as large: the exact blend rounded to the nearest f32, or, if that would
/// cross one of the isovalues, to the nearest f32 on the blend's own side.
class Blend {
  public:
    /// @param n 1 to N - 1
    /// @param isovalues that blended values will be compared with; empty, or more than
    ///        kMostIsovalues: any may be. f32 without scaling stay f32 for some that f32 can tell apart
    Blend(ValueType type, const Scaling& scaling, std::uint32_t n,
          std::span<const double> isovalues = {});
    static constexpr std::size_t kMostIsovalues = 8;

    /// What blended values are stored as.
    ValueType type() const { return type_; }
    const Scaling& scaling() const { return scaling_; }
    /// The isovalues that it was made for, finite and each once; empty: any.
    std::span<const double> isovalues() const { return std::span(isovalues_).first(count_); }

    /// @param a, b aligned stored values of the two steps, equally many
    /// @param out as many values of `type()`, aligned
    void operator()(std::span<const std::byte> a, std::span<const std::byte> b,
                    std::byte* out) const;
    /// Some values next to each other, by their numbers.
    struct Run {
        std::size_t first, count;
    };
    /// Blends these runs alone.
    /// @param a, b, out as above, of all values
    void operator()(const std::byte* a, const std::byte* b, std::span<const Run> runs,
                    std::byte* out) const;

    /// An isovalue among f32. All of these numbers are f32 values, or infinite.
    struct Side {
        double isovalue;     ///< itself
        double above, below; ///< the lowest f32 at or above it, and the f32 before that
    };

  private:
    void stay_single();
    void blend_doubles(const std::byte* a, const std::byte* b, std::size_t count, double* to) const;

    ValueType stored_, type_;
    Scaling stored_scaling_, scaling_;
    std::uint32_t n_;
    std::array<double, kMostIsovalues> isovalues_{};
    std::size_t count_ = 0;
    std::array<Side, kMostIsovalues> sides_{}; ///< sides of the isovalues, if f32 stays f32
};

} // namespace isochron::index
