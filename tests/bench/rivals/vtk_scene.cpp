// VTK's renderer, from a module that is loaded when needed.
#include "tests/bench/rivals/vtk_scene.h"

#include "index/system/module.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include <vector>

namespace isochron::bench {

std::unique_ptr<VtkScene> vtk_scene(const index::StepValues& values,
                                    std::span<const CameraPose> cameras, int size,
                                    unsigned threads) {
    using Make =
        VtkScene* (*)(const index::StepValues&, std::span<const CameraPose>, int, unsigned);
    static const auto make =
        reinterpret_cast<Make>(index::module_symbol("isochron_vtk_scene", "isochron_vtk_scene"));
    // VTK gets the steps without origin and direction, so its cameras must be moved.
    const glm::dmat4 image_from_physical = glm::scale(glm::dmat4(1.0), values.grid.spacing) *
                                           glm::inverse(values.grid.physical_from_index());
    const auto moved = [&](const glm::dvec3& v, double w) {
        return glm::dvec3(image_from_physical * glm::dvec4(v, w));
    };
    std::vector<CameraPose> in_image;
    for (const CameraPose& camera : cameras)
        in_image.push_back({moved(camera.eye, 1), moved(camera.center, 1), moved(camera.up, 0)});
    return std::unique_ptr<VtkScene>(make(values, in_image, size, threads));
}

} // namespace isochron::bench
