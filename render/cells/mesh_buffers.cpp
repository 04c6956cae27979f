// Sends meshes to the GPU in portions.
#include "render/cells/mesh_buffers.h"

#include "render/gl/gl_memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace isochron::render {
namespace {

/// Allocates half as much more than needed, so that slowly growing meshes rarely need a new buffer.
void fit(const Gl& gl, const Buffer& buffer, std::size_t bytes, std::size_t& room) {
    if (bytes <= room)
        return;
    room = 0; // until there is memory for it
    const std::size_t wanted = bytes + bytes / 2;
    gl.NamedBufferData(buffer.name(), static_cast<GLsizeiptr>(wanted), nullptr, GL_DYNAMIC_DRAW);
    expect_memory(gl, fmt::format("a mesh of {} bytes", bytes));
    room = wanted;
}

} // namespace

MeshBuffers::MeshBuffers(const Gl& gl) : gl_(&gl), shown_(gl), arriving_(gl) {}

void MeshBuffers::begin(std::vector<index::CellMeshPtr> meshes) {
    arriving_.surfaces.clear();
    pieces_.clear();
    std::size_t vertices = 0, indices = 0, colors = 0;
    for (const index::CellMeshPtr& mesh : meshes) {
        const std::size_t own = mesh ? mesh->triangles.size() : 0;
        arriving_.surfaces.push_back({vertices, indices, own});
        vertices += mesh ? mesh->vertices.size() : 0;
        colors += mesh ? mesh->colors.size() : 0;
        indices += own;
    }
    for (const index::CellMeshPtr& mesh : meshes)
        if (mesh)
            pieces_.push_back(std::as_bytes(std::span(mesh->vertices)));
    for (const index::CellMeshPtr& mesh : meshes)
        if (mesh)
            pieces_.push_back(std::as_bytes(std::span(mesh->colors)));
    for (const index::CellMeshPtr& mesh : meshes)
        if (mesh)
            pieces_.push_back(std::as_bytes(std::span(mesh->triangles)));
    arriving_.meshes = std::move(meshes);
    arriving_.vertex_bytes = vertices * sizeof(index::MeshVertex);
    arriving_.color_bytes = colors * sizeof(std::uint16_t);
    arriving_.index_bytes = indices * sizeof(std::uint32_t);
    fit(*gl_, arriving_.vertices, arriving_.vertex_bytes, arriving_.vertex_room);
    fit(*gl_, arriving_.colors, arriving_.color_bytes, arriving_.color_room);
    fit(*gl_, arriving_.indices, arriving_.index_bytes, arriving_.index_room);
    piece_ = piece_sent_ = sent_ = 0;
}

void MeshBuffers::send_part(GLuint buffer, std::size_t at, std::span<const std::byte> bytes) {
    gl_->NamedBufferSubData(buffer, static_cast<GLintptr>(at),
                            static_cast<GLsizeiptr>(bytes.size()), bytes.data());
}

std::size_t MeshBuffers::send(std::size_t bytes) {
    std::size_t sent = 0;
    while (sent < bytes && !complete()) {
        const auto rest = pieces_[piece_].subspan(piece_sent_);
        const auto part = rest.first(std::min(rest.size(), bytes - sent));
        const std::size_t colors = arriving_.vertex_bytes, indices = colors + arriving_.color_bytes;
        if (sent_ < colors)
            send_part(arriving_.vertices.name(), sent_, part);
        else if (sent_ < indices)
            send_part(arriving_.colors.name(), sent_ - colors, part);
        else
            send_part(arriving_.indices.name(), sent_ - indices, part);
        sent += part.size();
        sent_ += part.size();
        piece_sent_ += part.size();
        if (part.size() == rest.size()) {
            ++piece_;
            piece_sent_ = 0;
        }
    }
    return sent;
}

void MeshBuffers::show() {
    std::swap(shown_, arriving_);
    pieces_.clear();
    arriving_.surfaces.clear();
    arriving_.meshes.clear();
    arriving_.vertex_bytes = arriving_.color_bytes = arriving_.index_bytes = sent_ = 0;
}

} // namespace isochron::render
