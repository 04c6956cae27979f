// Footprints: the ways to draw a cell, and their sizes.
#pragma once

#include "render/cells/cell_shape.h"

#include <cstddef>
#include <cstdint>

namespace isochron::render {

/// What a cell looks like on the screen, from the coarsest to the best. Better ones need not cost
/// more. All use the same cells.
enum class Footprint : std::uint8_t {
    quad,     ///< flat and opaque, in any order: for motion
    gaussian, ///< blended back to front: for a settled view
    mesh,     ///< triangles between the surface's cuts of cell edges; only if the set has a mesh
    surface   ///< the exact trilinear isosurface, crisp at any distance: for a settled view
};
inline constexpr std::size_t kFootprints = 4;

/// The best footprint that `CellPass` draws.
inline constexpr Footprint kBestFootprint = Footprint::surface;

/// `quad`, `gaussian`, `mesh`, `surface`: as configuration files and reports call them.
const char* name_of(Footprint footprint);

/// A set of footprints; it always contains quads.
class FootprintSet {
  public:
    constexpr void add(Footprint footprint) { bits_ |= bit(footprint); }
    constexpr void remove(Footprint footprint) { bits_ &= ~bit(footprint) | bit(Footprint::quad); }
    constexpr bool has(Footprint footprint) const { return (bits_ & bit(footprint)) != 0; }
    /// The best footprint in the set that is at most `limit`.
    constexpr Footprint best(Footprint limit = kBestFootprint) const {
        auto footprint = static_cast<int>(limit);
        while (!has(static_cast<Footprint>(footprint)))
            --footprint;
        return static_cast<Footprint>(footprint);
    }
    /// The set of all footprints up to `limit`.
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

/// Whether the footprint shows the surface itself, in opaque or blended layers, rather than a quad
/// or splat in its place.
constexpr bool has_layers(Footprint footprint) {
    return footprint >= Footprint::mesh;
}

/// Sizes in voxels (lengths in vertex index coordinates, so anisotropic spacing stretches them).
/// The Gaussian has the sizes of the authors' later code. That code had quads of 1.6; here quads
/// are sqrt(2), with which discs cover a layer of cells seen face-on without a gap. In oblique
/// views the cells are denser, so quads of sqrt(2) leave no more gaps than quads of 1.6, and draw a
/// fifth fewer pixels.
struct FootprintShapes {
    CellShape shape = CellShape::plane;
    // Spheres:
    float quad_diameter = 1.41421356f;
    float gaussian_diameter = 4.0f; ///< at which the Gaussian is cut off
    float gaussian_sigma = 0.7f;
    // On planes:
    /// A quad shows the part of the plane within an enlarged cell; this is half a side of that cell.
    /// Planes of neighbors differ, so each plane goes on a little behind the common face.
    float half_cell = 0.597f;
    float plane_gaussian_radius = 1.45f; ///< at which the Gaussian is cut off
    float plane_sigma = 0.5075f;

    /// Radius of this footprint with the current shape, or half the side of a cell [voxels].
    float radius_of(Footprint footprint) const;
    float sigma() const { return shape == CellShape::plane ? plane_sigma : gaussian_sigma; }
};

} // namespace isochron::render
