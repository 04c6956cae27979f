// Ranks of stored values among at most 256 levels: what bricks and cells are indexed by.
//
//     const auto levels = index::LevelMap::of_type(ValueType::u8);        // 256 levels: lossless
//     levels.ranks(std::as_bytes(values.step<std::uint8_t>(t)), ranks);   // a byte for each vertex
//     if (const auto cut = levels.cut(values.scaling, isovalue))          // what to search for
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

/// A rank is the number of thresholds that are not above a value, 0 to 255: monotone, and exact at
/// every threshold (`rank >= k` if and only if the value reaches the k-th threshold). Works on
/// stored values, before scaling.
class LevelMap {
  public:
    static constexpr std::size_t kMaxLevels = 256;

    /// Every value of an 8-bit type has its own rank.
    static LevelMap of_type(ValueType type);
    /// Lossless: every value has its own rank. @param distinct ordinals (ordinal.h) of all values
    ///   of the series, ascending, at most 256
    static LevelMap of_values(ValueType type, std::span<const std::uint64_t> distinct);
    /// @param thresholds ordinals, ascending, at most 255
    static LevelMap of_thresholds(ValueType type, std::span<const std::uint64_t> thresholds);

    ValueType type() const { return type_; }
    /// True when no two values of the series have the same rank: every cut is exact.
    bool lossless() const { return lossless_; }
    std::size_t levels() const { return thresholds_.size() + 1; }
    std::span<const std::uint64_t> thresholds() const { return thresholds_; }
    /// All values' ordinals, as `of_values` takes them; of a lossless map.
    std::vector<std::uint64_t> distinct() const;

    /// The side of a vertex by its rank: upper if `rank >= level` when exact; else upper if above
    /// the level, lower if below, and open if at it, which only the volume decides. The level is
    /// never 0 when exact.
    struct Cut {
        std::uint8_t level = 0;
        bool exact = false;
        bool operator==(const Cut&) const = default;
    };
    /// None when all values lie on one side: no cell is active.
    std::optional<Cut> cut(const Scaling& scaling, double isovalue) const;

    /// Ranks of stored values of `type()`; that of a NaN is of no use.
    void ranks(std::span<const std::byte> stored, std::span<std::uint8_t> out) const;

    bool operator==(const LevelMap&) const = default;

  private:
    LevelMap(ValueType type, std::vector<std::uint64_t> thresholds, bool lossless,
             std::uint64_t lowest);

    ValueType type_;
    std::vector<std::uint64_t> thresholds_; ///< ordinals
    bool lossless_;
    std::uint64_t lowest_;            ///< ordinal of the lowest value, where lossless
    std::vector<std::uint8_t> table_; ///< rank of every ordinal, for types of up to 16 bits
};

} // namespace isochron::index
