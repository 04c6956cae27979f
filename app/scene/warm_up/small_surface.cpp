// A surface in one cell, with all that any footprint needs.
#include "app/scene/warm_up/small_surface.h"

#include "index/extraction/block_values.h"
#include "index/surface/mesh_maker.h"
#include "render/passes/color_map.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
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
    mesh->colors.resize(mesh->vertices.size());
    surface.mesh = std::move(mesh);
    result->corner_colors.resize(8);
    const index::BlockValues held(values.type, values.scaling, 0, 3);
    const index::BlockLevels levels = held.levels(result->query.isovalues);
    result->levels = levels.units;
    index::BlockGatherer gatherer(grid, held);
    gatherer.need(surface);
    gatherer.gather(values, 0, levels, result->blocks);
    return result;
}

void draw_small_surface(const render::Gl& gl, render::CellPass& pass,
                        std::span<const render::View> views, const index::Grid& volume,
                        const glm::dmat4& room_from_physical,
                        std::span<const render::Footprint> footprints,
                        const render::CellAppearance& configured) {
    constexpr std::size_t kBytes = 1 << 20; // more than it has
    const index::Grid grid = small_grid(volume.rectilinear());
    render::CellBuffers cells(gl, grid, 2 * render::StagingRing::kUnit);
    const index::ExtractionPtr surface = small_surface(grid);
    while (cells.shown() != surface || cells.wants_volume())
        cells.upload(surface, kBytes);
    cells.compute_corners();
    const render::Texture map = render::color_map_texture(gl, {glm::vec3(1.0f)});
    const auto whole = render::Placement::of(volume, room_from_physical);
    const glm::vec3 middle = glm::floor(0.5f * whole.extent);
    render::Placement far = render::Placement::of(grid, room_from_physical);
    far.room_from_index = whole.room_from_index;
    constexpr float kManyPixels = 0.045f; // [m] a voxel in the middle
    for (const float size : {1.0f, std::max(kManyPixels / whole.spacing().x, 1.0f),
                             std::max(0.7f * whole.extent.x, 1.0f)}) {
        render::Placement placement = far;
        placement.room_from_index = glm::translate(far.room_from_index, middle) *
                                    glm::scale(glm::mat4(1.0f), glm::vec3(size)) *
                                    glm::translate(glm::mat4(1.0f), -0.5f * far.extent);
        for (const render::Footprint footprint : footprints)
            for (const float opacity : {1.0f, 0.5f}) {
                if ((opacity < 1 && !render::has_layers(footprint)) ||
                    (size > 1 && footprint == render::Footprint::surface)) // the same at any size
                    continue;
                render::CellAppearance appearance = configured;
                appearance.surfaces[0].opacity = opacity;
                appearance.values.reset();
                pass.draw(views, placement, cells, footprint, appearance);
                if (!render::has_layers(footprint)) // which have other shaders for colors by value
                    continue;
                appearance.values = {.map = map.name()};
                pass.draw(views, placement, cells, footprint, appearance);
            }
    }
}

} // namespace isochron::app
