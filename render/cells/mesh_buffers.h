// The meshes of a set's surfaces on the GPU: the shown ones, and the arriving ones.
#pragma once

#include "index/extraction/extraction.h"
#include "render/gl/gl_objects.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace isochron::render {

/// One buffer with the vertices (index::MeshVertex) of all surfaces in turn, and one with their
/// triangles, whose vertex indices count from the surface's first vertex.
class MeshBuffers {
  public:
    explicit MeshBuffers(const Gl& gl);

    /// Begins with the meshes of a set that is meshed, which lives until `show`; what was on its
    /// way is dropped.
    void begin(const index::Extraction& set);
    /// Sends at most `bytes`. @return bytes sent
    std::size_t send(std::size_t bytes);
    bool complete() const { return sent_ == arriving_.bytes(); }
    /// Makes the new meshes the shown ones.
    void show();

    struct Surface {
        std::size_t first_vertex = 0, first_index = 0, indices = 0;
    };
    /// Of the shown set.
    std::span<const Surface> surfaces() const { return shown_.surfaces; }
    GLuint vertices() const { return shown_.vertices.name(); }
    GLuint indices() const { return shown_.indices.name(); }

  private:
    struct Held {
        explicit Held(const Gl& gl) : vertices(gl), indices(gl) {}
        std::size_t bytes() const { return vertex_bytes + index_bytes; }
        Buffer vertices, indices;
        std::size_t vertex_room = 0, index_room = 0, vertex_bytes = 0, index_bytes = 0;
        std::vector<Surface> surfaces;
    };
    void send_part(GLuint buffer, std::size_t at, std::span<const std::byte> bytes);

    const Gl* gl_;
    Held shown_, arriving_;
    std::vector<std::span<const std::byte>> pieces_; ///< vertices, then indices, of each surface
    std::size_t piece_ = 0, piece_sent_ = 0, sent_ = 0;
};

} // namespace isochron::render
