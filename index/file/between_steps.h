// Values and bounds between two steps: chunks of both are blended when they are needed.
#pragma once

#include "index/file/chunks/byte_cache.h"
#include "index/file/chunks/chunk_store.h"
#include "index/volume/blend.h"
#include "index/volume/instant.h"

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <stop_token>
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

    const LevelMapPtr& levels() const { return levels_; }
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
    /// The ranks of a moment of a store, which keeps the last ones for any isovalues. @throws as
    /// ChunkStore does
    static std::shared_ptr<const BlendedRanks> of(const ChunkStore& store, Instant at,
                                                  const Blend& blend);

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

    LevelMapPtr levels_;
    std::optional<Table> low_, high_;
    bool reversed_; ///< larger stored values are smaller scaled ones
};

/// A place at both steps, for whoever blends only the values that are needed: `bricks` are bounds of
/// the blends, `values` the first step's.
struct ChunkPair : Chunk {
    ChunkPtr now, next;
};

/// What a store has at a moment between two of its steps. Keeps what it has blended, up to a limit.
/// Thread-safe; throws as ChunkStore does.
class BetweenSteps {
  public:
    /// @param store outlives this @param at between two steps of it @param blend of them
    BetweenSteps(const ChunkStore& store, Instant at, const Blend& blend);

    const Blend& kind() const { return blend_; }
    const BlendedRanks& ranks() const;
    LevelMapPtr levels() const { return ranks().levels(); }
    ChunkLayerPtr layer(std::uint32_t layer) const;
    std::vector<ChunkPtr> chunks(std::uint32_t layer, std::span<const std::uint32_t> places,
                                 const std::stop_token& stop) const;
    /// The chunks at both steps, each a ChunkPair.
    std::vector<ChunkPtr> pairs(std::uint32_t layer, std::span<const std::uint32_t> places,
                                const std::stop_token& stop) const;
    std::uint64_t expect(std::uint32_t first,
                         std::span<const std::vector<std::uint32_t>> places) const;
    std::uint64_t fetch(std::uint32_t layer, std::span<const std::uint32_t> places,
                        const std::stop_token& stop) const;

    /// The blend of two whole steps. @param store has the levels of their bricks, if they have some
    static LoadedStep whole(const LoadedStep& now, const LoadedStep& next, Instant at,
                            const ChunkStore* store, const Blend& blend);

  private:
    void blend_bricks(const Chunk& now, const Chunk& next, Chunk& out) const;
    ChunkPtr blended(const Chunk& now, const Chunk& next) const;

    const ChunkStore& store_;
    Instant at_;
    Blend blend_;
    mutable std::once_flag made_ranks_;
    mutable std::shared_ptr<const BlendedRanks> ranks_;
    mutable ByteCache kept_;
};

} // namespace isochron::index
