// The values on a plane through an array.
#include "index/extraction/slice_values.h"

#include "index/error.h"
#include "index/file/step_view.h"

#include <algorithm>
#include <cmath>

namespace isochron::index {

SliceValues slice_values(const IndexFile& array, const SliceQuery& query,
                         const std::stop_token& stop) {
    const Grid& grid = array.info().grid;
    const SliceRuns runs(grid, query);
    const std::array whole{array.stats().low, array.stats().high};
    if (runs.empty())
        return runs.empty_slice(whole, {}, {});
    // Small steps are read as a whole, of others only the chunks that the plane cuts.
    const StepView step =
        array.referral() ? step_of(array, query.instant) : part_of_step(array, query.instant);
    if (std::max(runs.values(), runs.columns()) > kMostSliceValues)
        throw Error("{}: a slice of {} values, expected at most {}", array.name(),
                    std::max(runs.values(), runs.columns()), kMostSliceValues);
    SliceValues slice = runs.empty_slice(whole, step.type(), step.scaling());
    if (!step.by_chunks()) {
        const LoadedStep& loaded = step.whole(stop);
        runs.copy(loaded.values.step_bytes(step.at().step), {0, 0, 0}, grid.vertices, slice);
        return slice;
    }
    const ChunkGrid& chunks = step.chunk_grid();
    const auto places = runs.chunks(chunks);
    step.expect(0, places);
    for (std::uint32_t layer = 0; layer < chunks.layers(); ++layer) {
        if (places[layer].empty())
            continue;
        const std::vector<ChunkPtr> read = step.chunks(layer, places[layer], stop);
        for (std::size_t i = 0; i < read.size(); ++i) {
            const auto [x, y] = chunks.at(places[layer][i]);
            runs.copy(read[i]->values, {x * kChunkEdge, y * kChunkEdge, layer * kChunkEdge},
                      read[i]->size, slice);
        }
    }
    return slice;
}

std::optional<double> value_on(const SliceValues& slice, const Grid& grid, const glm::dvec3& at) {
    constexpr double kBeside = 1e-6; // cells: rounding of places on the box's faces
    if (slice.columns.empty())
        return std::nullopt;
    const glm::dvec3 place = grid.index_of(at);
    const auto cells = grid.cells();
    SliceRuns::Vertex cell{};
    std::array<double, 3> local{};
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        const double last = cells[a];
        if (!(place[axis] >= -kBeside && place[axis] <= last + kBeside))
            return std::nullopt;
        cell[a] = static_cast<std::uint32_t>(std::clamp(std::floor(place[axis]), 0.0, last - 1));
        local[a] = std::clamp(place[axis] - cell[a], 0.0, 1.0);
    }
    const auto axis = static_cast<std::size_t>(slice.axis);
    const std::size_t axis1 = (axis + 1) % 3, axis2 = (axis + 2) % 3;
    double sum = 0;
    for (unsigned corner = 0; corner < 8; ++corner) {
        const std::array<unsigned, 3> up{corner & 1, corner >> 1 & 1, corner >> 2};
        const std::size_t column =
            std::size_t{cell[axis2] + up[2]} * grid.vertices[axis1] + cell[axis1] + up[1];
        const SliceValues::Column& run = slice.columns[column];
        const std::size_t end = column + 1 < slice.columns.size() ? slice.columns[column + 1].offset
                                                                  : slice.shares.size();
        const std::size_t along = cell[axis] + up[0];
        if (along < run.first || run.offset + along - run.first >= end)
            return std::nullopt;
        const float share = slice.shares[run.offset + along - run.first];
        if (share == kNoShare)
            return std::nullopt;
        sum += double{share} * (up[0] ? local[axis] : 1 - local[axis]) *
               (up[1] ? local[axis1] : 1 - local[axis1]) *
               (up[2] ? local[axis2] : 1 - local[axis2]);
    }
    return slice.whole[0] + 2 * sum * (slice.whole[1] / 2 - slice.whole[0] / 2);
}

} // namespace isochron::index
