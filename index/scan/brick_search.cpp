// Search with bricks: candidates by their extremes, then the exact test of all their cells at once.
#include "index/scan/bricks.h"
#include "index/scan/scan.h"
#include "index/system/huge_pages.h"
#include "index/volume/ordinal.h"
#include "index/volume/stored_cut.h"

#include <algorithm>
#include <cassert>
#include <optional>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "index/scan/brick_search.cpp"
#include <hwy/foreach_target.h> // must come before highway.h

#include <hwy/cache_control.h>

#include "index/scan/brick_candidates_inl.h"
#include "index/scan/vertex_bits_inl.h"

HWY_BEFORE_NAMESPACE();
namespace isochron::index::HWY_NAMESPACE {
namespace {

/// Percentage of candidates above which a scan is faster: a scan reads every vertex once, while
/// bricks read vertices on their borders twice. That costs less for types whose comparison takes
/// most time.
std::size_t scan_percent(ValueType type) {
    return size_of(type) == 1 ? 25 : 40;
}

/// Active cells of a candidate, of 256 cells: as many as most surfaces have, or more.
constexpr std::size_t kUsuallyActive = 64;

constexpr auto kCells = BrickGrid::kCells;
constexpr std::size_t kRows = kCells[1] * kCells[2]; ///< rows of cells in a brick
/// Rows of vertices in a brick.
constexpr std::size_t kVertexRows = (kCells[1] + 1) * (kCells[2] + 1);
constexpr std::size_t kPairs = kRows / 2; ///< two rows of eight cells make 16 bits
constexpr std::size_t kBatch = 32;        ///< bricks that are tested together

static_assert(kCells[0] == 8 && kCells[1] % 2 == 0);

using Pairs = std::array<std::uint16_t, kPairs>;

/// The vertices of some bricks as bits (set if below the cut), and then their cells; in every row,
/// brick after brick.
struct Batch {
    std::array<std::array<std::uint16_t, kBatch>, kVertexRows> vertices{};
    std::array<std::array<std::uint16_t, kBatch>, kPairs> active;
    std::array<CellId, kBatch> first;  ///< cells
    std::array<Pairs, kBatch> allowed; ///< cells of the grid without NaN
    std::size_t size = 0;
};

/// Finds the active cells of all bricks of a batch, as the scan does: some, but not all, of a
/// cell's eight vertices are below the cut.
void find_active(Batch& batch) {
    const hn::CappedTag<std::uint16_t, kBatch> d;
    constexpr std::size_t kAcross = kCells[1] + 1;
    const auto cells = hn::Set(d, 0xff);
    for (std::size_t i = 0; i < batch.size; i += hn::Lanes(d))
        for (std::size_t z = 0; z < kCells[2]; ++z) {
            const auto row = [&](std::size_t y) HWY_ATTR {
                const auto near = hn::LoadU(d, batch.vertices[z * kAcross + y].data() + i);
                const auto far = hn::LoadU(d, batch.vertices[(z + 1) * kAcross + y].data() + i);
                return std::pair(hn::Or(near, far), hn::And(near, far));
            };
            auto [any_below, all_below] = row(0);
            auto even = hn::Zero(d);
            for (std::size_t y = 0; y < kCells[1]; ++y) {
                const auto [any_above, all_above] = row(y + 1);
                const auto any = hn::Or(any_below, any_above), all = hn::And(all_below, all_above);
                const auto active = hn::And(hn::AndNot(hn::And(all, hn::ShiftRight<1>(all)),
                                                       hn::Or(any, hn::ShiftRight<1>(any))),
                                            cells);
                if (y % 2 == 0)
                    even = active;
                else
                    hn::StoreU(hn::Or(even, hn::ShiftLeft<8>(active)), d,
                               batch.active[(z * kCells[1] + y) / 2].data() + i);
                any_below = any_above;
                all_below = all_above;
            }
        }
}

/// What all bricks at the same borders of the grid have in common.
struct BrickShape {
    std::array<std::uint32_t, 3> size;         ///< cells; fewer than usual at an upper border
    std::array<std::size_t, kVertexRows> rows; ///< from the first vertex; the border's row repeats
    Pairs cells{};                             ///< bits of cells inside the grid
};

/// A row of eight cells in its place in a pair of rows.
std::uint16_t row_of_pair(std::uint64_t cells, std::uint32_t y) {
    return static_cast<std::uint16_t>((cells & 0xff) << y % 2 * 8);
}

BrickShape shape_of(const Grid& grid, const std::array<std::uint32_t, 3>& size) {
    const std::size_t row = grid.vertices[0], plane = row * grid.vertices[1];
    BrickShape shape{.size = size, .rows = {}};
    for (std::uint32_t z = 0, i = 0; z <= kCells[2]; ++z)
        for (std::uint32_t y = 0; y <= kCells[1]; ++y, ++i)
            shape.rows[i] = std::min(z, size[2]) * plane + std::min(y, size[1]) * row;
    for (std::uint32_t z = 0; z < size[2]; ++z)
        for (std::uint32_t y = 0; y < size[1]; ++y)
            shape.cells[(z * kCells[1] + y) / 2] |= row_of_pair((1u << size[0]) - 1, y);
    return shape;
}

template <class T>
class BrickSearch {
  public:
    BrickSearch(const StepValues& values, std::size_t step, T cut, std::vector<CellId>& out)
        : bricks_(BrickGrid(values.grid).bricks()), vertices_(values.grid.vertices),
          cells_(values.grid.cells()), stored_(values.step<T>(step)), cut_(hn::Set(D(), cut)),
          out_(out) {
        for (std::uint32_t i = 0; i < id_.size(); ++i)
            id_[i] = ((i / 32) * cells_[1] + i / 8 % 4) * cells_[0] + i % 8;
        for (std::uint32_t borders = 0; borders < shapes_.size(); ++borders) {
            auto size = kCells;
            for (std::size_t axis = 0; axis < 3; ++axis)
                if (borders >> axis & 1)
                    size[axis] = cells_[axis] - (bricks_[axis] - 1) * kCells[axis];
            shapes_[borders] = shape_of(values.grid, size);
        }
    }

    /// A brick, and where it lies.
    struct At {
        std::array<std::uint32_t, 3> brick;
        const T* vertex; ///< its first
    };

    void test(const At& brick) {
        add(brick);
        if (batch_.size == kBatch)
            finish();
    }

    /// Fetches the vertices of a brick that will be tested soon.
    At expect(std::uint32_t brick) const {
        const At at = place_of(brick);
        for (const std::size_t row : shape_at(at).rows) {
            hwy::Prefetch(at.vertex + row);
            if constexpr (kCells[0] * sizeof(T) >= 32)
                hwy::Prefetch(at.vertex + row + kCells[0]);
        }
        return at;
    }

    /// Number of cells of the bricks so far.
    std::uint64_t tested() const { return tested_; }

    /// Tests the bricks that have been added.
    void finish() {
        find_active(batch_);
        for (std::size_t i = 0; i < batch_.size; ++i)
            write(i);
        batch_.size = 0;
    }

  private:
    using D = hn::CappedTag<T, 16>;
    static constexpr std::size_t kRowValues = 16; ///< values read from a row; a brick needs 9

    std::size_t plane() const { return std::size_t{vertices_[0]} * vertices_[1]; }

    At place_of(std::uint32_t brick) const {
        const std::uint32_t row = brick / bricks_[0];
        const std::array<std::uint32_t, 3> at{brick % bricks_[0], row % bricks_[1],
                                              row / bricks_[1]};
        return {at, stored_.data() + at[2] * kCells[2] * plane() +
                        std::size_t{at[1] * kCells[1]} * vertices_[0] + at[0] * kCells[0]};
    }

    const BrickShape& shape_at(const At& at) const {
        std::size_t borders = 0;
        for (std::size_t axis = 0; axis < 3; ++axis)
            borders |= (at.brick[axis] + 1 == bricks_[axis] ? 1u : 0u) << axis;
        return shapes_[borders];
    }

    void add(const At& at) {
        const std::size_t slot = batch_.size++;
        const T* const s = at.vertex;
        const BrickShape& shape = shape_at(at);
        batch_.first[slot] = static_cast<CellId>(
            (at.brick[2] * kCells[2] * cells_[1] + at.brick[1] * kCells[1]) * cells_[0] +
            at.brick[0] * kCells[0]);
        batch_.allowed[slot] = shape.cells;
        tested_ += shape.size[0] * shape.size[1] * shape.size[2];
        const auto left = static_cast<std::size_t>(stored_.data() + stored_.size() - s);
        const bool nan = HWY_LIKELY(left >= shape.rows.back() + kRowValues)
                             ? compare(s, shape.rows, slot)
                             : compare_last(s, shape, slot);
        if (HWY_UNLIKELY(nan))
            forbid_nan(s, shape.size, batch_.allowed[slot]);
    }

    /// Fills the batch's bits of a brick. @return whether a vertex may be NaN
    HWY_INLINE bool compare(const T* s, const std::array<std::size_t, kVertexRows>& rows,
                            std::size_t slot) {
        const D d;
        auto sum = hn::Zero(d);
        for (std::size_t row = 0; row < kVertexRows;) {
            auto plane_sum = hn::Zero(d); // one for each plane, so that they need not wait
            for (std::size_t y = 0; y <= kCells[1]; ++y, ++row) {
                std::uint64_t lower = 0;
                for (std::size_t i = 0; i <= kCells[0]; i += hn::Lanes(d)) {
                    const auto values = hn::LoadU(d, s + rows[row] + i);
                    lower |= bits_of(d, hn::Lt(values, cut_)) << i;
                    if constexpr (std::is_floating_point_v<T>)
                        plane_sum = hn::Add(plane_sum, values);
                }
                batch_.vertices[row][slot] = static_cast<std::uint16_t>(lower);
            }
            sum = hn::Add(sum, plane_sum);
        }
        // A NaN stays in a sum. Infinities may give a NaN where there is none, which is harmless.
        if constexpr (std::is_floating_point_v<T>)
            return !hn::AllFalse(d, hn::IsNaN(sum));
        return false;
    }

    /// Compares at the end of the step, where whole vectors would reach beyond it.
    bool compare_last(const T* s, const BrickShape& shape, std::size_t slot) {
        std::array<T, kVertexRows * kRowValues> copy{};
        std::array<std::size_t, kVertexRows> rows;
        for (std::size_t i = 0; i < kVertexRows; ++i) {
            rows[i] = i * kRowValues;
            std::copy_n(s + shape.rows[i], shape.size[0] + 1, copy.data() + rows[i]);
        }
        return compare(copy.data(), rows, slot);
    }

    /// Takes the cells with a NaN vertex out of a brick's allowed ones.
    void forbid_nan(const T* s, const std::array<std::uint32_t, 3>& size, Pairs& allowed) const {
        for (std::uint32_t z = 0; z <= size[2]; ++z)
            for (std::uint32_t y = 0; y <= size[1]; ++y)
                for (std::uint32_t x = 0; x <= size[0]; ++x) {
                    const T value = s[z * plane() + std::size_t{y} * vertices_[0] + x];
                    if (!is_nan(value))
                        continue;
                    // Up to eight cells around the vertex; bit x of 2 * cells is the cell at x.
                    const std::uint64_t cells = (std::uint64_t{3} << x) >> 1;
                    for (std::uint32_t cz = z - std::min(z, 1u); cz <= std::min(z, kCells[2] - 1);
                         ++cz)
                        for (std::uint32_t cy = y - std::min(y, 1u);
                             cy <= std::min(y, kCells[1] - 1); ++cy) {
                            std::uint16_t& pair = allowed[(cz * kCells[1] + cy) / 2];
                            pair = pair & ~row_of_pair(cells, cy);
                        }
                }
    }

    HWY_INLINE void write(std::size_t slot) {
        const hn::CappedTag<CellId, 16> d;
        const auto first = hn::Set(d, batch_.first[slot]);
        CellId* at = buffer_.room();
        for (std::size_t pair = 0; pair < kPairs; ++pair) {
            const std::uint16_t bits = batch_.active[pair][slot] & batch_.allowed[slot][pair];
            at = write_cells(at, bits, [&](std::size_t i) HWY_ATTR {
                return hn::Add(first, hn::LoadU(d, id_.data() + pair * 16 + i));
            });
        }
        buffer_.written(at);
    }

    std::array<std::uint32_t, 3> bricks_, vertices_, cells_;
    std::span<const T> stored_;
    hn::Vec<D> cut_;
    std::array<BrickShape, 8> shapes_; ///< by bits: at the upper border of x (1), y (2), z (4)
    std::array<CellId, kRows * kCells[0]> id_; ///< ids of a brick's cells, relative to its first
    std::vector<CellId>& out_;
    CellBuffer buffer_{out_};
    Batch batch_;
    std::uint64_t tested_ = 0;
};

/// @return number of cells that were tested; none, without finding anything, if `may_scan` and a
///         scan is faster
std::optional<std::uint64_t> search_step(const StepValues& values,
                                         std::span<const std::uint8_t> bricks,
                                         const LevelMap::Cut& level, std::uint64_t cut,
                                         std::size_t step, bool may_scan,
                                         std::vector<CellId>& out) {
    const Candidates candidates(bricks, level);
    if (may_scan && candidates.count() * 100 > candidates.bricks() * scan_percent(values.type))
        return std::nullopt;
    if (out.empty())
        make_room(out, candidates.count() * kUsuallyActive);
    return visit_value_type(values.type, [&]<class T>(std::type_identity<T>) {
        BrickSearch<T> search(values, step, from_ordinal<T>(static_cast<Ordinal<T>>(cut)), out);
        candidates.for_each_ahead<4>([&](std::uint32_t brick)
                                         HWY_ATTR { return search.expect(brick); },
                                     [&](const auto& brick) HWY_ATTR { search.test(brick); });
        search.finish();
        return search.tested();
    });
}

} // namespace
} // namespace isochron::index::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace isochron::index {

HWY_EXPORT(search_step);

namespace {

std::optional<std::uint64_t> search_in_bricks(const StepValues& values, const LevelMap& levels,
                                              std::span<const std::uint8_t> bricks,
                                              const Query& query, bool may_scan,
                                              std::vector<CellId>& out) {
    assert(query.instant.step < values.steps && levels.type() == values.type);
    assert(bricks.size() == BrickGrid(values.grid).bytes_per_step());
    const auto level = levels.cut(values.scaling, query.isovalue);
    const auto cut = stored_cut(values.type, values.scaling, query.isovalue);
    if (!level || !cut)
        return 0;
    return HWY_DYNAMIC_DISPATCH(search_step)(values, bricks, *level, *cut, query.instant.step,
                                             may_scan, out);
}

} // namespace

std::uint64_t search_bricks(const StepValues& values, const LevelMap& levels,
                            std::span<const std::uint8_t> bricks, const Query& query,
                            std::vector<CellId>& out) {
    if (const auto tested = search_in_bricks(values, levels, bricks, query, true, out))
        return *tested;
    const std::size_t before = out.size();
    scan(values, query, out);
    return out.size() - before;
}

std::uint64_t test_bricks(const StepValues& values, const LevelMap& levels,
                          std::span<const std::uint8_t> bricks, const Query& query,
                          std::vector<CellId>& out) {
    return search_in_bricks(values, levels, bricks, query, false, out).value_or(0);
}

} // namespace isochron::index
#endif
