// Grids of images, and parts of their arrays.
#include "index/readers/decoders/vtk/vtk_image.h"

#include "index/readers/decoders/decoded_file.h"
#include "index/readers/formats/stored_file.h"

#include <array>
#include <cassert>

namespace isochron::index {

Grid grid_of_vtk(const int (&extent)[6], const double* origin, const double* spacing,
                 const double* direction, const std::string& file) {
    Grid grid;
    std::array<std::int64_t, 3> sizes{};
    glm::dmat3 steps;
    for (int axis = 0; axis < 3; ++axis) {
        sizes[axis] = std::int64_t{extent[2 * axis + 1]} - extent[2 * axis] + 1;
        for (int row = 0; row < 3; ++row)
            steps[axis][row] = direction[3 * row + axis] * spacing[axis];
    }
    grid.vertices = checked_vertices(sizes, file);
    set_axes(grid, steps, file);
    grid.origin = glm::dvec3(origin[0], origin[1], origin[2]) +
                  steps * glm::dvec3(extent[0], extent[2], extent[4]);
    return grid;
}

std::uint64_t tuples_of_vtk(const ChosenScalar& chosen, const Grid& grid) {
    return chosen.array.on_cells ? grid.cell_count() : grid.vertex_count();
}

std::uint32_t slices_of_vtk(const ChosenScalar& chosen, const SeriesInfo& info) {
    return chosen.array.on_cells ? info.grid.vertices[2] : slices_worth_asking(info);
}

std::uint64_t bytes_of_vtk(const ChosenScalar& chosen, const Grid& grid) {
    return tuples_of_vtk(chosen, grid) * chosen.array.components * size_of(*chosen.array.type);
}

void convert_slices(const ChosenScalar& chosen, std::span<const std::byte> tuples, const Grid& grid,
                    Slices slices, std::span<const std::uint8_t> hidden, std::span<std::byte> out,
                    const std::string& file) {
    if (slices.count == grid.vertices[2])
        return convert(chosen, tuples, grid, out, file, hidden);
    assert(!chosen.array.on_cells);
    Grid slab = grid;
    slab.vertices[2] = slices.count;
    if (!hidden.empty()) {
        const std::size_t layer = hidden.size() / grid.vertices[2];
        hidden = hidden.subspan(slices.first * layer, slices.count * layer);
    }
    convert(chosen, tuples, slab, out, file, hidden);
}

} // namespace isochron::index
