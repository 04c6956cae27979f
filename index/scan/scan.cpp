// Full scan of one step, row by row on bit masks, and the exact test of single cells.
#include "index/scan/scan.h"

#include "index/volume/ordinal.h"
#include "index/volume/stored_cut.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <span>
#include <utility>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "index/scan/scan.cpp"
#include <hwy/foreach_target.h> // must come before highway.h

#include "index/scan/vertex_bits_inl.h"

HWY_BEFORE_NAMESPACE();
namespace isochron::index::HWY_NAMESPACE {
namespace {

/// Number of words that are searched for active cells at a time.
constexpr std::size_t kBlock = 8;
using ActiveWords = std::array<std::uint64_t, kBlock>;
using Words = hn::CappedTag<std::uint64_t, kBlock>;

/// Bits of one z plane of vertices, for the cells above or below it: whether any of a cell's four
/// vertices in the plane is upper, is lower (or NaN), is NaN. Rows of cells take whole words and
/// follow each other without gaps.
class PlaneBits {
  public:
    PlaneBits(std::size_t words, std::uint32_t rows)
        : words_(words), rows_(rows), upper_(size()), lower_(size()) {}

    /// Number of words of all rows, rounded up to a whole block.
    std::size_t size() const { return (words_ * (rows_ - 1) + kBlock - 1) / kBlock * kBlock; }
    const std::uint64_t* upper() const { return upper_.data(); }
    const std::uint64_t* lower() const { return lower_.data(); }
    const std::uint64_t* nan() const { return nan_.data(); }
    bool has_nan() const { return has_nan_; }

    /// @param scratch kept for its memory
    template <class T>
    void fill(const VertexComparer<T>& comparer, const T* plane, std::uint32_t row_length,
              std::vector<std::uint64_t>& scratch) {
        scratch.resize(size() + words_ + 1); // the row and the word after the last are read, too
        has_nan_ = false;
        for_each_word(plane, row_length, [&](std::size_t i, const T* s, std::size_t count) {
            const VertexBits bits = comparer.compare(s, count);
            scratch[i] = bits.upper;
            has_nan_ |= bits.nan;
        });
        any_of_four<0>(scratch, upper_);
        any_of_four<~std::uint64_t{0}>(scratch, lower_);
        if (!has_nan_)
            return;
        for_each_word(plane, row_length, [&](std::size_t i, const T* s, std::size_t count) {
            scratch[i] = comparer.nan(s, count);
        });
        nan_.resize(size());
        any_of_four<0>(scratch, nan_);
    }

  private:
    template <class T, class F>
    HWY_INLINE void for_each_word(const T* plane, std::uint32_t row_length, F&& f) const {
        std::size_t i = 0;
        for (std::uint32_t row = 0; row < rows_; ++row, plane += row_length)
            for (std::size_t x = 0; x < row_length; x += kWordBits)
                f(i++, plane + x, std::min<std::size_t>(kWordBits, row_length - x));
    }

    /// ORs the bits of the four vertices around each cell. A bit is a vertex; the vertex after a
    /// word's last bit is in the next word.
    template <std::uint64_t kFlip>
    HWY_INLINE void any_of_four(const std::vector<std::uint64_t>& vertices,
                                std::vector<std::uint64_t>& out) const {
        const Words d;
        const auto flip = hn::Set(d, kFlip);
        for (std::size_t i = 0; i < out.size(); i += hn::Lanes(d)) {
            const auto two = [&](const std::uint64_t* at) HWY_ATTR {
                return hn::Or(hn::Xor(hn::LoadU(d, at), flip),
                              hn::Xor(hn::LoadU(d, at + words_), flip));
            };
            const auto here = two(vertices.data() + i), next = two(vertices.data() + i + 1);
            hn::StoreU(hn::Or3(here, hn::ShiftRight<1>(here), hn::ShiftLeft<63>(next)), d,
                       out.data() + i);
        }
    }

    std::size_t words_;
    std::uint32_t rows_;
    std::vector<std::uint64_t> upper_, lower_, nan_;
    bool has_nan_ = false;
};

/// For every word of `PlaneBits`: what is the same in all layers of cells.
struct LayerWords {
    LayerWords(const PlaneBits& bits, std::size_t words, const std::array<std::uint32_t, 3>& cells)
        : first(bits.size()), valid(bits.size()) {
        for (std::size_t i = 0; i < words * cells[1]; ++i) {
            const std::size_t x = i % words * kWordBits;
            first[i] = static_cast<CellId>(i / words * cells[0] + x);
            // The last word of a row may hold only its last vertex, at which no cell begins.
            const std::size_t left = cells[0] - std::min<std::size_t>(cells[0], x);
            valid[i] = left < kWordBits ? (std::uint64_t{1} << left) - 1 : ~std::uint64_t{0};
        }
    }
    std::vector<CellId> first;        ///< cell of the word's lowest bit, in the first layer
    std::vector<std::uint64_t> valid; ///< bits that are cells
};

/// Writes the cells of a block of words. @param first of the lowest bit of every word
HWY_INLINE void write_active(const ActiveWords& active, const CellId* first, CellId layer_first,
                             CellBuffer& out) {
    constexpr std::size_t kQuarters = kBlock * 4;
    const hn::CappedTag<std::uint16_t, kQuarters> d;
    std::array<std::uint16_t, kQuarters> quarters;
    std::memcpy(quarters.data(), active.data(), sizeof active);
    std::uint64_t filled = 0;
    for (std::size_t i = 0; i < kQuarters; i += hn::Lanes(d))
        filled |= bits_of(d, hn::Ne(hn::LoadU(d, quarters.data() + i), hn::Zero(d))) << i;
    if (!filled)
        return;
    static_assert(kBlock * kWordBits <= CellBuffer::kRoom);
    CellId* at = out.room();
    for (; filled; filled &= filled - 1) {
        const std::size_t quarter = hwy::Num0BitsBelowLS1Bit_Nonzero64(filled);
        const auto cell = static_cast<CellId>(layer_first + first[quarter / 4] + quarter % 4 * 16);
        at = write_cells(at, quarters[quarter], [&](std::size_t i) HWY_ATTR {
            const hn::CappedTag<CellId, 16> ids; // Iota with a constant; with `cell` it is slow
            return hn::Add(hn::Set(ids, cell), hn::Iota(ids, static_cast<CellId>(i)));
        });
    }
    out.written(at);
}

/// Writes the active cells between two planes.
HWY_INLINE void write_layer(const PlaneBits& near, const PlaneBits& far, const LayerWords& layer,
                            CellId layer_first, CellBuffer& out) {
    const Words d;
    const auto either = [&](const std::uint64_t* a, const std::uint64_t* b)
                            HWY_ATTR { return hn::Or(hn::LoadU(d, a), hn::LoadU(d, b)); };
    ActiveWords active;
    for (std::size_t block = 0; block < near.size(); block += kBlock) {
        for (std::size_t i = block; i < block + kBlock; i += hn::Lanes(d)) {
            auto words = hn::And(hn::LoadU(d, layer.valid.data() + i),
                                 hn::And(either(near.upper() + i, far.upper() + i),
                                         either(near.lower() + i, far.lower() + i)));
            for (const PlaneBits* plane : {&near, &far})
                if (HWY_UNLIKELY(plane->has_nan()))
                    words = hn::AndNot(hn::LoadU(d, plane->nan() + i), words);
            hn::StoreU(words, d, active.data() + (i - block));
        }
        write_active(active, layer.first.data() + block, layer_first, out);
    }
}

template <class T>
void scan_values(const StepValues& values, std::size_t step, T cut, std::vector<CellId>& out) {
    const auto [nx, ny, nz] = values.grid.vertices;
    const auto cells = values.grid.cells();
    const std::span<const T> stored = values.step<T>(step);
    const VertexComparer<T> comparer(stored.data() + stored.size(), cut);
    const std::size_t words = (nx + kWordBits - 1) / kWordBits;
    std::vector<std::uint64_t> scratch;
    PlaneBits near(words, ny), far(words, ny);
    const LayerWords layer(near, words, cells);
    CellBuffer buffer(out);
    const T* plane = stored.data();
    near.fill(comparer, plane, nx, scratch);
    for (std::uint32_t z = 0; z < cells[2]; ++z) {
        plane += std::size_t{nx} * ny;
        far.fill(comparer, plane, nx, scratch);
        write_layer(near, far, layer, static_cast<CellId>(std::size_t{z} * cells[1] * cells[0]),
                    buffer);
        std::swap(near, far);
    }
}

/// Tests ids that are close together in a row of cells with one comparison of the rows around them.
template <class T>
void keep_active_values(const StepValues& values, std::size_t step, T cut,
                        std::vector<CellId>& ids) {
    const std::size_t nx = values.grid.vertices[0];
    const std::size_t plane = nx * values.grid.vertices[1];
    const std::uint64_t cells = values.grid.cell_count();
    const std::uint64_t width = values.grid.cells()[0];
    const std::span<const T> stored = values.step<T>(step);
    const VertexComparer<T> comparer(stored.data() + stored.size(), cut);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < ids.size();) {
        const std::uint64_t first = ids[i];
        if (first >= cells) {
            ++i;
            continue;
        }
        const auto [x, y, z] = values.grid.cell_of(ids[i]);
        // A word of vertices has one cell fewer than bits.
        const std::uint64_t near = std::min<std::uint64_t>(kWordBits - 1, width - x);
        std::size_t end = i + 1;
        std::uint64_t last = first;
        for (; end < ids.size() && ids[end] - first < near; ++end)
            last = std::max<std::uint64_t>(last, ids[end]);
        const T* s = stored.data() + z * plane + y * nx + x;
        const std::size_t vertices = last - first + 2;
        std::uint64_t upper = 0, lower = 0, nan = 0;
        for (const T* row : {s, s + nx, s + plane, s + plane + nx}) {
            const VertexBits bits = comparer.compare(row, vertices);
            upper |= bits.upper;
            lower |= ~bits.upper;
            if (HWY_UNLIKELY(bits.nan))
                nan |= comparer.nan(row, vertices);
        }
        const std::uint64_t active =
            (upper | upper >> 1) & (lower | lower >> 1) & ~(nan | nan >> 1);
        for (; i < end; ++i) {
            ids[kept] = ids[i]; // without a branch: which cells are kept cannot be predicted
            kept += active >> (ids[kept] - first) & 1;
        }
    }
    ids.resize(kept);
}

// Functions that are chosen at run time cannot be templates.
void scan_step(const StepValues& values, std::size_t step, std::uint64_t cut,
               std::vector<CellId>& out) {
    visit_value_type(values.type, [&]<class T>(std::type_identity<T>) {
        scan_values(values, step, from_ordinal<T>(static_cast<Ordinal<T>>(cut)), out);
    });
}
void keep_active_in_step(const StepValues& values, std::size_t step, std::uint64_t cut,
                         std::vector<CellId>& ids) {
    visit_value_type(values.type, [&]<class T>(std::type_identity<T>) {
        keep_active_values(values, step, from_ordinal<T>(static_cast<Ordinal<T>>(cut)), ids);
    });
}

} // namespace
} // namespace isochron::index::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace isochron::index {

HWY_EXPORT(scan_step);
HWY_EXPORT(keep_active_in_step);

void scan(const StepValues& values, const Query& query, std::vector<CellId>& out) {
    assert(query.instant.step < values.steps);
    if (const auto cut = stored_cut(values.type, values.scaling, query.isovalue))
        HWY_DYNAMIC_DISPATCH(scan_step)(values, query.instant.step, *cut, out);
}

void keep_active(const StepValues& values, const Query& query, std::vector<CellId>& ids) {
    assert(query.instant.step < values.steps);
    if (const auto cut = stored_cut(values.type, values.scaling, query.isovalue))
        HWY_DYNAMIC_DISPATCH(keep_active_in_step)(values, query.instant.step, *cut, ids);
    else
        ids.clear();
}

} // namespace isochron::index
#endif
