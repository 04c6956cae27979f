// The sets of cells that a scene holds: for moving pictures, and for pictures at rest.
#include "app/scene/scene.h"

#include "app/scene/small_surface.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <vector>

namespace isochron::app {

/// The buffers for a use, made when they are first needed.
render::CellBuffers& Scene::buffers(Use use) {
    if (use == Use::always)
        return cells_;
    prepare_for_rest();
    return *resting_;
}

void Scene::prepare_for_rest() {
    if (resting_)
        return;
    resting_.emplace(gl_, info_.grid);
    if (sends_whole_)
        resting_->send_whole();
    for (const index::ValueType held : held_types_)
        resting_->prepare(held);
}

void Scene::warm_up(std::span<const render::View> views,
                    const interaction::Similarity& room_from_physical) {
    draw(views, room_from_physical, render::Footprint::quad, std::nullopt);
    const index::Grid grid = small_grid(info_.grid.rectilinear());
    render::CellBuffers cells(gl_, grid, 2 * render::StagingRing::kUnit);
    const index::ExtractionPtr surface = small_surface(grid);
    while (cells.shown() != surface || cells.wants_volume())
        cells.upload(surface, upload_bytes_);
    cells.compute_corners();
    std::vector<render::Footprint> footprints{render::Footprint::quad, render::Footprint::gaussian};
    if (mesh_room_ > 0)
        footprints.push_back(render::Footprint::mesh);
    footprints.push_back(render::Footprint::surface);
    const render::Texture map = render::color_map_texture(gl_, {glm::vec3(1.0f)});
    // In the middle of the volume: as small as its voxels, of many pixels, and as large as on a way
    // through it.
    const auto whole = render::Placement::of(info_.grid, matrix(room_from_physical));
    const glm::vec3 middle = glm::floor(0.5f * whole.extent);
    render::Placement far = render::Placement::of(grid, matrix(room_from_physical));
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
                render::CellAppearance appearance = appearance_;
                appearance.surfaces[0].opacity = opacity;
                appearance.values.reset();
                cell_pass_.draw(views, placement, cells, footprint, appearance);
                if (footprint != render::Footprint::mesh) // has other shaders for colors by value
                    continue;
                appearance.values = {.map = map.name()};
                cell_pass_.draw(views, placement, cells, footprint, appearance);
            }
    }
}

void Scene::upload(const index::ExtractionPtr& newest, render::SendVolume volume, Use use) {
    buffers(use).upload(newest, upload_bytes_, volume);
    if (use == Use::at_rest)
        cells_.upload(nullptr, upload_bytes_, volume); // what was on its way arrives
    else if (resting_)
        resting_->upload(nullptr, upload_bytes_, volume);
}

void Scene::send_whole() {
    sends_whole_ = true;
    cells_.send_whole();
    if (resting_)
        resting_->send_whole();
}

void Scene::draw_at_rest(bool at_rest, const index::SurfacesQuery& surfaces) {
    const index::ExtractionPtr& set = held(Use::at_rest);
    draws_resting_ = at_rest && set && set->query.of_cells() == surfaces;
}

std::string Scene::refusal(const index::ExtractionPtr& set) const {
    if (set && set == cells_.refused())
        return cells_.refusal();
    return set && resting_ && set == resting_->refused() ? resting_->refusal() : std::string();
}

render::UploadCount Scene::uploaded() const {
    render::UploadCount count = cells_.count();
    if (resting_)
        count += resting_->count();
    return count;
}

} // namespace isochron::app
