// Projects on the processor, and draws plain quads.
#include "tests/bench/rivals/bare_quads.h"

#include "render/gl/shader.h"
#include "render/gl/soft_edges.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <array>
#include <cmath>
#include <cstdint>

namespace isochron::bench {

namespace {

constexpr std::size_t kMostViews = 2;

const render::ShaderSource kVertex{"bare_quads.vert", R"(#version 450 core
layout(location = 0) in vec3 corner;
void main() { gl_Position = vec4(corner, 1.0); }
)"};
const render::ShaderSource kFragment{"bare_quads.frag", R"(#version 450 core
layout(location = 0) uniform vec4 color;
out vec4 result;
void main() { result = color; }
)"};

} // namespace

std::vector<glm::vec3> projected_corners(const render::View& view,
                                         const render::Placement& placement, float radius,
                                         std::span<const render::CellPlace> places,
                                         std::span<const std::uint32_t> order) {
    const glm::mat4 rows =
        glm::transpose(view.clip_from_eye * view.eye_from_room * placement.room_from_index);
    const glm::vec3 w(rows[3]);
    std::vector<glm::vec3> corners;
    corners.reserve(4 * places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
        const render::CellPlace& cell = places[order.empty() ? i : order[i]];
        const glm::vec4 center(cell.x + 0.5f, cell.y + 0.5f, cell.z + 0.5f, 1.0f);
        const glm::vec4 p = center * rows; // each of them times the center
        const float k = radius * radius / (p.w * p.w - radius * radius * glm::dot(w, w));
        std::array<float, 2> middle{}, half{};
        for (int axis = 0; axis < 2; ++axis) {
            const glm::vec3 a = glm::vec3(rows[axis]) - p[axis] / p.w * w;
            const float shift = -k * glm::dot(a, w);
            middle[axis] = p[axis] / p.w + shift;
            half[axis] = std::sqrt(shift * shift + k * glm::dot(a, a));
        }
        for (const auto& [u, v] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
            corners.emplace_back(middle[0] + static_cast<float>(u) * half[0],
                                 middle[1] + static_cast<float>(v) * half[1], p.z / p.w);
    }
    return corners;
}

BareQuads::BareQuads(const render::Gl& gl)
    : gl_(&gl), program_(render::link_program(gl, {kVertex, kFragment})), indices_(gl) {
    for (std::size_t i = 0; i < kMostViews; ++i) {
        const OfView& of_view = views_.emplace_back(gl);
        const GLuint array = of_view.array.name();
        gl.EnableVertexArrayAttrib(array, 0);
        gl.VertexArrayAttribFormat(array, 0, 3, GL_FLOAT, GL_FALSE, 0);
        gl.VertexArrayAttribBinding(array, 0, 0);
        gl.VertexArrayVertexBuffer(array, 0, of_view.corners.name(), 0, sizeof(glm::vec3));
        gl.VertexArrayElementBuffer(array, indices_.name());
    }
}

void BareQuads::set(std::size_t view, const std::vector<glm::vec3>& corners) {
    OfView& of_view = views_.at(view);
    std::vector<std::uint32_t> indices;
    for (std::uint32_t first = 0; first < corners.size(); first += 4)
        for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u})
            indices.push_back(first + corner);
    of_view.indices = static_cast<GLsizei>(indices.size());
    gl_->NamedBufferData(of_view.corners.name(), corners.size() * sizeof(corners[0]),
                         corners.data(), GL_STATIC_DRAW);
    gl_->NamedBufferData(indices_.name(), indices.size() * sizeof(indices[0]), indices.data(),
                         GL_STATIC_DRAW);
}

void BareQuads::draw(std::span<const render::View> views, bool blended) const {
    gl_->Enable(GL_DEPTH_TEST);
    gl_->DepthFunc(GL_LESS);
    gl_->DepthMask(blended ? GL_FALSE : GL_TRUE);
    if (blended) {
        render::blend_over(*gl_);
        gl_->ProgramUniform4f(program_.name(), 0, 0.2f, 0.2f, 0.15f, 0.25f);
    } else {
        gl_->Disable(GL_BLEND);
        gl_->ProgramUniform4f(program_.name(), 0, 0.8f, 0.8f, 0.6f, 1.0f);
    }
    gl_->UseProgram(program_.name());
    for (std::size_t i = 0; i < views.size(); ++i) {
        const render::View& view = views[i];
        gl_->Viewport(view.corner.x, view.corner.y, view.size.x, view.size.y);
        gl_->BindVertexArray(views_[i].array.name());
        gl_->DrawElements(GL_TRIANGLES, views_[i].indices, GL_UNSIGNED_INT, nullptr);
    }
    gl_->BindVertexArray(0);
    gl_->UseProgram(0);
    gl_->Disable(GL_BLEND);
    gl_->DepthMask(GL_TRUE);
}

} // namespace isochron::bench
