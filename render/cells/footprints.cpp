// Names and radii of footprints.
#include "render/cells/footprints.h"

namespace isochron::render {

const char* name_of(CellShape shape) {
    return shape == CellShape::plane ? "plane" : "voxel";
}

float FootprintShapes::radius_of(Footprint footprint) const {
    const bool gaussian = footprint == Footprint::gaussian;
    if (shape == CellShape::plane)
        return gaussian ? plane_gaussian_radius : half_cell;
    return 0.5f * (gaussian ? gaussian_diameter : quad_diameter);
}

const char* name_of(Footprint footprint) {
    switch (footprint) {
    case Footprint::quad: return "quad";
    case Footprint::gaussian: return "gaussian";
    case Footprint::mesh: return "mesh";
    case Footprint::surface: break;
    }
    return "surface";
}

} // namespace isochron::render
