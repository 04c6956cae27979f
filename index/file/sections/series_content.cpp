// The limits of every series, and the hash that identifies its data.
#include "index/file/sections/series_content.h"

#include "index/error.h"
#include "index/file/sections/file_layout.h"

#include <glm/matrix.hpp>
#include <xxhash.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace isochron::index {
namespace {

bool finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void check_positions(const std::vector<double>& at, std::uint32_t vertices) {
    if (at.empty())
        return;
    if (at.size() != vertices || at.front() != 0 || !std::isfinite(at.back()))
        throw Error("{} positions along an axis, expected {} from 0 on", at.size(), vertices);
    for (std::size_t i = 1; i < at.size(); ++i)
        if (!(at[i] > at[i - 1]))
            throw Error("position {} along an axis after {}, expected more", at[i], at[i - 1]);
}

} // namespace

void check_limits(const SeriesInfo& info) {
    const Grid& grid = info.grid;
    for (const std::uint32_t n : grid.vertices)
        if (n < 2 || n > 65537)
            throw Error("{}x{}x{} vertices, expected 2 to 65537 along each axis", grid.vertices[0],
                        grid.vertices[1], grid.vertices[2]);
    // The unit of a search: a layer of chunks and the planes below and above that normals need.
    Grid layer = grid;
    layer.vertices[2] = std::min(grid.vertices[2], 20u);
    if (has_wide_ids(layer))
        throw Error("{} cells in {} layers, expected fewer than 2^32", layer.cell_count(),
                    layer.cells()[2]);
    if (!finite(grid.origin) || !finite(grid.spacing) || !finite(grid.direction[0]) ||
        !finite(grid.direction[1]) || !finite(grid.direction[2]))
        throw Error("origin, spacing or direction is not finite");
    if (!(grid.spacing.x > 0 && grid.spacing.y > 0 && grid.spacing.z > 0))
        throw Error("spacing {} {} {}, expected positive numbers", grid.spacing.x, grid.spacing.y,
                    grid.spacing.z);
    for (std::size_t axis = 0; axis < 3; ++axis)
        check_positions(grid.positions[axis].distances(), grid.vertices[axis]);
    if (!(std::abs(glm::determinant(grid.direction)) > 1e-6))
        throw Error("the direction's axes lie in one plane");
    if (!std::isfinite(info.scaling.slope) || info.scaling.slope == 0 ||
        !std::isfinite(info.scaling.intercept))
        throw Error("scaling {} * stored + {}, expected finite numbers and no slope 0",
                    info.scaling.slope, info.scaling.intercept);
    if (info.times.empty() || info.times.size() >= std::numeric_limits<std::uint32_t>::max())
        throw Error("{} steps, expected 1 to 2^32 - 2", info.times.size());
    for (std::size_t t = 0; t < info.times.size(); ++t)
        if (!std::isfinite(info.times[t]) || (t > 0 && !(info.times[t] > info.times[t - 1])))
            throw Error("step {} has time {}, expected finite and increasing times", t,
                        info.times[t]);
    for (std::size_t i = 0; i < info.missing_after.size(); ++i)
        if (const std::uint32_t step = info.missing_after[i];
            step + std::size_t{1} >= info.steps() || (i > 0 && step <= info.missing_after[i - 1]))
            throw Error("a gap behind step {} of {}", step, info.steps());
}

std::uint64_t content_hash_of(const SeriesInfo& info, std::span<const std::uint64_t> checksums) {
    std::vector<double> numbers(info.grid.vertices.begin(), info.grid.vertices.end());
    for (const glm::dvec3& v : {info.grid.origin, info.grid.spacing, info.grid.direction[0],
                                info.grid.direction[1], info.grid.direction[2]})
        numbers.insert(numbers.end(), {v.x, v.y, v.z});
    numbers.insert(numbers.end(),
                   {static_cast<double>(info.type), info.scaling.slope, info.scaling.intercept});
    for (const AxisPositions& positions : info.grid.positions)
        numbers.insert(numbers.end(), positions.distances().begin(), positions.distances().end());
    numbers.insert(numbers.end(), info.times.begin(),
                   info.times.begin() + static_cast<std::ptrdiff_t>(checksums.size()));
    return XXH3_64bits_withSeed(numbers.data(), numbers.size() * sizeof(double),
                                checksum_of(std::as_bytes(checksums)));
}

} // namespace isochron::index
