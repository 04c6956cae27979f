// Finds the vertices at or above a cut, and writes cells, by bits, 64 in a word; compiled once for
// each SIMD target.
#include "index/system/compress_inl.h"
#include "index/volume/grid.h"

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

// Highway's guard: the file is read again for every target.
#if defined(ISOCHRON_INDEX_VERTEX_BITS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ISOCHRON_INDEX_VERTEX_BITS_INL_H
#undef ISOCHRON_INDEX_VERTEX_BITS_INL_H
#else
#define ISOCHRON_INDEX_VERTEX_BITS_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace isochron::index::HWY_NAMESPACE {

static_assert(std::endian::native == std::endian::little);

constexpr std::size_t kWordBits = 64;

/// Sides of up to 64 neighboring vertices, and whether one of them is NaN.
struct VertexBits {
    std::uint64_t upper; ///< a bit for each vertex; undefined for a NaN
    bool nan;            ///< may also be true because of a NaN after the given vertices
};

/// Compares stored values of one step with a cut. Reads whole vectors of at most kLanes values, but
/// never beyond the step's end.
template <class T, std::size_t kLanes = kWordBits>
class VertexComparer {
  public:
    /// @param end of the step's values @param cut `upper` means not below `cut`
    VertexComparer(const T* end, T cut) : end_(end), cut_(hn::Set(D{}, cut)) {}

    /// The bits of `count` vertices (1 to 64); bits after them have no meaning.
    HWY_INLINE VertexBits compare(const T* s, std::size_t count) const {
        if (HWY_LIKELY(readable(s, count)))
            return compare_whole(s, count);
        return compare_whole(copy(s, count).data(), count);
    }

    /// A bit for each of these vertices that is NaN; bits after them have no meaning.
    std::uint64_t nan(const T* s, std::size_t count) const {
        if (readable(s, count))
            return nan_whole(s, count);
        return nan_whole(copy(s, count).data(), count);
    }

  private:
    using D = hn::CappedTag<T, kLanes>;
    using Padded = std::array<T, kWordBits>;

    bool readable(const T* s, std::size_t count) const {
        const std::size_t lanes = hn::Lanes(D{});
        return static_cast<std::size_t>(end_ - s) >= (count + lanes - 1) / lanes * lanes;
    }

    static Padded copy(const T* s, std::size_t count) {
        Padded padded{};
        std::copy_n(s, count, padded.begin());
        return padded;
    }

    HWY_INLINE VertexBits compare_whole(const T* s, std::size_t count) const {
        const D d;
        std::uint64_t lower = 0;
        auto nan = hn::FirstN(d, 0);
        for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
            const auto values = hn::LoadU(d, s + i);
            lower |= bits_of(d, hn::Lt(values, cut_)) << i;
            if constexpr (std::is_floating_point_v<T>)
                nan = hn::Or(nan, hn::IsNaN(values));
        }
        return {~lower, std::is_floating_point_v<T> && !hn::AllFalse(d, nan)};
    }

    static std::uint64_t nan_whole(const T* s, std::size_t count) {
        std::uint64_t bits = 0;
        if constexpr (std::is_floating_point_v<T>) {
            const D d;
            for (std::size_t i = 0; i < count; i += hn::Lanes(d))
                bits |= bits_of(d, hn::IsNaN(hn::LoadU(d, s + i))) << i;
        }
        return bits;
    }

    const T* end_;
    hn::Vec<D> cut_;
};

/// Writes the cells, out of 16, whose bits are set, from `at` on, where there must be room for 32.
/// @param cells gives the vector of cells from the i-th on
/// @return the end of the written cells
template <class Cells>
HWY_INLINE CellId* write_cells(CellId* at, std::uint16_t bits, Cells&& cells) {
    const hn::CappedTag<CellId, 16> d;
    for (std::size_t i = 0; i < 16; i += hn::Lanes(d)) {
        const std::uint64_t part = bits >> i & ((1u << hn::Lanes(d)) - 1);
        hn::StoreU(compress(d, cells(i), part), d, at);
        at += hwy::PopCount(part);
    }
    return at;
}

/// Appends cells in bulk, since `push_back` costs more than finding a cell. Between `room` and
/// `written` the caller keeps the end in a register.
class CellBuffer {
  public:
    explicit CellBuffer(std::vector<CellId>& out) : out_(out) {}
    CellBuffer(const CellBuffer&) = delete;
    CellBuffer& operator=(const CellBuffer&) = delete;
    ~CellBuffer() { flush(); }

    static constexpr std::size_t kRoom = 1024;

    /// Memory for the next cells, at most kRoom.
    HWY_INLINE CellId* room() {
        if (size_ > kRoom)
            flush();
        return buffer_.data() + size_;
    }
    HWY_INLINE void written(const CellId* end) {
        size_ = static_cast<std::size_t>(end - buffer_.data());
    }

  private:
    void flush() {
        out_.insert(out_.end(), buffer_.data(), buffer_.data() + size_);
        size_ = 0;
    }

    std::vector<CellId>& out_;
    std::size_t size_ = 0;
    std::array<CellId, 2 * kRoom + 32> buffer_;
};

} // namespace isochron::index::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
