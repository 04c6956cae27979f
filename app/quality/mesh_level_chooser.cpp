// Goes through the meshes from the finest on.
#include "app/quality/mesh_level_chooser.h"

#include <algorithm>

namespace isochron::app {

std::optional<std::size_t> MeshLevelChooser::wanted(const MeshesAtHand& meshes) const {
    constexpr double kFinerFits = 0.75, kSameFits = 0.9; // shares of the budget
    constexpr double kHardlyLonger = 1.3;                // than quads
    // Times the budget, where quads are no more like the surface.
    constexpr double kForLikeness = 1.5;
    /// By level: the share of the cells as quads that is as much like the surface.
    constexpr std::array<double, index::kMeshLevels> kLikeQuads{2, 2, 0.5, 1.0 / 6};
    const bool scraps = meshes.translucent;
    const std::optional<std::size_t>& before = level_.value();
    const Milliseconds longest =
        scraps ? meshes.longest : std::min(kForLikeness * meshes.budget, meshes.longest);
    const Milliseconds instead =
        meshes.quads_take > meshes.budget ? kHardlyLonger * meshes.quads_take : Milliseconds(0);
    std::optional<std::size_t> coarsest;
    for (std::size_t level = 0; level < meshes.triangles.size(); ++level) {
        if (!scraps && meshes.quads > kLikeQuads[level])
            return std::nullopt;
        if (meshes.triangles[level] == 0)
            continue;
        const auto time = meshes.expected(meshes.triangles[level]);
        const bool finer = !before || level < *before;
        if (time && (*time <= (finer ? kFinerFits : kSameFits) * meshes.budget || *time <= instead))
            return level;
        if (time && *time <= longest && (scraps || meshes.quads <= kLikeQuads.back()))
            coarsest = level;
    }
    return coarsest;
}

std::optional<std::size_t> MeshLevelChooser::choose(const MeshesAtHand& meshes) {
    const std::optional<std::size_t>& before = level_.value();
    const bool gone = before && meshes.triangles[*before] == 0;
    return level_.turn(wanted(meshes), meshes.now, gone);
}

} // namespace isochron::app
