// Searches bricks by their tiles: five words of bits for a brick's vertices, two for its cells.
#include "index/scan/brick_tiles.h"
#include "index/scan/bricks.h"
#include "index/volume/ordinal.h"
#include "index/volume/stored_cut.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "index/scan/tile_search.cpp"
#include <hwy/foreach_target.h> // must come before highway.h

#include <hwy/cache_control.h>

#include "index/scan/brick_candidates_inl.h"
#include "index/scan/tile_ranks_inl.h"
#include "index/scan/vertex_bits_inl.h"

HWY_BEFORE_NAMESPACE();
namespace isochron::index::HWY_NAMESPACE {
namespace {

constexpr std::size_t kBatch = 64; ///< bricks that are tested together
constexpr std::size_t kWords = kTileCells[0] * kTileCells[1] * kTileCells[2] / kWordBits;
constexpr std::size_t kPairs = kTileCells[1] * kTileCells[2] / 2; ///< two rows make 16 bits

static_assert(kTileCells[0] == 8 && kTileCells[1] == 4 && kWords == 2);

/// Some bricks as bits.
struct TileBatch {
    /// In every row, brick after brick.
    template <std::size_t kRows>
    using Bits = std::array<std::array<std::uint64_t, kBatch>, kRows>;

    Bits<kPlanes> below{};         ///< vertices below the cut, 9 bits for a row
    Bits<kTileCells[2]> allowed{}; ///< cells of the grid without NaN, 9 bits for a row
    /// Cells, 8 bits for a row; all of a brick, then those of the next.
    std::array<std::uint64_t, kWords * kBatch> active;
    std::array<CellId, kBatch> first{}; ///< cell
    std::size_t size = 0;
};

/// ORs the bits of the four vertices of each cell in a plane.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V any_of_four(D, V bits) {
    const V pairs = hn::Or(bits, hn::ShiftRight<1>(bits));
    return hn::Or(pairs, hn::ShiftRight<kAcross>(pairs));
}

/// Finds the active cells of all bricks of a batch, as the scan does: some, but not all, of a
/// cell's eight vertices are below the cut.
void find_active(TileBatch& batch) {
    const hn::CappedTag<std::uint64_t, kBatch> d;
    for (std::size_t i = 0; i < batch.size; i += hn::Lanes(d)) {
        const auto cells_of = [&](std::size_t z) HWY_ATTR {
            const auto near = hn::Load(d, batch.below[z].data() + i);
            const auto far = hn::Load(d, batch.below[z + 1].data() + i);
            const auto active = hn::And(hn::And(any_of_four(d, hn::Or(near, far)),
                                                any_of_four(d, hn::Not(hn::And(near, far)))),
                                        hn::Load(d, batch.allowed[z].data() + i));
            // Rows of eight bits: the ninth belongs to no cell.
            const auto row = [&](std::uint64_t y)
                                 HWY_ATTR { return hn::Set(d, std::uint64_t{0xff} << y * 8); };
            const auto even =
                hn::Or(hn::And(active, row(0)), hn::And(hn::ShiftRight<1>(active), row(1)));
            const auto odd = hn::Or(hn::And(hn::ShiftRight<2>(active), row(2)),
                                    hn::And(hn::ShiftRight<3>(active), row(3)));
            return hn::Or(even, odd);
        };
        const auto words = [&](std::size_t z) HWY_ATTR {
            return hn::Or(cells_of(z), hn::ShiftLeft<32>(cells_of(z + 1)));
        };
        hn::StoreInterleaved2(words(0), words(2), d, batch.active.data() + kWords * i);
    }
}

template <class T>
class TileSearch {
  public:
    TileSearch(const StepValues& values, std::size_t step, T cut, const std::uint8_t* tiles,
               std::vector<CellId>& out)
        : bricks_(BrickGrid(values.grid).bricks()), vertices_(values.grid.vertices),
          cells_(values.grid.cells()), stored_(values.step<T>(step)), cut_(cut), tiles_(tiles),
          buffer_(out) {
        for (std::uint32_t i = 0; i < id_.size(); ++i) {
            const std::uint32_t row = i / kTileCells[0];
            id_[i] = (row / kTileCells[1] * cells_[1] + row % kTileCells[1]) * cells_[0] +
                     i % kTileCells[0];
        }
    }

    void test(std::uint32_t brick) {
        add(brick);
        if (batch_.size == kBatch)
            finish();
    }

    /// Fetches a tile that will be tested soon. @return its brick
    std::uint32_t expect(std::uint32_t brick) const {
        for (std::size_t line = 0; line < kTileBytes; line += 64)
            hwy::Prefetch(tiles_ + std::size_t{brick} * kTileBytes + line);
        return brick;
    }

    /// Number of cells of the bricks so far.
    std::uint64_t tested() const { return tested_; }

    /// Tests the bricks that have been added.
    void finish() {
        for (const Undecided& it : undecided_)
            batch_.below[it.plane][it.slot] |= std::uint64_t{*it.value < cut_} << it.vertex;
        undecided_.clear();
        if (batch_.size % 2 == 1) // two bricks are written at a time
            for (auto& allowed : batch_.allowed)
                allowed[batch_.size] = 0;
        find_active(batch_);
        write();
        batch_.size = 0;
    }

  private:
    static constexpr std::uint64_t kRanks = (std::uint64_t{1} << kPlaneRanks) - 1;
    /// A vertex whose rank is the cut's: its value decides, which has to come from memory.
    struct Undecided {
        const T* value;
        std::uint8_t slot, plane, vertex;
    };

    void add(std::uint32_t brick) {
        const std::uint8_t* tile = tiles_ + std::size_t{brick} * kTileBytes;
        const Place at(brick, bricks_);
        const Ranking ranking = ranking_of(tile);
        using F = Rankable<T>;
        const std::uint8_t rank = rank_of(static_cast<F>(cut_), static_cast<F>(ranking.low),
                                          static_cast<F>(ranking.scale));
        const std::size_t slot = batch_.size++;
        std::array<std::uint64_t, kPlanes> same;
        std::uint64_t any = 0;
        for (std::size_t z = 0; z < kPlanes; ++z) {
            compare(tile + z * kPlaneRanks, rank, batch_.below[z][slot], same[z]);
            any |= same[z] & kRanks;
        }
        allow(at, slot);
        if (any)
            look_up(at, slot, same);
        if (HWY_UNLIKELY(tile[kMissing] != 0))
            forbid_missing(tile, slot);
    }

    /// The vertices of a plane below the cut's rank, and of the same rank; bits beyond the plane
    /// have no meaning.
    static HWY_INLINE void compare(const std::uint8_t* plane, std::uint8_t rank,
                                   std::uint64_t& below, std::uint64_t& same) {
        constexpr std::size_t kBits = 64; // whole vectors, beyond the plane
        static_assert((kPlanes - 1) * kPlaneRanks + kBits <= kTileBytes);
        const hn::CappedTag<std::uint8_t, kBits> d;
        const auto of_cut = hn::Set(d, rank);
        if constexpr (hn::MaxLanes(d) == kBits) { // as one mask, stored without a detour
            const auto ranks = hn::LoadU(d, plane);
            hn::StoreMaskBits(d, hn::Lt(ranks, of_cut), reinterpret_cast<std::uint8_t*>(&below));
            hn::StoreMaskBits(d, hn::Eq(ranks, of_cut), reinterpret_cast<std::uint8_t*>(&same));
            return;
        }
        below = same = 0;
        for (std::size_t i = 0; i < kBits; i += hn::Lanes(d)) {
            const auto ranks = hn::LoadU(d, plane + i);
            below |= bits_of(d, hn::Lt(ranks, of_cut)) << i;
            same |= bits_of(d, hn::Eq(ranks, of_cut)) << i;
        }
    }

    /// Notes the vertices of the cut's rank, and fetches their values.
    void look_up(const Place& at, std::size_t slot, std::array<std::uint64_t, kPlanes>& same) {
        for (std::size_t z = 0; z < kPlanes; ++z)
            for (std::uint64_t bits = same[z] & kRanks; bits; bits &= bits - 1) {
                const auto i = static_cast<std::size_t>(hwy::Num0BitsBelowLS1Bit_Nonzero64(bits));
                const T* const value = &stored_[vertex_at(at, i, z)];
                hwy::Prefetch(value);
                undecided_.push_back({value, static_cast<std::uint8_t>(slot),
                                      static_cast<std::uint8_t>(z), static_cast<std::uint8_t>(i)});
            }
    }

    /// A vertex of a brick: its i-th in plane z. Beyond the border the last one repeats.
    std::size_t vertex_at(const Place& at, std::size_t i, std::size_t z) const {
        const std::size_t x = std::min<std::size_t>(at.x + i % kAcross, vertices_[0] - 1);
        const std::size_t y = std::min<std::size_t>(at.y + i / kAcross, vertices_[1] - 1);
        const std::size_t plane = std::min<std::size_t>(at.z + z, vertices_[2] - 1);
        return (plane * vertices_[1] + y) * vertices_[0] + x;
    }

    /// Allows the cells that the grid has.
    void allow(const Place& at, std::size_t slot) {
        const std::uint32_t width = std::min(cells_[0] - at.x, kTileCells[0]);
        const std::uint32_t height = std::min(cells_[1] - at.y, kTileCells[1]);
        const std::uint32_t depth = std::min(cells_[2] - at.z, kTileCells[2]);
        tested_ += width * height * depth;
        // The last row of a plane ends below bit 36; bits above it belong to no cell.
        constexpr std::uint64_t kFirstOfRows =
            1 | 1 << kAcross | 1 << 2 * kAcross | 1 << 3 * kAcross;
        const std::uint64_t rows = kFirstOfRows & ((std::uint64_t{1} << height * kAcross) - 1);
        const std::uint64_t plane = rows * ((1u << width) - 1);
        for (std::uint32_t z = 0; z < kTileCells[2]; ++z)
            batch_.allowed[z][slot] = z < depth ? plane : 0;
        batch_.first[slot] =
            static_cast<CellId>((std::size_t{at.z} * cells_[1] + at.y) * cells_[0] + at.x);
    }

    /// Takes the cells with a NaN vertex out of a brick's allowed ones.
    void forbid_missing(const std::uint8_t* tile, std::size_t slot) {
        std::array<std::uint64_t, kPlanes> missing;
        for (std::size_t z = 0; z < kPlanes; ++z) {
            std::uint64_t below = 0;
            compare(tile + z * kPlaneRanks, kNoRank, below, missing[z]);
        }
        for (std::size_t z = 0; z < kTileCells[2]; ++z) {
            std::uint64_t bits = (missing[z] | missing[z + 1]) & kRanks;
            bits |= bits >> 1;
            batch_.allowed[z][slot] &= ~(bits | bits >> kAcross);
        }
    }

    /// Pairs of rows with active cells: their bits, and in the upper half the number of the pair.
    std::size_t find_pairs(std::array<std::uint32_t, kBatch * kPairs + 16>& pairs) const {
        const hn::CappedTag<std::uint32_t, 16> d;
        const hn::Rebind<std::uint16_t, decltype(d)> half;
        const auto* const bits = reinterpret_cast<const std::uint16_t*>(batch_.active.data());
        std::size_t count = 0;
        for (std::size_t i = 0; i < batch_.size * kPairs; i += hn::Lanes(d)) {
            const auto pair = hn::PromoteTo(d, hn::LoadU(half, bits + i));
            const auto number = hn::ShiftLeft<16>(hn::Iota(d, static_cast<std::uint32_t>(i)));
            const auto some = hn::Ne(pair, hn::Zero(d));
            hn::StoreU(compress(d, hn::Or(pair, number), some), d, pairs.data() + count);
            count += hn::CountTrue(d, some);
        }
        return count;
    }

    void write() {
        std::array<std::uint32_t, kBatch * kPairs + 16> pairs;
        const std::size_t count = find_pairs(pairs);
        const hn::CappedTag<CellId, 16> d;
        for (std::size_t i = 0; i < count;) {
            CellId* out = buffer_.room();
            for (const std::size_t end = std::min(count, i + CellBuffer::kRoom / 16); i < end;
                 ++i) {
                const std::uint32_t pair = pairs[i] >> 16;
                const CellId* const ids = id_.data() + pair % kPairs * 16;
                const auto first = hn::Set(d, batch_.first[pair / kPairs]);
                out = write_cells(out, static_cast<std::uint16_t>(pairs[i]),
                                  [&](std::size_t at)
                                      HWY_ATTR { return hn::Add(first, hn::LoadU(d, ids + at)); });
            }
            buffer_.written(out);
        }
    }

    std::array<std::uint32_t, 3> bricks_, vertices_, cells_;
    std::span<const T> stored_;
    T cut_;
    const std::uint8_t* tiles_;
    std::array<CellId, kPairs * 16> id_; ///< of a brick's cells, relative to its first
    CellBuffer buffer_;
    alignas(64) TileBatch batch_;
    std::vector<Undecided> undecided_;
    std::uint64_t tested_ = 0;
};

std::uint64_t search_tiles(const StepValues& values, std::span<const std::uint8_t> bricks,
                           const std::uint8_t* tiles, const LevelMap::Cut& level, std::uint64_t cut,
                           std::size_t step, std::vector<CellId>& out) {
    const Candidates candidates(bricks, level);
    return visit_value_type(values.type, [&]<class T>(std::type_identity<T>) {
        TileSearch<T> search(values, step, from_ordinal<T>(static_cast<Ordinal<T>>(cut)), tiles,
                             out);
        candidates.for_each_ahead<16>([&](std::uint32_t brick)
                                          HWY_ATTR { return search.expect(brick); },
                                      [&](std::uint32_t brick) HWY_ATTR { search.test(brick); });
        search.finish();
        return search.tested();
    });
}

} // namespace
} // namespace isochron::index::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace isochron::index {

HWY_EXPORT(search_tiles);

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
