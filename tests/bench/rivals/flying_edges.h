// The current standard: VTK's flying edges, computed anew for every step and isovalue.
#pragma once

#include "index/volume/query.h"
#include "index/volume/step_values.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace isochron::bench {

/// `vtkFlyingEdges3D` (Schroeder, Maynard and Geveci, LDAV 2015, doi 10.1109/LDAV.2015.7348069) on
/// one thread, without a copy of the volume.
class FlyingEdges {
  public:
    virtual ~FlyingEdges() = default;
    struct Surface {
        std::uint64_t triangles, vertices, normals;
    };
    /// Contours a step from the start.
    virtual Surface contour(const index::Query& query, bool normals) = 0;

    /// The surface of a step, with normals.
    struct Geometry {
        std::vector<glm::vec3> points; ///< in units of the grid's spacing
        std::vector<glm::vec3> normals;
        std::vector<std::array<std::uint32_t, 3>> triangles;
    };
    virtual Geometry geometry(const index::Query& query) = 0;
};

/// @param values must outlive it
/// @throws index::Error when the module with VTK cannot be loaded
std::unique_ptr<FlyingEdges> flying_edges(const index::StepValues& values);

} // namespace isochron::bench
