// Buffers and GL state for drawing triangles beside the cells.
#include "render/drawing/triangle_pass.h"

#include "render/cells/axis_table.h"
#include "render/cells/frame_block.h"
#include "render/gl/soft_edges.h"
#include "render/gl/srgb.h"
#include "render/gl/viewport.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <string>
#include <utility>

namespace isochron::render {
namespace {

constexpr GLint kIndexFromMesh = 0, kColor = 4; ///< uniform locations in triangles.vert and .frag

LazyProgram triangle_program(const Gl& gl, const index::Grid& grid, bool blended, bool lines) {
    return LazyProgram(gl, {shader_file("triangles.vert"), shader_file("triangles.frag")},
                       std::string(prelude_for(grid)) + (blended ? "#define BLENDED\n" : "") +
                           (lines ? "#define EDGES\n" : ""));
}

template <class T>
void send_all(const Gl& gl, const Buffer& buffer, const std::vector<T>& values, GLenum usage) {
    const std::span<const T> sent = values;
    gl.NamedBufferData(buffer.name(), static_cast<GLsizeiptr>(sent.size_bytes()), sent.data(),
                       usage);
}

} // namespace

TrianglePass::TrianglePass(const Gl& gl, const index::Grid& grid)
    : gl_(&gl), grid_(grid),
      programs_{triangle_program(gl, grid, false, false), triangle_program(gl, grid, true, false),
                triangle_program(gl, grid, false, true), triangle_program(gl, grid, true, true)},
      vertex_array_(gl), frame_(gl), no_normal_(gl), nothing_around_(gl) {
    constexpr glm::vec3 kNone(0.0f);
    gl.NamedBufferData(no_normal_.name(), sizeof(kNone), &kNone, GL_STATIC_DRAW);
    for (const GLuint attribute : {0u, 1u}) {
        gl.EnableVertexArrayAttrib(vertex_array_.name(), attribute);
        gl.VertexArrayAttribFormat(vertex_array_.name(), attribute, 3, GL_FLOAT, GL_FALSE, 0);
        gl.VertexArrayAttribBinding(vertex_array_.name(), attribute, attribute);
    }
}

void TrianglePass::hold(std::span<const index::TriangleMeshPtr> meshes) {
    std::erase_if(held_, [&](const Held& held) {
        return std::ranges::find(meshes, held.mesh) == meshes.end();
    });
    for (const index::TriangleMeshPtr& mesh : meshes) {
        if (!mesh || mesh->corners.empty() ||
            std::ranges::find(held_, mesh, &Held::mesh) != held_.end())
            continue;
        Held held{mesh, Buffer(*gl_), Buffer(*gl_), Buffer(*gl_), Buffer(*gl_), FarOrders(*gl_)};
        send_all(*gl_, held.points, mesh->points, GL_STATIC_DRAW);
        if (!mesh->normals.empty())
            send_all(*gl_, held.normals, mesh->normals, GL_STATIC_DRAW);
        send_all(*gl_, held.corners, mesh->corners, GL_STATIC_DRAW);
        held_.push_back(std::move(held));
    }
}

void TrianglePass::send_edges(Held& held) const {
    if (std::exchange(held.has_edges, true))
        return;
    const std::vector<std::uint32_t>& corners = held.mesh->corners;
    std::vector<std::uint32_t> edges;
    edges.reserve(2 * corners.size());
    for (std::size_t i = 0; i < corners.size(); i += 3)
        edges.insert(edges.end(), {corners[i], corners[i + 1], corners[i + 1], corners[i + 2],
                                   corners[i + 2], corners[i]});
    send_all(*gl_, held.edges, edges, GL_STATIC_DRAW);
}

void TrianglePass::draw(const View& view, const Placement& placement,
                        const index::TriangleMesh& mesh, const TriangleLook& look,
                        const CellAppearance& appearance, TriangleShare share) {
    const auto held =
        std::ranges::find(held_, &mesh, [](const Held& each) { return each.mesh.get(); });
    if (held == held_.end() || !(look.opacity > 0))
        return;
    const bool blended = look.opacity < 1;
    FrameBlock frame =
        frame_of(appearance, {}, Footprint::mesh, 0, blended, placement, nothing_around_, false);
    frame.eyes[0] = eye_block(view, placement, appearance);
    if (!blended) // the target converts faster than the shader
        frame.linear_light = 1;
    const glm::mat4 index_from_mesh(
        glm::translate(glm::inverse(grid_.physical_from_index()), mesh.origin));
    const FarOrders::Order* sorted = nullptr;
    std::array<std::size_t, 2> part{0, mesh.corners.size()};
    if (blended && !look.lines) {
        const glm::vec3 ahead = rounded_direction(frame.eyes[0].eye_from_index);
        const glm::vec4 along = glm::vec4(ahead, 0.0f) * index_from_mesh;
        sorted = &held->orders.along(
            ahead, 0.5f * glm::dot(ahead, placement.extent), kMostSorted,
            [&](std::vector<float>& distances, std::vector<std::uint32_t>& corners) {
                corners = mesh.corners;
                for (std::size_t i = 0; i < corners.size(); i += 3)
                    distances.push_back(glm::dot(along, glm::vec4(mesh.points[corners[i]], 1.0f)));
            });
        part = sorted->part(share);
        if (part[0] == part[1])
            return;
    } else if (share == TriangleShare::beyond) {
        return; // lines come at once
    }
    gl_->NamedBufferData(frame_.name(), sizeof(frame), &frame, GL_STREAM_DRAW);
    gl_->BindBufferBase(GL_UNIFORM_BUFFER, 0, frame_.name());
    const GLuint program = programs_[(blended ? 1u : 0u) + (look.lines ? 2u : 0u)].name();
    gl_->ProgramUniformMatrix4fv(program, kIndexFromMesh, 1, GL_FALSE, &index_from_mesh[0][0]);
    const glm::vec3 color = linear_from_srgb(look.color);
    gl_->ProgramUniform4f(program, kColor, color.x, color.y, color.z, look.opacity);
    set_viewport(*gl_, view);
    gl_->UseProgram(program);
    if (frame.linear_light == 0)
        gl_->Disable(GL_FRAMEBUFFER_SRGB);
    gl_->Enable(GL_DEPTH_TEST);
    gl_->DepthFunc(GL_LESS);
    gl_->DepthMask(blended ? GL_FALSE : GL_TRUE);
    gl_->Disable(GL_CULL_FACE);
    if (blended)
        blend_over(*gl_);
    else
        gl_->Disable(GL_BLEND);
    if (look.lines) {
        send_edges(*held);
        draw_elements(*held, true, held->edges.name(), {0, 2 * mesh.corners.size()});
    } else {
        draw_elements(*held, false, (sorted ? sorted->corners : held->corners).name(), part);
    }
    gl_->Enable(GL_FRAMEBUFFER_SRGB);
    gl_->Disable(GL_BLEND);
    gl_->DepthMask(GL_TRUE);
    gl_->UseProgram(0);
}

void TrianglePass::draw_elements(const Held& held, bool lines, GLuint corners,
                                 std::array<std::size_t, 2> part) const {
    const GLuint array = vertex_array_.name();
    const bool lit = !held.mesh->normals.empty();
    gl_->VertexArrayVertexBuffer(array, 0, held.points.name(), 0, sizeof(glm::vec3));
    gl_->VertexArrayVertexBuffer(array, 1, lit ? held.normals.name() : no_normal_.name(), 0,
                                 lit ? sizeof(glm::vec3) : 0);
    gl_->VertexArrayElementBuffer(array, corners);
    gl_->BindVertexArray(array);
    gl_->DrawElements(lines ? GL_LINES : GL_TRIANGLES, static_cast<GLsizei>(part[1] - part[0]),
                      GL_UNSIGNED_INT,
                      reinterpret_cast<const void*>(part[0] * sizeof(std::uint32_t)));
    gl_->BindVertexArray(0);
}

} // namespace isochron::render
