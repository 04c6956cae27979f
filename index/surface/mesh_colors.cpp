// Colors vertices by values, or by cells.
#include "index/surface/mesh_colors.h"

#include "index/surface/cell_colors.h"
#include "index/surface/mesh_cases.h"

#include <algorithm>

namespace isochron::index {

std::vector<std::uint16_t> colors_of(std::span<const float> values, double low, double high) {
    std::vector<std::uint16_t> colors(values.size());
    std::ranges::transform(values, colors.begin(),
                           [&](float value) { return fine_color_coordinate(value, low, high); });
    return colors;
}

void color_by_values(CellMesh& mesh, double low, double high) {
    mesh.colors = colors_of(mesh.values, low, high);
    mesh.values = {};
}

void color_by_cells(CellMesh& mesh, std::span<const std::uint16_t> colors) {
    std::vector<bool> known(mesh.vertices.size());
    mesh.colors.assign(mesh.vertices.size(), kNoFineColor);
    const std::uint32_t* corner = mesh.triangles.data();
    for (std::size_t cell = 0; cell < colors.size(); ++cell) {
        const std::uint16_t coarse = colors[cell];
        const auto fine = static_cast<std::uint16_t>(
            coarse == kNoColor ? kNoFineColor : coarse * kFineColorSteps / kColorSteps);
        const std::uint32_t* const end =
            corner + std::size_t{3} * mesh_cases()[mesh.cases[cell]].triangles;
        for (; corner != end; ++corner)
            if (!known[*corner]) {
                known[*corner] = true;
                mesh.colors[*corner] = fine;
            }
    }
}

} // namespace isochron::index
