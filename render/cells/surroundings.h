// The field of a set's surroundings on the GPU, which darkens what is surrounded.
#pragma once

#include "index/extraction/extraction.h"
#include "render/gl/gl_objects.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <optional>

namespace isochron::render {

/// The fields of all surfaces, one above the other, as GL_TEXTURE_3D. Before the first set it is
/// the field of a surface that nothing surrounds.
class Surroundings {
  public:
    explicit Surroundings(const Gl& gl);

    /// Sends the field of a set that is shown from now on. @return bytes sent
    std::size_t show(const index::SurroundingField& field);

    GLuint texture() const { return texture_->name(); }
    glm::ivec3 size() const { return size_; }      ///< places of a surface; 0: there is no field
    float per_voxel() const { return per_voxel_; } ///< places

  private:
    const Gl* gl_;
    std::optional<Texture> texture_;
    glm::ivec3 held_{0};
    glm::ivec3 size_{0};
    float per_voxel_ = 1.0f;
};

} // namespace isochron::render
