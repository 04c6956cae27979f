// The sets of cells that a scene holds: for moving pictures, and for pictures at rest.
#include "app/scene/scene.h"

#include "index/extraction/cell_plane.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cstdint>

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
    const auto far = render::Placement::of(info_.grid, matrix(room_from_physical));
    const glm::vec3 middle = glm::floor(0.5f * far.extent);
    render::Placement near = far; // as large as on a way through the volume
    near.room_from_index =
        glm::translate(far.room_from_index, middle) *
        glm::scale(glm::mat4(1.0f), glm::vec3(std::max(0.7f * far.extent.x, 1.0f))) *
        glm::translate(glm::mat4(1.0f), -middle - 0.5f);
    const auto at = [&](int axis) { return static_cast<std::uint16_t>(middle[axis]); };
    const index::CellPoint cell{at(0), at(1), at(2), 0, index::pack({{0.0, 0.0, 1.0}, 0.0})};
    const auto one = render::CellBuffers::of_points(gl_, std::span(&cell, 1), info_.grid);
    for (const render::Placement& placement : {far, near})
        for (const auto footprint : {render::Footprint::quad, render::Footprint::gaussian})
            cell_pass_.draw(views, placement, one, footprint, appearance_);
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
