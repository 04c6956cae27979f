// Meshes packed by meshoptimizer.
#include "app/commands/mesh_packing.h"

#ifdef ISOCHRON_WITH_MESHOPTIMIZER
#include <meshoptimizer.h>
#endif

namespace isochron::app {

#ifdef ISOCHRON_WITH_MESHOPTIMIZER
namespace {

unsigned char* bytes_in(std::vector<std::byte>& packed) {
    return reinterpret_cast<unsigned char*>(packed.data());
}

std::vector<std::byte> packed_vertices(std::span<const std::byte> bytes, std::size_t stride) {
    const std::size_t count = bytes.size() / stride;
    meshopt_encodeVertexVersion(0); // version that the extension names
    std::vector<std::byte> packed(meshopt_encodeVertexBufferBound(count, stride));
    packed.resize(
        meshopt_encodeVertexBuffer(bytes_in(packed), packed.size(), bytes.data(), count, stride));
    return packed;
}

/// In an order in which triangles that follow each other share vertices.
std::vector<std::byte> packed_triangles(std::span<const std::uint32_t> corners,
                                        std::size_t vertices) {
    std::vector<std::uint32_t> ordered(corners.size());
    meshopt_optimizeVertexCache(ordered.data(), corners.data(), corners.size(), vertices);
    meshopt_encodeIndexVersion(1); // version that the extension names
    std::vector<std::byte> packed(meshopt_encodeIndexBufferBound(ordered.size(), vertices));
    packed.resize(
        meshopt_encodeIndexBuffer(bytes_in(packed), packed.size(), ordered.data(), ordered.size()));
    return packed;
}

} // namespace
#endif

const index::MeshPacking* mesh_packing() {
#ifdef ISOCHRON_WITH_MESHOPTIMIZER
    static constexpr index::MeshPacking kPacking{packed_vertices, packed_triangles};
    return &kPacking;
#else
    return nullptr;
#endif
}

} // namespace isochron::app
