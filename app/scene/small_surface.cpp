// A surface in one cell, with all that any footprint needs.
#include "app/scene/small_surface.h"

#include "index/extraction/brick_values.h"
#include "index/surface/mesh_maker.h"

#include <array>
#include <cstddef>
#include <span>

namespace isochron::app {

index::Grid small_grid(bool rectilinear) {
    index::Grid grid{.vertices = {4, 4, 4}};
    if (rectilinear)
        grid.positions[0] = index::AxisPositions({0.0, 1.0, 2.0, 3.0});
    return grid;
}

index::ExtractionPtr small_surface(const index::Grid& grid) {
    constexpr double kIsovalue = 1.5;
    std::array<float, 64> field; // the vertices' third coordinates
    for (std::size_t i = 0; i < field.size(); ++i)
        field[i] = static_cast<float>(i / 16);
    const index::StepValues values{.grid = grid,
                                   .type = index::ValueType::f32,
                                   .scaling = {},
                                   .steps = 1,
                                   .first = std::as_bytes(std::span(field)).data(),
                                   .stride = sizeof(field)};
    auto result = std::make_shared<index::Extraction>();
    result->query.isovalues = {kIsovalue};
    index::CellSet& surface = result->surfaces.emplace_back();
    surface.query = result->query.surface(0);
    surface.ids = {13};
    shade_cells(values, surface);
    auto mesh = std::make_shared<index::CellMesh>();
    index::MeshMaker().make(values, surface.query, surface.ids, *mesh);
    surface.mesh = std::move(mesh);
    const index::BrickValues held(values.type, values.scaling, 0, 3);
    const index::BrickLevels levels = held.levels(result->query.isovalues);
    result->levels = levels.units;
    index::BrickGatherer gatherer(grid, held);
    gatherer.need(surface);
    gatherer.gather(values, 0, levels, result->bricks);
    return result;
}

} // namespace isochron::app
