// Makes the planes of many cells at a time from the values around them; compiled once for each SIMD
// target.
#include "index/surface/cell_plane.h"
#include "index/volume/cell_difference.h"

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

// Highway's guard: the file is read again for every target.
#if defined(ISOCHRON_INDEX_CELL_PLANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ISOCHRON_INDEX_CELL_PLANES_INL_H
#undef ISOCHRON_INDEX_CELL_PLANES_INL_H
#else
#define ISOCHRON_INDEX_CELL_PLANES_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace isochron::index::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kBatch = 64; ///< cells whose planes are made together

/// Makes packed planes (cell_plane.h) of differences.
template <class Real>
class PlaneMaker {
  public:
    using D = hn::CappedTag<Real, kBatch>;
    using V = hn::Vec<D>;
    struct V3 {
        V x, y, z;
    };

    /// @param normal_from_difference with entries of at most 1
    /// @param reversed whether larger stored values are smaller scaled ones
    PlaneMaker(const glm::dmat3& normal_from_difference, bool reversed) : reversed_(reversed) {
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 3; ++column)
                matrix_[row][column] = static_cast<Real>(normal_from_difference[column][row]);
    }

    /// @param around differences around the cells, at any scale
    /// @param own, rise see CellSlope; both at the same scale
    /// @param size of the cells in even coordinates; null: 1
    HWY_INLINE void write(V3 around, V3 own, V rise, std::uint32_t* out,
                          const V3* size = nullptr) const {
        const D d;
        const V largest = largest_of(around);
        const V sum = sum_of(around); // keeps every NaN
        const auto usable = hn::And(
            hn::And(hn::Gt(largest, hn::Zero(d)), hn::Lt(largest, infinity())), hn::Eq(sum, sum));
        if constexpr (sizeof(Real) == 8) { // for any type: no square may overflow or underflow
            around = over(around, largest);
            const V own_size = largest_of(own);
            const V largest_own =
                hn::IfThenElse(hn::Gt(own_size, hn::Zero(d)), own_size, hn::Set(d, Real{1}));
            own = over(own, largest_own);
            rise = hn::Div(rise, largest_own);
        }
        const V3 n = {row(0, around), row(1, around), row(2, around)};
        const V over_sum = hn::Div(hn::Set(d, Real{1}), sum_of(n));
        const V u = hn::Mul(n.x, over_sum), v = hn::Mul(n.y, over_sum);
        const auto below = hn::Lt(n.z, hn::Zero(d));
        const auto folded = [&](V of, V other) HWY_ATTR {
            return hn::IfThenElse(
                below, hn::CopySign(hn::Sub(hn::Set(d, Real{1}), hn::Abs(other)), of), of);
        };
        const auto coordinate = [&](V c) HWY_ATTR {
            const V at = hn::MulAdd(c, hn::Set(d, Real{packed_plane::kOne}),
                                    hn::Set(d, Real{packed_plane::kZero}));
            return rounded(hn::IfThenElseZero(usable, at));
        };
        if (size) // per even coordinate until here, now per cell
            around = {hn::Mul(around.x, size->x), hn::Mul(around.y, size->y),
                      hn::Mul(around.z, size->z)};
        // Along the vector of the differences, which points towards larger stored values.
        const V along = dot(own, around);
        const V around2 = dot(around, around);
        const V least =
            hn::Mul(hn::Set(d, Real{CellPlane::kLeastCosine2}), hn::Mul(around2, dot(own, own)));
        const V way = hn::Div(hn::Mul(rise, hn::Sqrt(around2)), hn::Add(along, along));
        const auto rises = hn::And(hn::Gt(hn::Mul(along, hn::Abs(along)), least), hn::Eq(way, way));
        const V most = hn::Set(d, Real{CellPlane::kFarthest});
        const V clamped = hn::Clamp(hn::IfThenElseZero(rises, way), hn::Neg(most), most);
        const V to_byte =
            hn::Set(d, Real{packed_plane::kFarthest / CellPlane::kFarthest} * (reversed_ ? 1 : -1));
        const auto byte = rounded(hn::IfThenElseZero(usable, hn::Mul(clamped, to_byte)));
        const auto packed =
            hn::Or(coordinate(folded(u, v)),
                   hn::Or(hn::ShiftLeft<12>(coordinate(folded(v, u))), hn::ShiftLeft<24>(byte)));
        hn::StoreU(hn::BitCast(hn::Rebind<std::uint32_t, D>(), packed),
                   hn::Rebind<std::uint32_t, D>(), out);
    }

  private:
    static V infinity() { return hn::Set(D(), std::numeric_limits<Real>::infinity()); }

    static HWY_INLINE V dot(const V3& a, const V3& b) {
        return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
    }
    static HWY_INLINE V largest_of(const V3& v) {
        return hn::Max(hn::Max(hn::Abs(v.x), hn::Abs(v.y)), hn::Abs(v.z));
    }
    static HWY_INLINE V sum_of(const V3& v) {
        return hn::Add(hn::Add(hn::Abs(v.x), hn::Abs(v.y)), hn::Abs(v.z));
    }
    static HWY_INLINE V3 over(const V3& v, V divisor) {
        return {hn::Div(v.x, divisor), hn::Div(v.y, divisor), hn::Div(v.z, divisor)};
    }
    HWY_INLINE V row(std::size_t i, const V3& v) const {
        const D d;
        return dot(
            {hn::Set(d, matrix_[i][0]), hn::Set(d, matrix_[i][1]), hn::Set(d, matrix_[i][2])}, v);
    }

    /// Rounds halves away from zero, as `lround` does.
    static HWY_INLINE auto rounded(V v) {
        const hn::Rebind<std::int32_t, D> ints;
        v = hn::Add(v, hn::CopySign(hn::Set(D(), Real{0.5}), v));
        if constexpr (sizeof(Real) == 4)
            return hn::ConvertTo(ints, v);
        else
            return hn::DemoteTo(ints, v);
    }

    bool reversed_;
    std::array<std::array<Real, 3>, 3> matrix_;
};

/// A batch of cells given by their differences, in double: for every type, also at the border, and
/// where vertices are uneven.
class DifferenceBatch {
  public:
    using Maker = PlaneMaker<double>;

    void set(std::size_t slot, const glm::dvec3& around, const CellSlope& slope,
             const glm::dvec3& size) {
        for (int axis = 0; axis < 3; ++axis) {
            around_[axis][slot] = around[axis];
            own_[axis][slot] = slope.own[axis];
            size_[axis][slot] = size[axis];
        }
        rise_[slot] = slope.rise;
    }
    HWY_INLINE void make(const Maker& maker, std::size_t slot, std::uint32_t* out) const {
        const auto three = [&](const Three& from) HWY_ATTR {
            const Maker::D d;
            return Maker::V3{hn::LoadU(d, from[0].data() + slot),
                             hn::LoadU(d, from[1].data() + slot),
                             hn::LoadU(d, from[2].data() + slot)};
        };
        const auto size = three(size_);
        maker.write(three(around_), three(own_), hn::LoadU(Maker::D(), rise_.data() + slot), out,
                    &size);
    }

  private:
    using Three = std::array<std::array<double, kBatch>, 3>;
    Three around_{}, own_{}, size_{};
    std::array<double, kBatch> rise_{};
};

/// A batch of inner cells of 8- and 16-bit types, given by the values around them as words of four
/// bytes. All sums of differences are exact in `float`.
template <class T>
class ValueBatch {
  public:
    using Maker = PlaneMaker<float>;

    /// @param level isovalue among stored values
    ValueBatch(const Grid& grid, double level)
        : row_(grid.vertices[0]), slice_(row_ * std::ptrdiff_t{grid.vertices[1]}) {
        constexpr double kFar = 1 << 20; // beyond all values
        // The level is split into a whole number, which integers keep exactly, and a rest below 1.
        const double from_lowest =
            std::isfinite(level) ? std::clamp(level + kOffset, -kFar, kFar) : 0.0;
        whole_level_ = static_cast<std::int32_t>(8 * std::floor(from_lowest));
        rest_of_level_ = static_cast<float>(8 * (from_lowest - std::floor(from_lowest)));
    }

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
        auto x = hn::Zero(Ints()), own_x = hn::Zero(Ints());
        for (std::size_t row = 0; row < kInner; ++row) {
            x = hn::Add(x, along(row, slot));
            own_x = hn::Add(own_x, within(row, slot));
        }
        const auto corner = across(0, slot), below_y = across(1, slot), below_z = across(2, slot),
                   opposite = across(3, slot);
        const auto upper_y = hn::Add(below_y, opposite), lower_y = hn::Add(corner, below_z);
        const auto upper_z = hn::Add(below_z, opposite), lower_z = hn::Add(corner, below_y);
        const auto own_y = hn::Sub(upper_y, lower_y), own_z = hn::Sub(upper_z, lower_z);
        const auto y = hn::Add(outer(4, slot), own_y), z = hn::Add(outer(8, slot), own_z);
        const auto rise = hn::Sub(hn::Set(Ints(), whole_level_), hn::Add(upper_y, lower_y));
        const typename Maker::D d;
        const auto three = [&](V a, V b, V c) HWY_ATTR {
            return
                typename Maker::V3{hn::ConvertTo(d, a), hn::ConvertTo(d, b), hn::ConvertTo(d, c)};
        };
        maker.write(three(x, y, z), three(own_x, own_y, own_z),
                    hn::Add(hn::ConvertTo(d, rise), hn::Set(d, rest_of_level_)), out);
    }

  private:
    static constexpr std::size_t kInner = 4, kRows = 12;
    static constexpr std::size_t kWords = sizeof(T) == 1 ? kRows : kRows + kInner;
    using Ints = hn::Rebind<std::int32_t, typename Maker::D>;
    using V = hn::Vec<Ints>;
    /// The number that `word` adds to values.
    static constexpr double kOffset =
        std::is_signed_v<T> ? -double{std::numeric_limits<T>::min()} : 0.0;

    /// Takes two vertices with their neighbors along x.
    HWY_INLINE void take_inner(std::size_t row, std::size_t slot, const T* v) {
        take(row, slot, v - 1);
        if constexpr (sizeof(T) == 2)
            take(kRows + row, slot, v + 1);
    }
    /// Takes two vertices; for types of one byte with their neighbors, as above.
    HWY_INLINE void take_outer(std::size_t row, std::size_t slot, const T* v) {
        take(row, slot, sizeof(T) == 1 ? v - 1 : v);
    }
    HWY_INLINE void take(std::size_t word, std::size_t slot, const T* from) {
        std::memcpy(&words_[word][slot], from, sizeof(std::int32_t));
    }

    /// Difference of a row's values at the two vertices of the cell.
    HWY_INLINE V within(std::size_t row, std::size_t slot) const {
        const V first = word(row, slot);
        if constexpr (sizeof(T) == 1) {
            const V byte = hn::Set(Ints(), 0xff);
            return hn::Sub(hn::And(hn::ShiftRight<16>(first), byte),
                           hn::And(hn::ShiftRight<8>(first), byte));
        } else
            return hn::Sub(low(word(kRows + row, slot)), high(first));
    }

    /// Values as unsigned numbers: signed types get an offset, which cancels in differences.
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

    /// Twice the sum of a row's central differences along x at the two vertices of the cell.
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
    /// Sum of a row's values at the two vertices of the cell.
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
    std::int32_t whole_level_; ///< 8 * floor(level + kOffset)
    float rest_of_level_;      ///< 8 * (level + kOffset) - whole_level_
    std::array<std::array<std::int32_t, kBatch>, kWords> words_{};
};

/// A batch of inner cells of whole numbers of 32 bits, as blends of smaller ones are, too. All sums of
/// differences are exact in `double`, and rounded once.
template <class T>
class WordBatch {
  public:
    using Maker = PlaneMaker<float>;

    WordBatch(const Grid& grid, double level)
        : row_(grid.vertices[0]), slice_(row_ * std::ptrdiff_t{grid.vertices[1]}), level_(level) {}

    /// @param v the cell's first vertex
    HWY_INLINE void set(std::size_t slot, const T* v) {
        const std::array<const T*, 4> edges{v, v + row_, v + slice_, v + row_ + slice_};
        for (std::size_t edge = 0; edge < edges.size(); ++edge)
            std::memcpy(&along_[edge][4 * slot], edges[edge] - 1, 4 * sizeof(T));
        const std::array<const T*, 8> around{
            v - row_,   v + slice_ - row_, v + 2 * row_,   v + slice_ + 2 * row_,
            v - slice_, v + row_ - slice_, v + 2 * slice_, v + row_ + 2 * slice_};
        for (std::size_t edge = 0; edge < around.size(); ++edge)
            std::memcpy(&outer_[edge][2 * slot], around[edge], 2 * sizeof(T));
    }

    HWY_INLINE void make(const Maker& maker, std::size_t slot, std::uint32_t* out) const {
        const typename Maker::D d;
        for (std::size_t i = 0; i < hn::Lanes(d); i += hn::Lanes(Doubles()))
            add_up(slot + i, i);
        const auto sum = [&](std::size_t of) HWY_ATTR { return hn::LoadU(d, sums_[of].data()); };
        maker.write({sum(0), sum(1), sum(2)}, {sum(3), sum(4), sum(5)}, sum(6), out);
    }

  private:
    using Doubles = hn::ScalableTag<double>;
    using Words = hn::Rebind<T, Doubles>;
    using V = hn::Vec<Doubles>;
    static constexpr std::size_t kMostLanes = 64;

    /// Sums of some cells, at a scale at which `float` can multiply four of them.
    HWY_INLINE void add_up(std::size_t slot, std::size_t to) const {
        const Doubles d;
        V x = hn::Zero(d);
        std::array<V, 2> edges[2]; // by y, and z: the sum of a row's two vertices of the cell
        V own_x = hn::Zero(d);
        for (std::size_t edge = 0; edge < 4; ++edge) {
            hn::Vec<Words> a, b, c, e;
            hn::LoadInterleaved4(Words(), along_[edge].data() + 4 * slot, a, b, c, e);
            const V first = hn::PromoteTo(d, b), second = hn::PromoteTo(d, c);
            const V inner = hn::Sub(second, first);
            own_x = hn::Add(own_x, inner);
            x = hn::Add(x, hn::Add(hn::Sub(second, hn::PromoteTo(d, a)),
                                   hn::Sub(hn::PromoteTo(d, e), first)));
            edges[edge / 2][edge % 2] = hn::Add(first, second);
        }
        const auto outer = [&](std::size_t edge) HWY_ATTR {
            hn::Vec<Words> a, b;
            hn::LoadInterleaved2(Words(), outer_[edge].data() + 2 * slot, a, b);
            return hn::Add(hn::PromoteTo(d, a), hn::PromoteTo(d, b));
        };
        const auto above_below = [&](std::size_t edge) HWY_ATTR {
            return hn::Sub(hn::Add(outer(edge + 2), outer(edge + 3)),
                           hn::Add(outer(edge), outer(edge + 1)));
        };
        const V low_y = hn::Add(edges[0][0], edges[1][0]),
                high_y = hn::Add(edges[0][1], edges[1][1]);
        const V low_z = hn::Add(edges[0][0], edges[0][1]),
                high_z = hn::Add(edges[1][0], edges[1][1]);
        const V own_y = hn::Sub(high_y, low_y), own_z = hn::Sub(high_z, low_z);
        const V rise = hn::Sub(hn::Set(d, 8 * level_), hn::Add(low_y, high_y));
        const auto keep = [&](std::size_t of, V value) HWY_ATTR {
            const hn::Rebind<float, Doubles> floats;
            hn::StoreU(hn::DemoteTo(floats, hn::Mul(value, hn::Set(d, 0x1p-16))), floats,
                       sums_[of].data() + to);
        };
        keep(0, x);
        keep(1, hn::Add(own_y, above_below(0)));
        keep(2, hn::Add(own_z, above_below(4)));
        keep(3, own_x);
        keep(4, own_y);
        keep(5, own_z);
        keep(6, rise);
    }

    std::ptrdiff_t row_, slice_;
    double level_;
    std::array<std::array<T, 4 * kBatch>, 4> along_{};
    std::array<std::array<T, 2 * kBatch>, 8> outer_{};
    mutable std::array<std::array<float, kMostLanes>, 7> sums_{};
};

/// Collects cells, and makes their planes when a batch is full.
template <class Batch>
class Shader {
  public:
    Shader(Batch batch, const typename Batch::Maker& maker)
        : batch_(std::move(batch)), maker_(maker) {}

    template <class... Values>
    HWY_INLINE void add(std::uint32_t& plane, const Values&... values) {
        batch_.set(size_, values...);
        planes_[size_] = &plane;
        if (++size_ == kBatch)
            finish();
    }

    void finish() {
        std::array<std::uint32_t, kBatch> made;
        for (std::size_t i = 0; i < size_; i += hn::Lanes(typename Batch::Maker::D()))
            batch_.make(maker_, i, made.data() + i);
        for (std::size_t i = 0; i < size_; ++i)
            *planes_[i] = made[i];
        size_ = 0;
    }

  private:
    Batch batch_;
    typename Batch::Maker maker_;
    std::array<std::uint32_t*, kBatch> planes_;
    std::size_t size_ = 0;
};

/// Least ratio of the spacings for which `float` is precise enough.
constexpr double kFloatIsEnough = 1e-4;

/// What makes the planes of the cells of a step with values of type T.
template <class T>
class Shaders {
  public:
    /// Whether inner cells have a faster way.
    static constexpr bool kFast = sizeof(T) <= 4 && std::is_integral_v<T>;
    using Fast = std::conditional_t<kFast && sizeof(T) == 4, WordBatch<T>,
                                    ValueBatch<std::conditional_t<kFast, T, std::uint8_t>>>;

    Shaders(const StepValues& values, double isovalue)
        : Shaders(values, scaled_matrix(values), stored_value(values.scaling, isovalue)) {}

    const bool regular;         ///< the grid
    const bool float_is_enough; ///< for inner cells: `fast` may be used
    Shader<Fast> fast;

    HWY_INLINE void add_exact(std::uint32_t& plane, const CellDifferences<T>& of_row,
                              const Grid& grid, const std::array<std::uint32_t, 3>& cell) {
        exact_.add(plane, of_row(cell[0]), of_row.slope(cell[0], level_),
                   regular ? glm::dvec3(1.0) : grid.even_size(cell));
    }
    void finish() {
        fast.finish();
        exact_.finish();
    }

  private:
    struct Matrix {
        glm::dmat3 matrix;
        double smallest = 0;
    };
    static Matrix scaled_matrix(const StepValues& values) {
        Matrix scaled;
        scaled.matrix = scaled_to_one(normal_from_difference(values), scaled.smallest);
        return scaled;
    }
    Shaders(const StepValues& values, const Matrix& scaled, double level)
        : regular(!values.grid.rectilinear()),
          float_is_enough(kFast && scaled.smallest >= kFloatIsEnough && regular),
          fast(Fast(values.grid, level), {scaled.matrix, values.scaling.slope < 0}), level_(level),
          exact_({}, {scaled.matrix, values.scaling.slope < 0}) {}

    double level_; ///< isovalue among stored values
    Shader<DifferenceBatch> exact_;
};

} // namespace isochron::index::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
