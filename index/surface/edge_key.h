// Keys of the grid's edges: one number for each.
#pragma once

#include "index/surface/cell_mesh.h"

#include <bit>
#include <cstdint>
#include <cstring>

namespace isochron::index {

/// The lower end of an edge and its axis: the first eight bytes of its MeshVertex.
using EdgeKey = std::uint64_t;

/// The key of an edge along x. The key of an edge along axis a is larger by a << 48.
constexpr EdgeKey key_of(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    return EdgeKey{x} | EdgeKey{y} << 16 | EdgeKey{z} << 32;
}

inline EdgeKey key_of(const MeshVertex& vertex) {
    static_assert(std::endian::native == std::endian::little);
    EdgeKey key;
    std::memcpy(&key, &vertex, sizeof(key));
    return key;
}

} // namespace isochron::index
