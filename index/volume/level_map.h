// Ranks of stored values among at most 256 levels, by which bricks are indexed.
//
//     const auto levels = index::LevelMap::of_type(ValueType::u8);        // 256 levels: lossless
//     levels.ranks(std::as_bytes(values.step<std::uint8_t>(t)), ranks);   // a byte for each vertex
//     if (const auto cut = levels.cut(values.scaling, isovalue))          // the threshold to find
//         search(*cut);
#pragma once

#include "index/volume/value_type.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace isochron::index {

/// The rank of a value is the number of thresholds that are not above it, 0 to 255. Ranks are
/// monotone and exact at every threshold: `rank >= k` if and only if the value is not below the
/// k-th threshold. They are of stored values, before scaling.
class LevelMap {
  public:
    static constexpr std::size_t kMaxLevels = 256;

    /// The map for an 8-bit type: every value has its own rank.
    static LevelMap of_type(ValueType type);
    /// Lossless: every value has its own rank. @param distinct ordinals (ordinal.h) of all values
    ///   of the series, ascending, at most 256
    static LevelMap of_values(ValueType type, std::span<const std::uint64_t> distinct);
    /// @param thresholds ordinals, ascending, at most 255
    static LevelMap of_thresholds(ValueType type, std::span<const std::uint64_t> thresholds);

    /// Lowest and highest value that the map is for, as ordinals: isovalues beyond them have no
    /// active cells. A lossless map knows them without this.
    struct Extremes {
        std::uint64_t low = 0, high = ~std::uint64_t{0};
        bool operator==(const Extremes&) const = default;
    };
    void set_extremes(const Extremes& extremes) { extremes_ = extremes; }
    const std::optional<Extremes>& extremes() const { return extremes_; }

    ValueType type() const { return type_; }
    /// True if no two values of the series have the same rank: then every cut is exact.
    bool lossless() const { return lossless_; }
    std::size_t levels() const { return thresholds_.size() + 1; }
    std::span<const std::uint64_t> thresholds() const { return thresholds_; }
    /// The ordinals of all values, as `of_values` takes them. The map must be lossless.
    std::vector<std::uint64_t> distinct() const;

    /// The threshold that tells on which side of an isovalue a vertex is, by its number. If exact, a
    /// vertex is upper if `rank >= threshold`, else lower; the threshold is never 0. If not exact, a
    /// vertex is upper if `rank > threshold` and lower if `rank < threshold`; at
    /// `rank == threshold` only the volume tells.
    struct Cut {
        std::uint8_t threshold = 0;
        bool exact = false;
        /// Whether cells with ranks from `low` to `high` may be active.
        bool may_hold(std::uint8_t low, std::uint8_t high) const {
            return low + (exact ? 1 : 0) <= threshold && high >= threshold;
        }
        bool operator==(const Cut&) const = default;
    };
    /// None if all values are on one side, so that no cell is active.
    std::optional<Cut> cut(const Scaling& scaling, double isovalue) const;

    /// Ranks of stored values of `type()`; the rank of a NaN has no meaning.
    void ranks(std::span<const std::byte> stored, std::span<std::uint8_t> out) const;

    bool operator==(const LevelMap&) const = default;

  private:
    LevelMap(ValueType type, std::vector<std::uint64_t> thresholds, bool lossless,
             std::uint64_t lowest);

    ValueType type_;
    std::vector<std::uint64_t> thresholds_; ///< ordinals
    bool lossless_;
    std::uint64_t lowest_; ///< ordinal of the lowest value, if lossless
    std::optional<Extremes> extremes_;
    std::vector<std::uint8_t> table_; ///< rank of every ordinal, for types of up to 16 bits
};

} // namespace isochron::index
