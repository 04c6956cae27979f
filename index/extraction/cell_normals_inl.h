// Normals of many cells at a time, from what is around them; compiled once for each SIMD target.
#include "index/volume/cell_difference.h"

#include <hwy/highway.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

// Highway's guard: the file is read again for every target.
#if defined(ISOCHRON_INDEX_CELL_NORMALS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ISOCHRON_INDEX_CELL_NORMALS_INL_H
#undef ISOCHRON_INDEX_CELL_NORMALS_INL_H
#else
#define ISOCHRON_INDEX_CELL_NORMALS_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace isochron::index::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kBatch = 64; ///< cells whose normals are found together

/// Makes packed normals (GL_INT_2_10_10_10_REV: x in the lowest bits, 511 is 1) of differences.
template <class Real>
class NormalMaker {
  public:
    using D = hn::CappedTag<Real, kBatch>;
    using V = hn::Vec<D>;

    /// @param normal_from_difference with entries of at most 1
    explicit NormalMaker(const glm::dmat3& normal_from_difference) {
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 3; ++column)
                matrix_[row][column] = static_cast<Real>(normal_from_difference[column][row]);
    }

    HWY_INLINE void write(V x, V y, V z, std::uint32_t* out) const {
        const D d;
        const hn::Rebind<std::int32_t, D> ints;
        const V largest = hn::Max(hn::Max(hn::Abs(x), hn::Abs(y)), hn::Abs(z));
        const V sum = hn::Add(hn::Add(hn::Abs(x), hn::Abs(y)), hn::Abs(z)); // keeps every NaN
        const auto usable = hn::And(
            hn::And(hn::Gt(largest, hn::Zero(d)), hn::Lt(largest, infinity())), hn::Eq(sum, sum));
        if constexpr (sizeof(Real) == 8) { // of any type: no square must overflow or vanish
            x = hn::Div(x, largest);
            y = hn::Div(y, largest);
            z = hn::Div(z, largest);
        }
        const V nx = row(0, x, y, z), ny = row(1, x, y, z), nz = row(2, x, y, z);
        const V squares = hn::MulAdd(nx, nx, hn::MulAdd(ny, ny, hn::Mul(nz, nz)));
        const V to_511 = hn::Div(hn::Set(d, Real{511}), hn::Sqrt(squares));
        const auto bits = [&](V component) HWY_ATTR {
            const V length = hn::IfThenElseZero(usable, hn::Mul(component, to_511));
            // Halves away from zero, as `lround` does it.
            const V half = hn::CopySign(hn::Set(d, Real{0.5}), length);
            return hn::And(truncated(hn::Add(length, half)), hn::Set(ints, 0x3ff));
        };
        const auto packed =
            hn::Or(bits(nx), hn::Or(hn::ShiftLeft<10>(bits(ny)), hn::ShiftLeft<20>(bits(nz))));
        hn::StoreU(hn::BitCast(hn::Rebind<std::uint32_t, D>(), packed),
                   hn::Rebind<std::uint32_t, D>(), out);
    }

  private:
    static V infinity() { return hn::Set(D(), std::numeric_limits<Real>::infinity()); }

    HWY_INLINE V row(std::size_t i, V x, V y, V z) const {
        const D d;
        return hn::MulAdd(
            hn::Set(d, matrix_[i][0]), x,
            hn::MulAdd(hn::Set(d, matrix_[i][1]), y, hn::Mul(hn::Set(d, matrix_[i][2]), z)));
    }

    static HWY_INLINE auto truncated(V v) {
        const hn::Rebind<std::int32_t, D> ints;
        if constexpr (sizeof(Real) == 4)
            return hn::ConvertTo(ints, v);
        else
            return hn::DemoteTo(ints, v);
    }

    std::array<std::array<Real, 3>, 3> matrix_;
};

/// Cells of which the differences are known, in double: of every type, at the border or not.
class DifferenceBatch {
  public:
    using Maker = NormalMaker<double>;

    void set(std::size_t slot, const glm::dvec3& difference) {
        for (int axis = 0; axis < 3; ++axis)
            differences_[axis][slot] = difference[axis];
    }
    HWY_INLINE void make(const Maker& maker, std::size_t slot, std::uint32_t* out) const {
        const Maker::D d;
        maker.write(hn::LoadU(d, differences_[0].data() + slot),
                    hn::LoadU(d, differences_[1].data() + slot),
                    hn::LoadU(d, differences_[2].data() + slot), out);
    }

  private:
    std::array<std::array<double, kBatch>, 3> differences_{};
};

/// Inner cells of 8- and 16-bit types: the values around them, as words of four bytes. All sums of
/// differences are exact in `float`.
template <class T>
class ValueBatch {
  public:
    using Maker = NormalMaker<float>;

    explicit ValueBatch(const Grid& grid)
        : row_(grid.vertices[0]), slice_(row_ * std::ptrdiff_t{grid.vertices[1]}) {}

    /// @param v the cell's first vertex
    HWY_INLINE void set(std::size_t slot, const T* v) {
        const T *next = v + slice_, *below = v - slice_, *above = next + slice_;
        take_inner(0, slot, v);
        take_inner(1, slot, v + row_);
        take_inner(2, slot, next);
        take_inner(3, slot, next + row_);
        take_outer(4, slot, v - row_);
        take_outer(5, slot, next - row_);
        take_outer(6, slot, v + 2 * row_);
        take_outer(7, slot, next + 2 * row_);
        take_outer(8, slot, below);
        take_outer(9, slot, below + row_);
        take_outer(10, slot, above);
        take_outer(11, slot, above + row_);
    }

    HWY_INLINE void make(const Maker& maker, std::size_t slot, std::uint32_t* out) const {
        auto x = hn::Zero(Ints());
        for (std::size_t row = 0; row < kInner; ++row)
            x = hn::Add(x, along(row, slot));
        const auto corner = across(0, slot), below_y = across(1, slot), below_z = across(2, slot),
                   opposite = across(3, slot);
        const auto y =
            hn::Add(outer(4, slot), hn::Sub(hn::Add(below_y, opposite), hn::Add(corner, below_z)));
        const auto z =
            hn::Add(outer(8, slot), hn::Sub(hn::Add(below_z, opposite), hn::Add(corner, below_y)));
        const typename Maker::D d;
        maker.write(hn::ConvertTo(d, x), hn::ConvertTo(d, y), hn::ConvertTo(d, z), out);
    }

  private:
    static constexpr std::size_t kInner = 4, kRows = 12;
    static constexpr std::size_t kWords = sizeof(T) == 1 ? kRows : kRows + kInner;
    using Ints = hn::Rebind<std::int32_t, typename Maker::D>;
    using V = hn::Vec<Ints>;

    /// Two vertices with their neighbors along x.
    HWY_INLINE void take_inner(std::size_t row, std::size_t slot, const T* v) {
        take(row, slot, v - 1);
        if constexpr (sizeof(T) == 2)
            take(kRows + row, slot, v + 1);
    }
    /// Two vertices, where bytes make words as above.
    HWY_INLINE void take_outer(std::size_t row, std::size_t slot, const T* v) {
        take(row, slot, sizeof(T) == 1 ? v - 1 : v);
    }
    HWY_INLINE void take(std::size_t word, std::size_t slot, const T* from) {
        std::memcpy(&words_[word][slot], from, sizeof(std::int32_t));
    }

    /// As if unsigned: an offset that no difference sees.
    HWY_INLINE V word(std::size_t word, std::size_t slot) const {
        const Ints d;
        const V values = hn::LoadU(d, words_[word].data() + slot);
        if constexpr (!std::is_signed_v<T>)
            return values;
        constexpr auto kFlip = sizeof(T) == 1 ? 0x80808080u : 0x80008000u;
        return hn::Xor(values, hn::Set(d, static_cast<std::int32_t>(kFlip)));
    }
    static HWY_INLINE V low(V words) { return hn::And(words, hn::Set(Ints(), 0xffff)); }
    static HWY_INLINE V high(V words) {
        const hn::Rebind<std::uint32_t, Ints> bits;
        return hn::BitCast(Ints(), hn::ShiftRight<16>(hn::BitCast(bits, words)));
    }

    /// Twice the sum of a row's differences along x, at both vertices of the cell.
    HWY_INLINE V along(std::size_t row, std::size_t slot) const {
        const V first = word(row, slot);
        if constexpr (sizeof(T) == 1) {
            const V mask = hn::Set(Ints(), 0x00ff00ff);
            const V pairs = hn::Add(hn::And(first, mask), hn::And(hn::ShiftRight<8>(first), mask));
            return hn::Sub(high(pairs), low(pairs));
        } else {
            const V second = word(kRows + row, slot);
            return hn::Sub(hn::Add(low(second), high(second)), hn::Add(low(first), high(first)));
        }
    }
    /// Sum of a row's values at both vertices of the cell.
    HWY_INLINE V across(std::size_t row, std::size_t slot) const {
        const V first = word(row, slot);
        if constexpr (sizeof(T) == 1) {
            const V byte = hn::Set(Ints(), 0xff);
            return hn::Add(hn::And(hn::ShiftRight<8>(first), byte),
                           hn::And(hn::ShiftRight<16>(first), byte));
        } else if (row < kInner)
            return hn::Add(high(first), low(word(kRows + row, slot)));
        else
            return hn::Add(low(first), high(first));
    }
    /// The outer neighbors' part along y or z: above minus below.
    HWY_INLINE V outer(std::size_t row, std::size_t slot) const {
        return hn::Sub(hn::Add(across(row + 2, slot), across(row + 3, slot)),
                       hn::Add(across(row, slot), across(row + 1, slot)));
    }

    std::ptrdiff_t row_, slice_;
    std::array<std::array<std::int32_t, kBatch>, kWords> words_{};
};

} // namespace isochron::index::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
