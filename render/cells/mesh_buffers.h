// The meshes of a set's surfaces on the GPU: the shown ones, and the arriving ones.
#pragma once

#include "index/extraction/extraction.h"
#include "render/gl/gl_objects.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace isochron::render {

/// One buffer with the vertices (index::MeshVertex) of all surfaces in turn, one with their colors
/// if they have some, and one with their triangles, whose vertex indices count from the surface's
/// first vertex.
class MeshBuffers {
  public:
    explicit MeshBuffers(const Gl& gl);

    /// Begins with meshes, by surface; null: it has no cells. What was on its way is dropped.
    void begin(std::vector<index::CellMeshPtr> meshes);
    /// Sends at most `bytes`. @return bytes sent
    std::size_t send(std::size_t bytes);
    bool complete() const { return sent_ == arriving_.bytes(); }
    /// Makes the new meshes the shown ones.
    void show();

    struct Surface {
        std::size_t first_vertex = 0, first_index = 0, indices = 0;
    };
    /// Surfaces of the shown set.
    std::span<const Surface> surfaces() const { return shown_.surfaces; }
    /// What is shown, by surface.
    std::span<const index::CellMeshPtr> meshes() const { return shown_.meshes; }
    std::size_t triangles() const { return shown_.index_bytes / sizeof(std::uint32_t) / 3; }
    GLuint vertices() const { return shown_.vertices.name(); }
    GLuint indices() const { return shown_.indices.name(); }
    /// Colors of the vertices, 16 bits each (CellMesh::colors); 0 if they have none.
    GLuint colors() const { return shown_.color_bytes > 0 ? shown_.colors.name() : 0; }

  private:
    struct Held {
        explicit Held(const Gl& gl) : vertices(gl), colors(gl), indices(gl) {}
        std::size_t bytes() const { return vertex_bytes + color_bytes + index_bytes; }
        Buffer vertices, colors, indices;
        std::size_t vertex_room = 0, color_room = 0, index_room = 0;
        std::size_t vertex_bytes = 0, color_bytes = 0, index_bytes = 0;
        std::vector<Surface> surfaces;
        std::vector<index::CellMeshPtr> meshes;
    };
    void send_part(GLuint buffer, std::size_t at, std::span<const std::byte> bytes);

    const Gl* gl_;
    Held shown_, arriving_;
    /// Vertices of each surface, then the colors of each, then the indices.
    std::vector<std::span<const std::byte>> pieces_;
    std::size_t piece_ = 0, piece_sent_ = 0, sent_ = 0;
};

} // namespace isochron::render
