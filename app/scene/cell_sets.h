// The sets of cells that a scene holds: for moving pictures, and for pictures at rest.
//
//     sets.upload(newest, render::SendVolume::with_cells, CellSets::Use::at_rest);   // every frame
//     sets.draw_at_rest(rests, surfaces);
//     draw(sets.drawn());
#pragma once

#include "app/config/config.h"
#include "app/scene/picture.h"
#include "index/extraction/extraction.h"
#include "index/volume/volume_series.h"
#include "render/cells/cell_buffers.h"
#include "render/cells/footprints.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

/// There may be two sets: one for moving pictures, and one with more detail for pictures at rest,
/// which is drawn only if `draw_at_rest` says so. The one for moving pictures stays, so that it can
/// be drawn at once when something moves.
class CellSets {
  public:
    enum class Use : std::uint8_t { always, at_rest };

    /// @param gl outlives the sets
    CellSets(const render::Gl& gl, const index::Grid& grid, const Config& config);

    /// Makes ready for an array of values. Call it before the first frame.
    void prepare_for(const index::SeriesInfo& array);
    /// Makes ready for a resting set ahead of time, as this takes longer than a frame may.
    void prepare_for_rest();

    /// Uploads the newest set to the GPU, at most the configured number of bytes per call; shows it
    /// when it is complete.
    void upload(const index::ExtractionPtr& newest,
                render::SendVolume volume = render::SendVolume::with_cells, Use use = Use::always);
    /// Pictures do not depend on earlier sets from now on: see render::CellBuffers::send_whole.
    void send_whole();
    /// Uploads a set without showing it; a later `upload` of the same set shows it.
    /// @return true when it is completely on the GPU
    bool stage(const index::ExtractionPtr& set, Use use = Use::always) {
        return buffers(use).stage(set, upload_bytes_);
    }
    render::UploadCount uploaded() const;
    /// Why this set cannot be shown; empty if it can.
    std::string refusal(const index::ExtractionPtr& set) const;

    /// Chooses the set that is drawn from now on: the set for pictures at rest if `at_rest` is true
    /// and it shows these surfaces, otherwise the set for moving pictures.
    void draw_at_rest(bool at_rest, const index::SurfacesQuery& surfaces);
    bool draws_at_rest() const { return draws_resting_; }
    /// The set that is drawn.
    const index::ExtractionPtr& shown() const { return drawn().shown(); }
    const render::CellBuffers& drawn() const { return draws_resting_ ? *resting_ : cells_; }
    /// As render::CellBuffers, for the set that is drawn.
    void compute_corners() { (draws_resting_ ? *resting_ : cells_).compute_corners(); }
    std::size_t compute_corners(std::size_t most) {
        return (draws_resting_ ? *resting_ : cells_).compute_corners(most);
    }
    /// The set for this use, drawn or not; null if there is none.
    const index::ExtractionPtr& held(Use use) const;
    /// Whether nothing more is uploaded for the shown cells: their volume is there, or too large.
    bool is_complete() const { return !drawn().wants_volume(); }
    /// Whether nothing more is uploaded for the set of this use, drawn or not; also where there is
    /// none.
    bool is_complete(Use use) const;

    /// The footprints that the shown cells can be drawn with: a very large set has no room for its
    /// surface, and on a GPU cells have no mesh.
    render::FootprintSet footprints() const;
    /// How a picture's footprint is drawn: another process may have chosen one that the shown cells do
    /// not have here yet.
    render::Footprint footprint_for(const Picture& picture) const;
    /// The footprints that the shown cells can be drawn with, and `mesh` if cells that were asked
    /// for with a mesh could be drawn so.
    render::FootprintSet possible_footprints() const;
    /// Triangles of the meshes of the set for a use, by mesh level; 0 where it has none on the GPU.
    std::array<std::size_t, index::kMeshLevels> triangles(Use use) const;
    std::size_t surface_limit() const { return cells_.corner_limit(); } ///< cells
    bool may_have_meshes() const { return mesh_room_ > 0; }
    bool has_fences() const { return cells_.has_fences(); } ///< as render::CellBuffers

  private:
    render::CellBuffers& buffers(Use use);

    const render::Gl& gl_;
    const index::Grid grid_;
    std::vector<index::ValueType> held_types_;   ///< types of the values in blocks, of all arrays
    const std::size_t upload_bytes_;             ///< per frame
    const std::uint64_t mesh_room_;              ///< 0: no set comes with a mesh
    render::CellBuffers cells_;                  ///< for Use::always
    std::optional<render::CellBuffers> resting_; ///< for Use::at_rest
    bool draws_resting_ = false, sends_whole_ = false;
};

} // namespace isochron::app
