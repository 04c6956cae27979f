// Values and bounds between two steps: chunks of both are blended when they are needed.
#pragma once

#include "index/file/blended_ranks.h"
#include "index/file/chunks/byte_cache.h"
#include "index/file/chunks/chunk_store.h"
#include "index/volume/blend.h"
#include "index/volume/instant.h"

#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <stop_token>
#include <vector>

namespace isochron::index {

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
