// Bounds of the values between two steps, without any of these values.
#pragma once

#include "index/volume/blend.h"
#include "index/volume/level_map.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace isochron::index {

/// Bounds of blended values, as ranks among levels of blended values. A blend never decreases when
/// one of its two values grows, so the blend of two bounds is a bound of the blends. The levels are
/// those of the steps, or, where the isovalues are known, these isovalues: then far fewer blends tell
/// all ranks.
class BlendedRanks {
  public:
    /// @param now, next the levels of the two steps
    /// @param isovalues that the bounds will be compared with; empty: any may be
    BlendedRanks(const LevelMap& now, const LevelMap& next, const Scaling& scaling,
                 const Blend& blend, std::uint32_t n, std::span<const double> isovalues = {});

    const std::shared_ptr<const LevelMap>& levels() const { return levels_; }
    /// Leaves only the bricks of a whole step whose blends may hold active cells: all others hold
    /// none. @param now, next as from `build_bricks` @param cut among `levels()`
    /// @param found gets the numbers of those that are left, ascending
    std::vector<std::uint8_t> candidates(std::span<const std::uint8_t> now,
                                         std::span<const std::uint8_t> next,
                                         const LevelMap::Cut& cut,
                                         std::vector<std::uint32_t>& found) const;
    /// @param low, high ranks of some values, at the first and at the second step; replaced by the
    ///        ranks of their blends @param low_next, high_next the second step's
    void blend(std::span<std::uint8_t> low, std::span<std::uint8_t> high,
               std::span<const std::uint8_t> low_next,
               std::span<const std::uint8_t> high_next) const;
    std::uint64_t bytes() const;

  private:
    /// The rank of a blend by the ranks of its two values.
    struct Table {
        /// By the first rank: the lowest second one with which the blend is at a threshold or above.
        using Reach = std::array<std::uint16_t, LevelMap::kMaxLevels>;
        std::vector<Reach> few;        ///< a Reach for each threshold
        std::vector<std::uint8_t> all; ///< by both ranks, where there is no `few`
        /// By threshold of `few`: the lowest first rank, and the lowest second one, whose values
        /// are there.
        std::vector<std::array<std::uint16_t, 2>> alone;

        /// @param now, next values of the ranks, monotone @param thresholds of blends, ascending
        Table(std::span<const double> now, std::span<const double> next, std::uint32_t n,
              std::span<const double> thresholds);
        std::uint8_t operator()(std::uint8_t now_rank, std::uint8_t next_rank) const {
            if (!all.empty())
                return all[now_rank * LevelMap::kMaxLevels + next_rank];
            unsigned rank = 0;
            for (const Reach& reach : few)
                rank += next_rank >= reach[now_rank] ? 1 : 0;
            return static_cast<std::uint8_t>(rank);
        }
    };
    static Table table_of(const LevelMap& now, const LevelMap& next, const Scaling& scaling,
                          std::uint32_t n, std::span<const double> thresholds, bool of_last);

    /// Blends the bounds of one brick or chunk.
    void blend(std::uint8_t& low, std::uint8_t& high, std::uint8_t low_next,
               std::uint8_t high_next) const {
        if (low > high || low_next > high_next) { // no cell without missing values
            low = 255;
            high = 0;
            return;
        }
        const std::uint8_t of_low = low;
        low = reversed_ ? (*low_)(high, high_next) : (*low_)(low, low_next);
        high = reversed_ ? (*high_)(of_low, low_next) : (*high_)(high, high_next);
    }

    std::shared_ptr<const LevelMap> levels_;
    std::optional<Table> low_, high_;
    bool reversed_; ///< larger stored values are smaller scaled ones
};

} // namespace isochron::index
