// What cells can be drawn as, and how large.
#pragma once

#include "render/cells/cell_shape.h"

#include <cstddef>
#include <cstdint>

namespace isochron::render {

/// What a cell looks like on the screen, from the coarsest to the best, in no order of their costs;
/// all share the cells.
enum class Footprint : std::uint8_t {
    quad,     ///< flat and opaque, in any order: for motion
    gaussian, ///< blended back to front: for a settled view
    mesh,     ///< triangles through the surface's cuts of the cells' edges, where they come with it
    surface   ///< the exact trilinear isosurface, crisp at any distance: for a settled view
};
inline constexpr std::size_t kFootprints = 4;

/// The best footprint that `CellPass` draws.
inline constexpr Footprint kBestFootprint = Footprint::surface;

/// `quad`, `gaussian`, `mesh`, `surface`: as configuration files and reports call them.
const char* name_of(Footprint footprint);

/// Footprints that some cells can be drawn with: quads always.
class FootprintSet {
  public:
    constexpr void add(Footprint footprint) { bits_ |= bit(footprint); }
    constexpr void remove(Footprint footprint) { bits_ &= ~bit(footprint) | bit(Footprint::quad); }
    constexpr bool has(Footprint footprint) const { return (bits_ & bit(footprint)) != 0; }
    /// The best one that is no better than this.
    constexpr Footprint best(Footprint limit = kBestFootprint) const {
        auto footprint = static_cast<int>(limit);
        while (!has(static_cast<Footprint>(footprint)))
            --footprint;
        return static_cast<Footprint>(footprint);
    }
    /// All that are no better than this.
    static constexpr FootprintSet up_to(Footprint limit) {
        FootprintSet set;
        for (int i = 0; i <= static_cast<int>(limit); ++i)
            set.add(static_cast<Footprint>(i));
        return set;
    }
    bool operator==(const FootprintSet&) const = default;

  private:
    static constexpr unsigned bit(Footprint footprint) {
        return 1u << static_cast<unsigned>(footprint);
    }
    unsigned bits_ = bit(Footprint::quad);
};

/// Whether the footprint is the surface itself, in layers that are opaque or blended each, rather
/// than what stands for it in a cell.
constexpr bool has_layers(Footprint footprint) {
    return footprint >= Footprint::mesh;
}

/// Sizes in voxels: lengths in vertex index coordinates, so anisotropic spacing stretches them.
/// Those of the Gaussian are of the authors' own later code, which had quads of 1.6 voxels. But
/// discs of sqrt(2) cover the middles of a layer of cells seen face-on without a gap, and the other
/// views of a surface crowd its cells: nothing shows through that does not through 1.6, and a fifth
/// fewer pixels are drawn.
struct FootprintShapes {
    CellShape shape = CellShape::plane;
    // Of spheres:
    float quad_diameter = 1.41421356f;
    float gaussian_diameter = 4.0f; ///< where the Gaussian is cut off
    float gaussian_sigma = 0.7f;
    // Of ellipsoids on planes that pass near the middles of their cells:
    float plane_radius = 0.8f;
    float plane_gaussian_radius = 1.45f; ///< where the Gaussian is cut off
    float plane_sigma = 0.5075f;

    /// Half of the diameter with this footprint and shape.
    float radius_of(Footprint footprint) const;
    float sigma() const { return shape == CellShape::plane ? plane_sigma : gaussian_sigma; }
};

} // namespace isochron::render
