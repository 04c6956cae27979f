// Positions and planes of active cells: takes differences cell by cell, makes planes in batches.
#include "index/surface/cell_set.h"
#include "index/system/huge_pages.h"
#include "index/volume/cell_difference.h"
#include "index/volume/cell_walk.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "index/surface/cell_shading.cpp"
#include <hwy/foreach_target.h> // must come before highway.h

#include "index/surface/cell_planes_inl.h"

HWY_BEFORE_NAMESPACE();
namespace isochron::index::HWY_NAMESPACE {
namespace {

constexpr std::size_t kBetweenStops = 4096; ///< cells

/// Appends rows many at a time: appending each takes a fifth of the time to shade its cells.
class RowBuffer {
  public:
    explicit RowBuffer(std::vector<CellRow>& out) : out_(out) {}
    RowBuffer(const RowBuffer&) = delete;
    RowBuffer& operator=(const RowBuffer&) = delete;

    HWY_INLINE void add(CellRow row) {
        rows_[size_] = row;
        if (++size_ == rows_.size())
            flush();
    }
    void flush() {
        out_.insert(out_.end(), rows_.data(), rows_.data() + size_);
        size_ = 0;
    }

  private:
    std::vector<CellRow>& out_;
    std::size_t size_ = 0;
    std::array<CellRow, 256> rows_;
};

template <class T>
bool shade_values(const StepValues& values, const Query& query, std::span<const CellId> ids,
                  std::vector<CellPoint>& shaded, std::vector<CellRow>& shaded_rows,
                  const std::stop_token& stop) {
    Shaders<T> shaders(values, query.isovalue);
    const auto [width, height, depth] = values.grid.cells();
    const std::size_t row_size = values.grid.vertices[0];
    const std::size_t slice_size = row_size * values.grid.vertices[1];
    const T* const volume = values.step<T>(query.instant.step).data();
    CellWalk walk(values.grid);
    RowBuffer rows(shaded_rows);
    // The current row:
    std::uint32_t y = 0, z = 0, inner_width = 0; // number of cells, from the second on, for `fast`
    const T* of_row = volume;
    std::optional<CellDifferences<T>> differences;

    const std::size_t count = ids.size();
    const bool new_memory = shaded.capacity() < count;
    shaded.reserve(count);
    CellPoint* const points = shaded.data();
    for (std::size_t i = 0; i < count; ++i) {
        if (i % kBetweenStops == 0) {
            if (stop.stop_requested())
                return false;
            // Not all at once: fresh memory takes longer than what is written there.
            const std::size_t end = std::min(i + kBetweenStops, count);
            if (new_memory)
                fetch_pages(std::as_writable_bytes(std::span(points + i, end - i)));
            shaded.resize(end);
        }
        if (walk.to(ids[i])) {
            y = walk.y();
            z = walk.z();
            rows.add({static_cast<std::uint16_t>(y), static_cast<std::uint16_t>(z),
                      static_cast<std::uint32_t>(i)});
            of_row = volume + z * slice_size + y * row_size;
            const bool border = y == 0 || y + 1 == height || z == 0 || z + 1 == depth;
            inner_width = shaders.float_is_enough && !border && width > 2 ? width - 2 : 0;
            differences.reset();
        }
        const std::uint32_t x = walk.x();
        points[i] = {static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y),
                     static_cast<std::uint16_t>(z), 0, 0};
        if constexpr (Shaders<T>::kFast)
            if (x - 1u < inner_width) { // false for x = 0, too, as numbers are unsigned
                shaders.fast.add(points[i].plane, of_row + x);
                continue;
            }
        if (!differences)
            differences.emplace(values, query.instant.step, y, z);
        shaders.add_exact(points[i].plane, *differences, values.grid, {x, y, z});
    }
    rows.flush();
    shaders.finish();
    return true;
}

bool shade_step(const StepValues& values, const Query& query, std::span<const CellId> ids,
                std::vector<CellPoint>& points, std::vector<CellRow>& rows,
                const std::stop_token& stop) {
    return visit_value_type(values.type, [&]<class T>(std::type_identity<T>) {
        return shade_values<T>(values, query, ids, points, rows, stop);
    });
}

} // namespace
} // namespace isochron::index::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace isochron::index {

HWY_EXPORT(shade_step);

bool shade_cells(const StepValues& values, const Query& query, std::span<const CellId> ids,
                 std::vector<CellPoint>& points, std::vector<CellRow>& rows,
                 const std::stop_token& stop) {
    points.clear();
    rows.clear();
    rows.reserve(ids.size() / 2);
    return HWY_DYNAMIC_DISPATCH(shade_step)(values, query, ids, points, rows, stop);
}

} // namespace isochron::index
#endif
