// The order of chunks in a layer.
#include "index/file/chunks/chunk_grid.h"

#include <numeric>

namespace isochron::index {
namespace {

/// The bits of a 16-bit number, spread to every second bit.
std::uint32_t spread(std::uint32_t n) {
    n = (n | n << 8) & 0x00ff00ff;
    n = (n | n << 4) & 0x0f0f0f0f;
    n = (n | n << 2) & 0x33333333;
    return (n | n << 1) & 0x55555555;
}

} // namespace

ChunkGrid::ChunkGrid(const Grid& grid) : vertices_(grid.vertices) {
    std::ranges::transform(vertices_, counts_.begin(),
                           [](std::uint32_t n) { return (n + kChunkEdge - 1) / kChunkEdge; });
    at_.resize(chunks_of_layer());
    std::iota(at_.begin(), at_.end(), 0u);
    std::ranges::sort(at_, {}, [this](std::uint32_t i) {
        return spread(i % counts_[0]) | spread(i / counts_[0]) << 1;
    });
    place_.resize(at_.size());
    for (std::uint32_t place = 0; place < at_.size(); ++place)
        place_[at_[place]] = place;
}

} // namespace isochron::index
