// Makes tiles, and searches bricks by them: five words of bits for a brick's vertices, four for its
// cells.
#include "index/scan/brick_tiles.h"

#include "index/scan/bricks.h"
#include "index/system/parallel.h"
#include "index/volume/ordinal.h"
#include "index/volume/stored_cut.h"

#include <array>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "index/scan/brick_tiles.cpp"
#include <hwy/foreach_target.h> // must come before highway.h

#include <hwy/cache_control.h>

#include "index/scan/brick_candidates_inl.h"
#include "index/scan/vertex_bits_inl.h"

HWY_BEFORE_NAMESPACE();
namespace isochron::index::HWY_NAMESPACE {
namespace {

constexpr auto kTileCells = BrickGrid::kCells;
constexpr std::size_t kAcross = kTileCells[0] + 1;   ///< vertices along x
constexpr std::size_t kTileRows = kTileCells[1] + 1; ///< along y
constexpr std::size_t kPlanes = kTileCells[2] + 1;   ///< along z
constexpr std::size_t kPlaneRanks = kAcross * kTileRows;
constexpr std::size_t kTile = 256;                        ///< [bytes]; four cache lines
constexpr std::size_t kMissing = kPlanes * kPlaneRanks;   ///< says whether there are NaN
constexpr std::uint8_t kHighestRank = 254, kNoRank = 255; ///< the latter of NaN

/// How values become ranks. Floats keep the order of values of up to 16 bits and of floats exactly;
/// other types may share one, which is harmless: equal ranks are looked up.
template <class T>
using Rankable = std::conditional_t<sizeof(T) <= 2 || std::is_same_v<T, float>, float, double>;

struct Ranking {
    double low, scale;
};
static_assert(kMissing + 1 + sizeof(Ranking) <= kTile);

/// Monotone in `value`. It has no sum of a product, which processors round differently.
template <class F>
HWY_INLINE std::uint8_t rank_of(F value, F low, F scale) {
    F rank = (value - low) * scale;
    rank = rank > 0 ? rank : 0;
    rank = rank < F{kHighestRank} ? rank : F{kHighestRank};
    return static_cast<std::uint8_t>(static_cast<int>(rank));
}

Ranking ranking_of(const std::uint8_t* tile) {
    Ranking ranking;
    std::memcpy(&ranking, tile + kTile - sizeof ranking, sizeof ranking);
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

/// The vertices of a brick, with room for whole vectors. Beyond the border the last one repeats.
template <class F>
struct TileVertices {
    static constexpr std::size_t kCount = kPlanes * kPlaneRanks, kPadded = (kCount + 15) / 16 * 16;
    alignas(64) std::array<F, kPadded> of;

    template <class T>
    void take(const Grid& grid, const T* stored, const Place& at) {
        const auto [nx, ny, nz] = grid.vertices;
        const std::size_t width = std::min<std::size_t>(kAcross, nx - at.x);
        F* to = of.data();
        for (std::uint32_t z = 0; z < kPlanes; ++z)
            for (std::uint32_t y = 0; y < kTileRows; ++y, to += kAcross) {
                const T* row =
                    stored +
                    (std::size_t{std::min(at.z + z, nz - 1)} * ny + std::min(at.y + y, ny - 1)) *
                        nx +
                    at.x;
                if (HWY_LIKELY(width == kAcross)) {
                    for (std::size_t x = 0; x < kAcross; ++x)
                        to[x] = static_cast<F>(row[x]);
                } else {
                    for (std::size_t x = 0; x < kAcross; ++x)
                        to[x] = static_cast<F>(row[std::min(x, width - 1)]);
                }
            }
        std::fill(to, of.data() + kPadded, to[-1]);
    }
};

template <class T>
void fill_tile(const StepValues& values, const T* stored, const Place& at, std::uint8_t* tile) {
    using F = Rankable<T>;
    using Limits = std::numeric_limits<F>;
    TileVertices<F> vertices;
    vertices.take(values.grid, stored, at);
    const hn::CappedTag<F, 16> d;
    auto lows = hn::Set(d, Limits::max()), highs = hn::Set(d, Limits::lowest());
    for (std::size_t i = 0; i < vertices.kPadded; i += hn::Lanes(d)) {
        const auto v = hn::Load(d, vertices.of.data() + i);
        const auto finite =
            hn::And(hn::Ge(v, hn::Set(d, Limits::lowest())), hn::Le(v, hn::Set(d, Limits::max())));
        lows = hn::Min(lows, hn::IfThenElse(finite, v, lows));
        highs = hn::Max(highs, hn::IfThenElse(finite, v, highs));
    }
    F low = hn::GetLane(hn::MinOfLanes(d, lows));
    const F high = hn::GetLane(hn::MaxOfLanes(d, highs));
    F scale = F{kHighestRank} / (high - low);
    if (!(high > low) || !(scale > 0) || !std::isfinite(scale)) {
        low = high >= low ? low : 0;
        scale = 1;
    }
    std::array<std::uint8_t, vertices.kPadded> ranks;
    for (std::size_t i = 0; i < vertices.kPadded; i += hn::Lanes(d)) {
        const auto v = hn::Load(d, vertices.of.data() + i);
        auto rank = hn::Mul(hn::Sub(v, hn::Set(d, low)), hn::Set(d, scale)); // as in rank_of
        rank = hn::IfThenElse(hn::Gt(rank, hn::Zero(d)), rank, hn::Zero(d));
        const auto most = hn::Set(d, F{kHighestRank});
        rank = hn::IfThenElse(hn::Lt(rank, most), rank, most);
        rank = hn::IfThenElse(hn::Eq(v, v), rank, hn::Set(d, F{kNoRank}));
        const hn::Rebind<std::int32_t, decltype(d)> whole;
        const hn::Rebind<std::uint8_t, decltype(d)> bytes;
        if constexpr (sizeof(F) == 4)
            hn::StoreU(hn::DemoteTo(bytes, hn::ConvertTo(whole, rank)), bytes, ranks.data() + i);
        else
            hn::StoreU(hn::DemoteTo(bytes, hn::DemoteTo(whole, rank)), bytes, ranks.data() + i);
    }
    std::memset(tile, kNoRank, kTile);
    std::memcpy(tile, ranks.data(), vertices.kCount);
    tile[kMissing] = std::is_floating_point_v<T> &&
                     std::memchr(ranks.data(), kNoRank, vertices.kCount) != nullptr;
    const Ranking ranking{low, scale};
    std::memcpy(tile + kTile - sizeof ranking, &ranking, sizeof ranking);
}

/// Fills the tiles of one layer of bricks.
void fill_layer(const StepValues& values, std::size_t step, std::uint32_t layer,
                std::uint8_t* tiles) {
    const auto bricks = BrickGrid(values.grid).bricks();
    const std::uint32_t count = bricks[0] * bricks[1];
    visit_value_type(values.type, [&]<class T>(std::type_identity<T>) {
        const T* stored = values.step<T>(step).data();
        for (std::uint32_t brick = layer * count; brick < (layer + 1) * count; ++brick)
            fill_tile(values, stored, Place(brick, bricks), tiles + std::size_t{brick} * kTile);
    });
}

template <class T>
class TileSearch {
  public:
    TileSearch(const StepValues& values, std::size_t step, T cut, const std::uint8_t* tiles,
               std::vector<CellId>& out)
        : bricks_(BrickGrid(values.grid).bricks()), vertices_(values.grid.vertices),
          cells_(values.grid.cells()), stored_(values.step<T>(step)), cut_(cut), tiles_(tiles),
          buffer_(out) {
        for (std::uint32_t i = 0; i < id_.size(); ++i)
            id_[i] = i / kTileCells[0] * cells_[0] + i % kTileCells[0];
    }

    void test(std::uint32_t brick) {
        const std::uint8_t* tile = tiles_ + std::size_t{brick} * kTile;
        const Place at(brick, bricks_);
        const Ranking ranking = ranking_of(tile);
        using F = Rankable<T>;
        const std::uint8_t rank = rank_of(static_cast<F>(cut_), static_cast<F>(ranking.low),
                                          static_cast<F>(ranking.scale));
        std::array<std::uint64_t, kPlanes> below;
        for (std::size_t z = 0; z < kPlanes; ++z) {
            std::uint64_t same = 0;
            compare(tile + z * kPlaneRanks, rank, below[z], same);
            for (; same; same &= same - 1) {
                const auto i = static_cast<std::size_t>(hwy::Num0BitsBelowLS1Bit_Nonzero64(same));
                below[z] |= std::uint64_t{value_at(at, i, z) < cut_} << i;
            }
        }
        if (HWY_UNLIKELY(tile[kMissing] != 0))
            write<true>(at, below, missing_in(tile));
        else
            write<false>(at, below, {});
    }

    /// Fetches a tile that will be tested soon.
    void expect(std::uint32_t brick) const {
        for (std::size_t line = 0; line < kTile; line += 64)
            hwy::Prefetch(tiles_ + std::size_t{brick} * kTile + line);
    }

    /// Number of cells of the bricks so far.
    std::uint64_t tested() const { return tested_; }

  private:
    static constexpr std::uint64_t kRanks = (std::uint64_t{1} << kPlaneRanks) - 1;

    /// The vertices of a plane below the cut's rank, and of the same rank.
    static HWY_INLINE void compare(const std::uint8_t* plane, std::uint8_t rank,
                                   std::uint64_t& below, std::uint64_t& same) {
        constexpr std::size_t kBits = 64; // whole vectors, beyond the plane
        static_assert((kPlanes - 1) * kPlaneRanks + kBits <= kTile);
        const hn::CappedTag<std::uint8_t, kBits> d;
        const auto of_cut = hn::Set(d, rank);
        below = same = 0;
        for (std::size_t i = 0; i < kBits; i += hn::Lanes(d)) {
            const auto ranks = hn::LoadU(d, plane + i);
            below |= bits_of(d, hn::Lt(ranks, of_cut)) << i;
            same |= bits_of(d, hn::Eq(ranks, of_cut)) << i;
        }
        same &= kRanks;
    }

    /// The vertices without a value.
    static std::array<std::uint64_t, kPlanes> missing_in(const std::uint8_t* tile) {
        std::array<std::uint64_t, kPlanes> missing;
        for (std::size_t z = 0; z < kPlanes; ++z) {
            std::uint64_t below = 0;
            compare(tile + z * kPlaneRanks, kNoRank, below, missing[z]);
        }
        return missing;
    }

    /// A vertex of a brick: its i-th in plane z. Beyond the border the last one repeats.
    T value_at(const Place& at, std::size_t i, std::size_t z) const {
        const std::size_t x = std::min<std::size_t>(at.x + i % kAcross, vertices_[0] - 1);
        const std::size_t y = std::min<std::size_t>(at.y + i / kAcross, vertices_[1] - 1);
        const std::size_t plane = std::min<std::size_t>(at.z + z, vertices_[2] - 1);
        return stored_[(plane * vertices_[1] + y) * vertices_[0] + x];
    }

    /// ORs the bits of the four vertices of each cell in a plane.
    static std::uint64_t any_of_four(std::uint64_t bits) {
        bits |= bits >> 1;
        return bits | bits >> kAcross;
    }

    template <bool kMissing>
    HWY_INLINE void write(const Place& at, const std::array<std::uint64_t, kPlanes>& below,
                          const std::array<std::uint64_t, kPlanes>& missing) {
        const std::uint32_t width = std::min(cells_[0] - at.x, kTileCells[0]);
        const std::uint32_t height = std::min(cells_[1] - at.y, kTileCells[1]);
        const std::uint32_t depth = std::min(cells_[2] - at.z, kTileCells[2]);
        tested_ += width * height * depth;
        const std::uint64_t in_row = (1u << width) - 1;
        std::uint64_t allowed = 0; // bits of cells in the plane
        for (std::uint32_t y = 0; y < height; ++y)
            allowed |= in_row << y * kAcross;
        const std::size_t plane_cells = std::size_t{cells_[0]} * cells_[1];
        const std::size_t first = at.z * plane_cells + std::size_t{at.y} * cells_[0] + at.x;
        const hn::CappedTag<CellId, 16> d;
        CellId* out = buffer_.room();
        for (std::uint32_t z = 0; z < depth; ++z) {
            std::uint64_t active = any_of_four(below[z] | below[z + 1]) &
                                   any_of_four(~below[z] | ~below[z + 1]) & allowed;
            if constexpr (kMissing)
                active &= ~any_of_four(missing[z] | missing[z + 1]);
            const auto from = hn::Set(d, static_cast<CellId>(first + z * plane_cells));
            for (std::size_t pair = 0; pair < kTileCells[1] / 2; ++pair, active >>= 2 * kAcross) {
                const auto bits =
                    static_cast<std::uint16_t>((active & 0xff) | (active >> kAcross & 0xff) << 8);
                out = write_cells(out, bits, [&](std::size_t i) HWY_ATTR {
                    return hn::Add(from, hn::LoadU(d, id_.data() + pair * 16 + i));
                });
            }
        }
        buffer_.written(out);
    }

    std::array<std::uint32_t, 3> bricks_, vertices_, cells_;
    std::span<const T> stored_;
    T cut_;
    const std::uint8_t* tiles_;
    std::array<CellId, kTileCells[0] * kTileCells[1]> id_; ///< of the cells in a plane of a brick
    CellBuffer buffer_;
    std::uint64_t tested_ = 0;
};

std::uint64_t search_tiles(const StepValues& values, std::span<const std::uint8_t> bricks,
                           const std::uint8_t* tiles, const LevelMap::Cut& level, std::uint64_t cut,
                           std::size_t step, std::vector<CellId>& out) {
    const Candidates candidates(bricks, level);
    return visit_value_type(values.type, [&]<class T>(std::type_identity<T>) {
        TileSearch<T> search(values, step, from_ordinal<T>(static_cast<Ordinal<T>>(cut)), tiles,
                             out);
        // Some bricks wait until their tiles have come from memory.
        constexpr std::size_t kWaiting = 6;
        std::array<std::uint32_t, kWaiting> waiting{};
        std::size_t found = 0;
        for (std::size_t first = 0; first < candidates.bricks(); first += kWordBits)
            for (std::uint64_t word = candidates.word(first); word; word &= word - 1) {
                const auto brick =
                    static_cast<std::uint32_t>(first + hwy::Num0BitsBelowLS1Bit_Nonzero64(word));
                search.expect(brick);
                if (found >= kWaiting)
                    search.test(waiting[found % kWaiting]);
                waiting[found++ % kWaiting] = brick;
            }
        for (std::size_t i = found - std::min(found, kWaiting); i < found; ++i)
            search.test(waiting[i % kWaiting]);
        return search.tested();
    });
}

} // namespace
} // namespace isochron::index::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace isochron::index {

HWY_EXPORT(fill_layer);
HWY_EXPORT(search_tiles);

namespace {
constexpr std::size_t kBytesOfTile = 256;
} // namespace

std::size_t tile_bytes(const Grid& grid) {
    return BrickGrid(grid).count() * kBytesOfTile;
}

bool build_tiles(const StepValues& values, std::size_t step, std::span<std::uint8_t> out,
                 unsigned threads, const std::stop_token& stop) {
    assert(out.size() == tile_bytes(values.grid));
    parallel_for(BrickGrid(values.grid).bricks()[2], threads,
                 [&](std::size_t layer, unsigned) {
                     if (stop.stop_requested())
                         return;
                     HWY_DYNAMIC_DISPATCH(fill_layer)
                     (values, step, static_cast<std::uint32_t>(layer), out.data());
                 },
                 {});
    return !stop.stop_requested();
}

std::uint64_t test_tiles(const StepValues& values, const LevelMap& levels,
                         std::span<const std::uint8_t> bricks, std::span<const std::uint8_t> tiles,
                         const Query& query, std::vector<CellId>& out) {
    assert(query.step < values.steps && levels.type() == values.type);
    assert(tiles.size() == tile_bytes(values.grid));
    const auto level = levels.cut(values.scaling, query.isovalue);
    const auto cut = stored_cut(values.type, values.scaling, query.isovalue);
    if (!level || !cut)
        return 0;
    return HWY_DYNAMIC_DISPATCH(search_tiles)(values, bricks, tiles.data(), *level, *cut,
                                              query.step, out);
}

} // namespace isochron::index
#endif
