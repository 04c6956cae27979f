// Meshes of an extraction's surfaces, also with fewer triangles, which come after the rest of it.
#pragma once

#include "index/surface/cell_set.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <stop_token>
#include <utility>
#include <vector>

namespace isochron::index {

/// Edges of the clusters of which each simplified mesh has one vertex (mesh_clusters.h) [cells]. Mesh
/// level 0 is the mesh of all triangles; level i is simplified by clusters of kClusterEdges[i - 1].
constexpr std::array<std::uint32_t, 3> kClusterEdges{2, 4, 8};
constexpr std::size_t kMeshLevels = 1 + kClusterEdges.size();

struct SimplifiedMeshes {
    /// By mesh level, then by surface; null for a surface without cells. Level 0 only if the extraction
    /// came without it. Empty: there was no room for a level, or for those that are finer.
    std::array<std::vector<CellMeshPtr>, kMeshLevels> levels;
    std::uint64_t bytes() const;
    /// Drops levels, the finest first, until they fit.
    void fit(std::uint64_t room);
};
using SimplifiedMeshesPtr = std::shared_ptr<const SimplifiedMeshes>;

/// Simplifies the meshes of surfaces, on the calling thread: the same bytes every time.
/// @return null when stopped
SimplifiedMeshesPtr simplified(std::span<const CellSet> surfaces, const std::stop_token& stop);

/// Where these meshes are kept with their extraction: empty until they are made. Thread-safe.
class LaterMeshes {
  public:
    SimplifiedMeshesPtr get() const {
        const std::scoped_lock lock(mutex_);
        return meshes_;
    }
    void put(SimplifiedMeshesPtr meshes) {
        const std::scoped_lock lock(mutex_);
        meshes_ = std::move(meshes);
    }

  private:
    mutable std::mutex mutex_;
    SimplifiedMeshesPtr meshes_;
};

} // namespace isochron::index
