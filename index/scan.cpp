// Full scan of one step, row by row on bit masks, and the exact test of single cells.
#include "index/scan.h"

#include "index/ordinal.h"
#include "index/stored_cut.h"

#include <array>
#include <bit>
#include <cassert>
#include <cstring>
#include <optional>

namespace isochron::index {
namespace {

static_assert(std::endian::native == std::endian::little);

/// `stored_cut` as a value of the type.
template <class T>
std::optional<T> cut_at(ValueType type, const Scaling& scaling, double isovalue) {
    const auto cut = stored_cut(type, scaling, isovalue);
    if (!cut)
        return std::nullopt;
    return from_ordinal<T>(static_cast<Ordinal<T>>(*cut));
}

/// The vertex rows of one z plane as bit masks. Every row ends with a word of zeros, so that a word
/// and its right neighbour can always be read.
class PlaneMasks {
  public:
    PlaneMasks(std::uint32_t row_length, std::uint32_t rows)
        : words_((row_length + 63) / 64 + 1), upper_(words_ * rows), nan_(words_ * rows),
          flags_((words_ - 1) * 64) {}

    std::size_t words() const { return words_; }
    const std::uint64_t* upper(std::size_t row) const { return upper_.data() + row * words_; }
    const std::uint64_t* nan(std::size_t row) const { return nan_.data() + row * words_; }
    bool has_nan() const { return has_nan_; }

    template <class T>
    void fill(const T* plane, std::uint32_t row_length, std::uint32_t rows, T cut) {
        has_nan_ = false;
        for (std::uint32_t row = 0; row < rows; ++row) {
            const T* s = plane + std::size_t{row} * row_length;
            std::uint8_t* flags = flags_.data();
            for (std::uint32_t x = 0; x < row_length; ++x)
                flags[x] = s[x] >= cut;
            pack(upper_.data() + row * words_);
            if constexpr (std::is_floating_point_v<T>) {
                std::uint32_t nans = 0;
                for (std::uint32_t x = 0; x < row_length; ++x)
                    nans += s[x] != s[x];
                if (nans && !has_nan_) {
                    std::fill(nan_.begin(), nan_.end(), 0);
                    has_nan_ = true;
                }
                if (nans) {
                    for (std::uint32_t x = 0; x < row_length; ++x)
                        flags[x] = s[x] != s[x];
                    pack(nan_.data() + row * words_);
                }
            }
        }
    }

  private:
    /// Eight flags of 0 or 1 become eight bits in one multiplication.
    void pack(std::uint64_t* out) const {
        const std::uint8_t* flags = flags_.data();
        for (std::size_t word = 0; word + 1 < words_; ++word) {
            std::uint64_t bits = 0;
            for (int byte = 0; byte < 8; ++byte, flags += 8) {
                std::uint64_t eight;
                std::memcpy(&eight, flags, 8);
                bits |= (eight * 0x0102040810204080u >> 56) << (8 * byte);
            }
            out[word] = bits;
        }
    }

    std::size_t words_;
    std::vector<std::uint64_t> upper_, nan_;
    std::vector<std::uint8_t> flags_; ///< of one row; those past its end stay 0
    bool has_nan_ = false;
};

/// One bit for each cell of a row of cells: set where its eight vertices are not all alike.
/// A bit of `word` is a vertex; the next vertex of the last bit is in the next word.
struct CellRowMasks {
    std::array<const std::uint64_t*, 4> row;

    std::uint64_t any(std::size_t word) const {
        return row[0][word] | row[1][word] | row[2][word] | row[3][word];
    }
    std::uint64_t all(std::size_t word) const {
        return row[0][word] & row[1][word] & row[2][word] & row[3][word];
    }
    std::uint64_t any_of_eight(std::size_t word) const {
        const std::uint64_t bits = any(word);
        return bits | bits >> 1 | any(word + 1) << 63;
    }
    std::uint64_t all_of_eight(std::size_t word) const {
        const std::uint64_t bits = all(word);
        return bits & (bits >> 1 | all(word + 1) << 63);
    }
};

template <class T>
void scan_step(const StepValues& values, std::size_t step, T cut, std::vector<CellId>& out) {
    const auto [nx, ny, nz] = values.grid.vertices;
    const T* s = values.step<T>(step).data();
    PlaneMasks near(nx, ny), far(nx, ny);
    near.fill(s, nx, ny, cut);
    CellId row_id = 0;
    for (std::uint32_t z = 0; z + 1 < nz; ++z) {
        far.fill(s + (z + std::size_t{1}) * nx * ny, nx, ny, cut);
        for (std::uint32_t y = 0; y + 1 < ny; ++y, row_id += nx - 1) {
            const CellRowMasks cells{
                {near.upper(y), near.upper(y + 1), far.upper(y), far.upper(y + 1)}};
            for (std::size_t word = 0; word * 64 < nx - 1; ++word) {
                std::uint64_t active = cells.any_of_eight(word) & ~cells.all_of_eight(word);
                // The last bit of use belongs to the last vertex, which begins no cell.
                const std::size_t left = nx - 1 - word * 64;
                if (left < 64)
                    active &= (std::uint64_t{1} << left) - 1;
                for (const PlaneMasks* plane : {&near, &far})
                    if (plane->has_nan()) {
                        const CellRowMasks nan{
                            {plane->nan(y), plane->nan(y + 1), plane->nan(y), plane->nan(y + 1)}};
                        active &= ~nan.any_of_eight(word);
                    }
                for (; active; active &= active - 1)
                    out.push_back(row_id + static_cast<CellId>(word * 64) +
                                  static_cast<CellId>(std::countr_zero(active)));
            }
        }
        std::swap(near, far);
    }
}

template <class T>
void keep_active_in_step(const StepValues& values, std::size_t step, T cut,
                         std::vector<CellId>& ids) {
    const std::size_t nx = values.grid.vertices[0];
    const std::size_t plane = nx * values.grid.vertices[1];
    const std::array<std::size_t, 8> corners{0,     1,         nx,         nx + 1,
                                             plane, plane + 1, plane + nx, plane + nx + 1};
    const std::uint64_t cells = values.grid.cell_count();
    const std::uint64_t width = values.grid.cells()[0];
    const T* s = values.step<T>(step).data();
    // Ascending ids stay in a row for a while: only the first of a row is taken apart.
    std::uint64_t row_begin = 0, row_end = 0;
    const T* row = s;
    std::size_t kept = 0;
    for (const CellId id : ids) {
        if (id < row_begin || id >= row_end) {
            if (id >= cells)
                continue;
            const auto [x, y, z] = values.grid.cell_of(id);
            row = s + z * plane + y * nx;
            row_begin = id - x;
            row_end = row_begin + width;
        }
        const T* corner = row + (id - row_begin);
        int upper = 0;
        bool nan = false;
        for (const std::size_t offset : corners) {
            upper += corner[offset] >= cut;
            nan |= corner[offset] != corner[offset];
        }
        ids[kept] = id; // without a branch: which cells are kept cannot be predicted
        kept += !nan & (upper != 0) & (upper != 8);
    }
    ids.resize(kept);
}

} // namespace

void scan(const StepValues& values, const Query& query, std::vector<CellId>& out) {
    assert(query.step < values.steps);
    visit_value_type(values.type, [&]<class T>(std::type_identity<T>) {
        if (const auto cut = cut_at<T>(values.type, values.scaling, query.isovalue))
            scan_step<T>(values, query.step, *cut, out);
    });
}

void keep_active(const StepValues& values, const Query& query, std::vector<CellId>& ids) {
    assert(query.step < values.steps);
    visit_value_type(values.type, [&]<class T>(std::type_identity<T>) {
        if (const auto cut = cut_at<T>(values.type, values.scaling, query.isovalue))
            keep_active_in_step<T>(values, query.step, *cut, ids);
        else
            ids.clear();
    });
}

} // namespace isochron::index
