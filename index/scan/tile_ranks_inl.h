// How tiles lie in memory, and the ranks of their values; compiled once for each SIMD target.
#include "index/scan/brick_tiles.h"
#include "index/scan/bricks.h"

#include <hwy/highway.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

// Highway's guard: the file is read again for every target.
#if defined(ISOCHRON_INDEX_TILE_RANKS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ISOCHRON_INDEX_TILE_RANKS_INL_H
#undef ISOCHRON_INDEX_TILE_RANKS_INL_H
#else
#define ISOCHRON_INDEX_TILE_RANKS_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace isochron::index::HWY_NAMESPACE {

constexpr auto kTileCells = BrickGrid::kCells;
constexpr std::size_t kAcross = kTileCells[0] + 1;   ///< vertices along x
constexpr std::size_t kTileRows = kTileCells[1] + 1; ///< along y
constexpr std::size_t kPlanes = kTileCells[2] + 1;   ///< along z
constexpr std::size_t kPlaneRanks = kAcross * kTileRows;
constexpr std::size_t kMissing = kPlanes * kPlaneRanks;   ///< says whether there are NaN
constexpr std::uint8_t kHighestRank = 254, kNoRank = 255; ///< the latter of NaN

/// How values become ranks. Floats keep the order of values of up to 16 bits and of floats exactly;
/// other types may share one, which is harmless: equal ranks are looked up.
template <class T>
using Rankable = std::conditional_t<sizeof(T) <= 2 || std::is_same_v<T, float>, float, double>;

struct Ranking {
    double low, scale;
};
static_assert(kMissing + 1 + sizeof(Ranking) <= kTileBytes);

/// Monotone in `value`. It has no sum of a product, which processors round differently.
template <class F>
HWY_INLINE std::uint8_t rank_of(F value, F low, F scale) {
    F rank = (value - low) * scale;
    rank = rank > 0 ? rank : 0;
    rank = rank < F{kHighestRank} ? rank : F{kHighestRank};
    return static_cast<std::uint8_t>(static_cast<int>(rank));
}

HWY_INLINE Ranking ranking_of(const std::uint8_t* tile) {
    Ranking ranking;
    std::memcpy(&ranking, tile + kTileBytes - sizeof ranking, sizeof ranking);
    return ranking;
}

/// The place of a brick.
struct Place {
    Place(std::uint32_t brick, const std::array<std::uint32_t, 3>& bricks)
        : x(brick % bricks[0] * kTileCells[0]) {
        const std::uint32_t row = brick / bricks[0];
        y = row % bricks[1] * kTileCells[1];
        z = row / bricks[1] * kTileCells[2];
    }
    std::uint32_t x, y, z; ///< its first vertex
};

} // namespace isochron::index::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
