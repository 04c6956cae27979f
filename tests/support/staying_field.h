// Series parts of which stay as they are from one step to the next, chunk by chunk.
#pragma once

#include "index/file/chunks/chunk_grid.h"
#include "tests/support/test_field.h"

#include <cmath>
#include <cstdint>
#include <memory>
#include <random>
#include <utility>
#include <vector>

namespace isochron::index {

/// A field whose chunks change on their own, each at steps that chance picks.
/// @param share of the chunk-steps that are as in the step before
inline TestField::Function staying_field(std::mt19937& random, const TestField::Function& base,
                                         double share, std::size_t steps,
                                         std::uint32_t chunks_along_axis = 8) {
    const std::size_t chunks =
        std::size_t{chunks_along_axis} * chunks_along_axis * chunks_along_axis;
    auto versions =
        std::make_shared<std::vector<std::vector<int>>>(chunks, std::vector<int>(steps, 0));
    std::bernoulli_distribution stays(share);
    for (std::vector<int>& of_chunk : *versions)
        for (std::size_t t = 1; t < steps; ++t)
            of_chunk[t] = of_chunk[t - 1] + (stays(random) ? 0 : 1);
    return [versions, base, chunks_along_axis](double x, double y, double z, double t) {
        const auto along = [&](double v) {
            return static_cast<std::size_t>(v) / kChunkEdge % chunks_along_axis;
        };
        const std::size_t chunk =
            (along(z) * chunks_along_axis + along(y)) * chunks_along_axis + along(x);
        const int version = (*versions)[chunk][static_cast<std::size_t>(t)];
        return base(x, y, z, 0) + 0.3 * std::sin(7.0 * version + static_cast<double>(chunk % 13)) +
               0.1 * std::sin(x * y + z * version);
    };
}

} // namespace isochron::index
