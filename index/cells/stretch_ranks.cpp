// The extremes of a stretch's cells at consecutive steps, as ranks.
#include "index/cells/stretch_ranks.h"

#include <algorithm>
#include <cmath>

namespace isochron::index {

/// The vertices that a stretch's cells touch: a contiguous part of every step.
struct StretchRanks::Vertices {
    Vertices(const Grid& grid, const Stretches& stretches, std::uint32_t stretch)
        : row_cells(grid.cells()[0]), rows_per_plane(grid.cells()[1]), row(grid.vertices[0]),
          plane(row * grid.vertices[1]), first_row(stretches.first_row(stretch)),
          row_count(stretches.row_count(stretch)) {
        first = vertex(first_row);
        count = vertex(first_row + row_count - 1) + plane + row + row - first;
    }
    /// Calls `f(cell, vertex)` for every row of cells, with the first cell's place in the stretch and
    /// the place of its lowest vertex in this part.
    template <class F>
    void for_each_row(F&& f) const {
        for (std::uint32_t r = 0; r < row_count; ++r)
            f(std::size_t{r} * row_cells, vertex(first_row + r) - first);
    }

    std::size_t row_cells, rows_per_plane;
    std::size_t row, plane; ///< vertices
    std::uint32_t first_row, row_count;
    std::size_t first, count; ///< vertices

  private:
    std::size_t vertex(std::size_t cell_row) const {
        return cell_row / rows_per_plane * plane + cell_row % rows_per_plane * row;
    }
};

StretchRanks::StretchRanks(const StepValues& values, const LevelMap& levels)
    : values_(values), levels_(levels), stretches_(values.grid),
      identity_(values.type == ValueType::u8 && levels == LevelMap::of_type(ValueType::u8)) {}

void StretchRanks::compute(std::uint32_t stretch, std::uint32_t first, std::uint32_t count) {
    steps_ = count;
    cells_ = stretches_.cells(stretch);
    low_.resize(std::size_t{count} * cells_ + kSlack);
    high_.resize(low_.size());
    const Vertices vertices(values_.grid, stretches_, stretch);
    square_low_.resize(vertices.count);
    square_high_.resize(vertices.count);
    const std::size_t size = size_of(values_.type);
    for (std::uint32_t step = 0; step < count; ++step) {
        const auto stored =
            values_.step_bytes(first + step).subspan(vertices.first * size, vertices.count * size);
        std::uint8_t* low = low_.data() + std::size_t{step} * cells_;
        std::uint8_t* high = high_.data() + std::size_t{step} * cells_;
        reduce_columns(ranks_of(stored), vertices.count);
        vertices.for_each_row([&](std::size_t cell, std::size_t vertex) {
            const std::uint8_t *near_low = square_low_.data() + vertex,
                               *far_low = near_low + vertices.plane,
                               *near_high = square_high_.data() + vertex,
                               *far_high = near_high + vertices.plane;
            std::uint8_t *row_low = low + cell, *row_high = high + cell;
            for (std::size_t x = 0; x < vertices.row_cells; ++x) {
                row_low[x] = std::min(near_low[x], far_low[x]);
                row_high[x] = std::max(near_high[x], far_high[x]);
            }
        });
        if (find_nan(stored))
            mark_nan(vertices, low, high);
    }
}

const std::uint8_t* StretchRanks::ranks_of(std::span<const std::byte> stored) {
    if (identity_)
        return reinterpret_cast<const std::uint8_t*>(stored.data());
    ranks_.resize(stored.size() / size_of(values_.type));
    levels_.ranks(stored, ranks_);
    return ranks_.data();
}

/// Computes the extremes of the four vertices (x, y) to (x+1, y+1) if all are in the vertices. At
/// the end of a row and in the last row of a plane they have no meaning.
void StretchRanks::reduce_columns(const std::uint8_t* ranks, std::size_t count) {
    const std::size_t row = values_.grid.vertices[0];
    const std::uint8_t *a = ranks, *b = ranks + 1, *c = ranks + row, *d = c + 1;
    std::uint8_t *low = square_low_.data(), *high = square_high_.data();
    for (std::size_t v = 0; v + row + 1 < count; ++v) {
        low[v] = std::min(std::min(a[v], b[v]), std::min(c[v], d[v]));
        high[v] = std::max(std::max(a[v], b[v]), std::max(c[v], d[v]));
    }
}

/// Whether any value is NaN; if so, sets `ranks_` to 1 for each NaN and 0 for other values.
bool StretchRanks::find_nan(std::span<const std::byte> stored) {
    return visit_value_type(values_.type, [&]<class T>(std::type_identity<T>) {
        if constexpr (std::is_floating_point_v<T>) {
            const T* values = reinterpret_cast<const T*>(stored.data());
            std::uint8_t any = 0;
            for (std::size_t v = 0; v < ranks_.size(); ++v) {
                ranks_[v] = values[v] != values[v];
                any |= ranks_[v];
            }
            return any != 0;
        } else {
            return false;
        }
    });
}

void StretchRanks::mark_nan(const Vertices& vertices, std::uint8_t* low, std::uint8_t* high) {
    reduce_columns(ranks_.data(), vertices.count);
    vertices.for_each_row([&](std::size_t cell, std::size_t vertex) {
        const std::uint8_t *near = square_high_.data() + vertex, *far = near + vertices.plane;
        for (std::size_t x = 0; x < vertices.row_cells; ++x)
            if (near[x] | far[x]) {
                low[cell + x] = 1;
                high[cell + x] = 0;
            }
    });
}

} // namespace isochron::index
