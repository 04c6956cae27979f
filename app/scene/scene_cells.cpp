// The sets of cells that a scene holds: for moving pictures, and for pictures at rest.
#include "app/scene/scene.h"

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
