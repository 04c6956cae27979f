// The sets of cells that a scene holds: for moving pictures, and for pictures at rest.
#include "app/scene/cell_sets.h"

#include "index/extraction/block_values.h"
#include "index/surface/cell_mesh.h"

namespace isochron::app {

CellSets::CellSets(const render::Gl& gl, const index::Grid& grid, const Config& config)
    : gl_(gl), grid_(grid),
      upload_bytes_(std::size_t{1024} * config.rendering.upload_kilobytes_per_frame),
      mesh_room_(render::CellBuffers::wanted_shading(gl) == index::Shading::none
                     ? 0
                     : config.memory.mesh_room()),
      cells_(gl, grid_) {}

void CellSets::prepare_for(const index::SeriesInfo& array) {
    // The storage of values depends only on their type, not on their range.
    held_types_.push_back(index::BlockValues(array.type, array.scaling, 0, 1).held());
    cells_.prepare(held_types_.back());
}

/// The buffers for a use, made when they are first needed.
render::CellBuffers& CellSets::buffers(Use use) {
    if (use == Use::always)
        return cells_;
    prepare_for_rest();
    return *resting_;
}

void CellSets::prepare_for_rest() {
    if (resting_)
        return;
    resting_.emplace(gl_, grid_);
    if (sends_whole_)
        resting_->send_whole();
    for (const index::ValueType held : held_types_)
        resting_->prepare(held);
}

void CellSets::upload(const index::ExtractionPtr& newest, render::SendVolume volume, Use use) {
    buffers(use).upload(newest, upload_bytes_, volume);
    if (use == Use::at_rest)
        cells_.upload(nullptr, upload_bytes_, volume); // what was on its way arrives
    else if (resting_)
        resting_->upload(nullptr, upload_bytes_, volume);
}

void CellSets::send_whole() {
    sends_whole_ = true;
    cells_.send_whole();
    if (resting_)
        resting_->send_whole();
}

void CellSets::draw_at_rest(bool at_rest, const index::SurfacesQuery& surfaces) {
    const index::ExtractionPtr& set = held(Use::at_rest);
    draws_resting_ = at_rest && set && set->query.of_cells() == surfaces;
}

std::string CellSets::refusal(const index::ExtractionPtr& set) const {
    if (set && set == cells_.refused())
        return cells_.refusal();
    return set && resting_ && set == resting_->refused() ? resting_->refusal() : std::string();
}

const index::ExtractionPtr& CellSets::held(Use use) const {
    static const index::ExtractionPtr none;
    return use == Use::always ? cells_.shown() : resting_ ? resting_->shown() : none;
}

bool CellSets::is_complete(Use use) const {
    const render::CellBuffers* sets = use == Use::always ? &cells_
                                      : resting_         ? &*resting_
                                                         : nullptr;
    return !sets || !sets->shown() || !sets->wants_volume();
}

render::FootprintSet CellSets::footprints() const {
    auto footprints = render::FootprintSet::up_to(render::Footprint::gaussian);
    if (drawn().has_mesh())
        footprints.add(render::Footprint::mesh);
    if (drawn().has_volume() && drawn().size() <= drawn().corner_limit())
        footprints.add(render::Footprint::surface);
    return footprints;
}

render::Footprint CellSets::footprint_for(const Picture& picture) const {
    if (picture.footprint != render::Footprint::mesh || picture.mesh_level == 0)
        return footprints().best(picture.footprint);
    return drawn().has_mesh(picture.mesh_level) ? render::Footprint::mesh : render::Footprint::quad;
}

std::array<std::size_t, index::kMeshLevels> CellSets::triangles(Use use) const {
    std::array<std::size_t, index::kMeshLevels> triangles{};
    const render::CellBuffers* buffers = use == Use::always ? &cells_
                                         : resting_         ? &*resting_
                                                            : nullptr;
    for (std::size_t level = 0; buffers && level < triangles.size(); ++level)
        triangles[level] = buffers->has_mesh(level) ? buffers->mesh(level).triangles() : 0;
    return triangles;
}

render::FootprintSet CellSets::possible_footprints() const {
    render::FootprintSet possible = footprints();
    const index::ExtractionPtr& set = shown();
    const bool asked = set && set->query.mesh_room > 0;
    if (set && !asked && !set->coarse() && index::least_mesh_bytes(set->cells()) <= mesh_room_)
        possible.add(render::Footprint::mesh);
    return possible;
}

render::UploadCount CellSets::uploaded() const {
    render::UploadCount count = cells_.count();
    if (resting_)
        count += resting_->count();
    return count;
}

} // namespace isochron::app
