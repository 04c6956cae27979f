// A surface in one cell, with all that any footprint needs.
#include "app/scene/small_surface.h"

#include "index/extraction/block_values.h"
#include "index/surface/mesh_maker.h"
#include "render/passes/color_map.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>

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
    gatherer.gather(values, index::Instant(0), levels, result->blocks);
    return result;
}

SmallSurface::SmallSurface(const render::Gl& gl, const index::Grid& volume,
                           const glm::dmat4& room_from_physical, bool meshes)
    : cells_(gl, small_grid(volume.rectilinear()), 2 * render::StagingRing::kUnit),
      map_(render::color_map_texture(gl, {glm::vec3(1.0f)})),
      far_(render::Placement::of(small_grid(volume.rectilinear()), room_from_physical)) {
    constexpr std::size_t kBytes = 1 << 20; // more than it has
    const index::ExtractionPtr surface = small_surface(small_grid(volume.rectilinear()));
    while (cells_.shown() != surface || cells_.wants_volume())
        cells_.upload(surface, kBytes);
    cells_.compute_corners();
    const auto whole = render::Placement::of(volume, room_from_physical);
    middle_ = glm::floor(0.5f * whole.extent);
    far_.room_from_index = whole.room_from_index;
    constexpr float kManyPixels = 0.045f; // [m] a voxel in the middle
    std::vector<render::Footprint> footprints{render::Footprint::quad, render::Footprint::gaussian};
    if (meshes)
        footprints.push_back(render::Footprint::mesh);
    footprints.push_back(render::Footprint::surface);
    for (const float size : {1.0f, std::max(kManyPixels / whole.spacing().x, 1.0f),
                             std::max(0.7f * whole.extent.x, 1.0f)})
        for (const render::Footprint footprint : footprints)
            for (const float opacity : {1.0f, 0.5f}) {
                if ((opacity < 1 && !render::has_layers(footprint)) ||
                    // Surfaces are drawn alike at any size.
                    (size > 1 && footprint == render::Footprint::surface))
                    continue;
                ways_.push_back({footprint, size, opacity, false});
                if (render::has_layers(footprint)) // which have other shaders for colors by value
                    ways_.push_back({footprint, size, opacity, true});
            }
}

void SmallSurface::draw(std::size_t way, render::CellPass& pass,
                        std::span<const render::View> views,
                        const render::CellAppearance& configured) const {
    const Way& how = ways_.at(way);
    render::Placement placement = far_;
    placement.room_from_index = glm::translate(far_.room_from_index, middle_) *
                                glm::scale(glm::mat4(1.0f), glm::vec3(how.size)) *
                                glm::translate(glm::mat4(1.0f), -0.5f * far_.extent);
    render::CellAppearance appearance = configured;
    appearance.surfaces[0].opacity = how.opacity;
    appearance.values.reset();
    if (how.by_value)
        appearance.values = {.map = map_.name()};
    pass.draw(views, placement, cells_, how.footprint, appearance);
}

} // namespace isochron::app
