// Where a volume stands in the room, as the passes need it.
#pragma once

#include "index/volume/grid.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include <optional>

namespace isochron::render {

struct Placement {
    /// Affine, from even coordinates (see `index::Grid::physical_from_index`), which on a regular
    /// grid are vertex indices. May mirror.
    glm::mat4 room_from_index{1.0f};
    glm::mat3 room_from_physical{1.0f}; ///< linear part
    glm::vec3 extent{1.0f};             ///< the volume spans [0, extent] in even coordinates
    std::optional<index::Grid> rectilinear = {}; ///< the grid, if rectilinear

    bool operator==(const Placement&) const = default;

    /// Mean size of the voxels in the room [m].
    glm::vec3 spacing() const {
        const glm::mat3 axes(room_from_index);
        return {glm::length(axes[0]), glm::length(axes[1]), glm::length(axes[2])};
    }

    /// Transforms planes' normals (of any length) from physical space to the room.
    glm::mat3 room_from_normal() const;
    /// Transforms planes' normals (covectors, of any length) from physical to index space.
    glm::mat3 index_from_normal() const {
        return glm::transpose(glm::inverse(room_from_physical) * glm::mat3(room_from_index));
    }

    /// Vertex index coordinates from even ones.
    glm::vec3 index_at(const glm::vec3& even) const;

    /// Multiplies in double precision, as physical origins may be far away.
    /// @param room_from_physical rotation, scale and translation
    static Placement of(const index::Grid& grid, const glm::dmat4& room_from_physical);
};

} // namespace isochron::render
