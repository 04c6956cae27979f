// Chooses which of a set's meshes is drawn while the picture moves.
#pragma once

#include "app/frame/milliseconds.h"
#include "app/quality/dwell.h"
#include "index/extraction/simplified_meshes.h"
#include "interaction/input/tracked_input.h"

#include <array>
#include <cstddef>
#include <functional>
#include <optional>

namespace isochron::app {

/// What the choice is made from.
struct MeshesAtHand {
    /// By mesh level; 0 where there is no mesh.
    std::array<std::size_t, index::kMeshLevels> triangles{};
    double quads = 1;           ///< share of all cells that is drawn as quads where no mesh is
    Milliseconds quads_take{0}; ///< expected; 0: not known
    /// Surfaces that let light through: what lies behind them is seen through the gaps between quads
    /// of some cells, and quads of all cells are flat pieces with rims in steps; any mesh is more
    /// like the surfaces.
    bool translucent = false;
    Milliseconds budget{0};
    Milliseconds longest{0}; ///< that a picture may take before scraps are preferred
    /// Time of drawing so many triangles; empty: not known.
    std::function<std::optional<Milliseconds>(std::size_t triangles)> expected;
    interaction::Seconds now{0}; ///< session time
};

/// The finest mesh that is expected to fit or, where quads do not fit either, to take hardly longer
/// than they do. A finer one than before has to fit with room to spare. The coarsest may take half as
/// long again as the budget where quads are of so few cells that they are less like the surface. Of
/// translucent surfaces it is taken before quads, as long as it takes no longer than any picture may.
class MeshLevelChooser {
  public:
    /// @return its level; empty: none fits, there is none, or quads of all cells are more like the
    /// surface
    std::optional<std::size_t> choose(const MeshesAtHand& meshes);
    const std::optional<std::size_t>& level() const { return level_.value(); }

  private:
    std::optional<std::size_t> wanted(const MeshesAtHand& meshes) const;

    Dwell<std::optional<std::size_t>> level_;
};

} // namespace isochron::app
