// The agreement of a picture of a surface with the reference ray-caster.
#pragma once

#include "tests/render/cells/reference_ray_caster.h"
#include "tests/render/cells/surface_picture.h"

#include <vector>

namespace isochron::render {

/// What a picture and the reference agree on.
struct Agreement {
    int hit = 0;                      ///< pixels that either has hit
    int hit_by_one = 0;               ///< and the other has not
    int elsewhere = 0;                ///< pixels that both have hit, more than 0.1 voxel apart
    std::vector<double> depth_errors; ///< [voxels] along the ray
    std::vector<double> angles;       ///< between normals where the depths agree [rad]

    void add(const Agreement& other);
    /// @param share 0 to 1. @return 0 if there are no values
    static double percentile(std::vector<double> values, double share);
};

Agreement compare(const SurfacePicture& picture, const VertexField& field, const View& view,
                  const Placement& placement);

/// 160 pixels squared, with depth to spare for a volume that is placed at the origin.
View perspective_view(const glm::vec3& eye, const glm::vec3& target = glm::vec3(0.0f));

} // namespace isochron::render
