// Simplifies the meshes of all surfaces of an extraction.
#include "index/extraction/simplified_meshes.h"

#include "index/surface/mesh_clusters.h"

namespace isochron::index {

std::uint64_t SimplifiedMeshes::bytes() const {
    std::uint64_t all = 0;
    for (const auto& surfaces : levels)
        for (const CellMeshPtr& mesh : surfaces)
            all += mesh ? bytes_of(*mesh) : 0;
    return all;
}

void SimplifiedMeshes::fit(std::uint64_t room) {
    for (std::vector<CellMeshPtr>& surfaces : levels)
        if (bytes() > room)
            surfaces.clear();
}

SimplifiedMeshesPtr simplified(std::span<const CellSet> surfaces, const std::stop_token& stop) {
    auto made = std::make_shared<SimplifiedMeshes>();
    for (std::size_t level = 1; level < kMeshLevels; ++level)
        for (const CellSet& surface : surfaces) {
            CellMeshPtr& mesh = made->levels[level].emplace_back();
            if (surface.mesh)
                mesh = std::make_shared<const CellMesh>(
                    clustered(*surface.mesh, kClusterEdges[level - 1], stop));
            if (stop.stop_requested())
                return nullptr;
        }
    return made;
}

} // namespace isochron::index
