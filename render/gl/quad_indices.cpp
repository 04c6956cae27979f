// Draws many quads by one small index buffer, with another base vertex each time.
#include "render/gl/quad_indices.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace isochron::render {

constexpr std::size_t kQuadsPerDraw = 16384; // limit of 16-bit indices

QuadIndices::QuadIndices(const Gl& gl) : gl_(&gl), vertex_array_(gl), indices_(gl) {
    constexpr std::array<std::uint16_t, 6> kCorners{0, 1, 2, 0, 2, 3};
    std::vector<std::uint16_t> pattern;
    pattern.reserve(kQuadsPerDraw * kCorners.size());
    for (std::size_t quad = 0; quad < kQuadsPerDraw; ++quad)
        for (const std::uint16_t corner : kCorners)
            pattern.push_back(static_cast<std::uint16_t>(4 * quad + corner));
    gl.NamedBufferStorage(indices_.name(), pattern.size() * sizeof(pattern[0]), pattern.data(), 0);
    gl.VertexArrayElementBuffer(vertex_array_.name(), indices_.name());
}

void QuadIndices::draw(std::size_t quads, int instances, std::size_t begin) const {
    gl_->BindVertexArray(vertex_array_.name());
    for (std::size_t first = 0; first < quads; first += kQuadsPerDraw) {
        const std::size_t count = std::min(quads - first, kQuadsPerDraw);
        gl_->DrawElementsInstancedBaseVertex(GL_TRIANGLES, static_cast<GLsizei>(6 * count),
                                             GL_UNSIGNED_SHORT, nullptr, instances,
                                             static_cast<GLint>(4 * (begin + first)));
    }
    gl_->BindVertexArray(0);
}

void QuadIndices::draw_points(std::size_t points, int instances) const {
    gl_->BindVertexArray(vertex_array_.name());
    gl_->DrawArraysInstanced(GL_POINTS, 0, static_cast<GLsizei>(points), instances);
    gl_->BindVertexArray(0);
}

} // namespace isochron::render
