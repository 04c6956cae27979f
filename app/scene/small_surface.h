// A surface in one cell, with all that any footprint needs: to be drawn before there are data.
#pragma once

#include "index/extraction/extraction.h"
#include "index/volume/grid.h"
#include "render/cells/cell_buffers.h"
#include "render/cells/placement.h"
#include "render/drawing/cell_pass.h"
#include "render/gl/gl_objects.h"
#include "render/gl/view.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace isochron::app {

/// A grid of 4^3 vertices. @param rectilinear whether it has positions of its own
index::Grid small_grid(bool rectilinear);

/// A plane through the cell in the middle of this grid, across its third axis: with its point, a
/// mesh and the volume around it.
index::ExtractionPtr small_surface(const index::Grid& grid);

/// Such a surface on the GPU, with which cells are drawn once in every way: with each
/// footprint, opaque and translucent, and in three sizes: as small as voxels in the middle of a
/// volume, many pixels large, and as large as for a viewer inside the volume.
class SmallSurface {
  public:
    struct Way {
        render::Footprint footprint;
        float size; ///< times that of a voxel
        float opacity;
        bool by_value; ///< colored by a map
    };

    /// @param volume of which it stands in the middle @param gl outlives it
    /// @param meshes whether surfaces may have meshes
    SmallSurface(const render::Gl& gl, const index::Grid& volume,
                 const glm::dmat4& room_from_physical, bool meshes);

    std::size_t ways() const { return ways_.size(); }
    const Way& way(std::size_t number) const { return ways_[number]; }
    /// @param way number of one, from 0
    void draw(std::size_t way, render::CellPass& pass, std::span<const render::View> views,
              const render::CellAppearance& configured) const;

  private:
    render::CellBuffers cells_;
    render::Texture map_;
    render::Placement far_;
    glm::vec3 middle_; ///< middle of the volume
    std::vector<Way> ways_;
};

} // namespace isochron::app
