// Buffers and GL state for drawing ghosts: the shaders are those of meshes, with a map of as many bands
// as there are ghosts.
#include "render/drawing/ghost_pass.h"

#include "render/cells/frame_block.h"
#include "render/drawing/mesh_look.h"
#include "render/gl/gl_memory.h"
#include "render/gl/soft_edges.h"
#include "render/gl/srgb.h"
#include "render/gl/viewport.h"
#include "render/passes/color_map.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>
#include <string>

namespace isochron::render {
namespace {

constexpr GLint kFirstGhostVertices = 1; ///< uniform location in mesh.vert
constexpr GLuint kColorOnMap = 1;        ///< attribute of mesh.vert
constexpr GLuint kMapUnit = 7,
                 kFieldUnit = 9; ///< texture units of appearance.glsl, surroundings.glsl

LazyProgram ghost_program(const Gl& gl, const index::Grid& grid, GhostKind kind, const char* way) {
    const char* const blended = kind == GhostKind::opaque ? "" : "#define BLENDED\n";
    return LazyProgram(gl, {shader_file("mesh.vert"), shader_file("mesh.frag")},
                       prelude_for(grid) + std::string("#define COLORS\n") + blended + way);
}

/// A coordinate of the map for each of some bands.
std::uint16_t band_on_map(std::size_t band, std::size_t bands) {
    constexpr std::size_t kWhole = 65534; // as mesh.vert has it
    return static_cast<std::uint16_t>(bands > 1 ? (kWhole * band + (bands - 1) / 2) / (bands - 1)
                                                : 0);
}

} // namespace

GhostPass::GhostPass(const Gl& gl, const index::Grid& grid, GhostKind kind)
    : gl_(&gl), kind_(kind), near_(ghost_program(gl, grid, kind, "#define NEAR\n")),
      small_(ghost_program(gl, grid, kind, "#define LIT_AT_VERTICES\n")), vertex_array_(gl),
      frame_(gl), vertices_(gl), numbers_(gl), axes_(gl, grid), nothing_around_(gl), orders_(gl) {
    for (int axis = 0; axis < 3; ++axis) {
        const auto along = static_cast<std::size_t>(axis);
        for (std::uint32_t vertex = 0; vertex < grid.vertices[along]; ++vertex)
            places_[along].push_back(static_cast<float>(grid.even_place(axis, vertex)));
    }
    const GLuint array = vertex_array_.name();
    gl.EnableVertexArrayAttrib(array, 0);
    gl.VertexArrayAttribIFormat(array, 0, 4, GL_UNSIGNED_INT, 0);
    gl.VertexArrayAttribBinding(array, 0, 0);
    gl.EnableVertexArrayAttrib(array, kColorOnMap);
    gl.VertexArrayAttribIFormat(array, kColorOnMap, 1, GL_UNSIGNED_SHORT, 0);
    gl.VertexArrayAttribBinding(array, kColorOnMap, kColorOnMap);
}

bool GhostPass::by_values() const {
    return std::ranges::all_of(held_, &GhostMesh::by_values);
}

void GhostPass::hold(std::span<const GhostMesh> ghosts) {
    if (std::ranges::equal(ghosts, held_))
        return;
    const bool same = std::ranges::equal(ghosts, held_, {}, &GhostMesh::mesh, &GhostMesh::mesh);
    const bool by_values_before = by_values();
    held_.assign(ghosts.begin(), ghosts.end());
    if (!same || by_values() != by_values_before)
        send();
    std::vector<glm::vec3> colors;
    for (const GhostMesh& ghost : held_)
        colors.push_back(linear_from_srgb(ghost.color));
    colors_.reset();
    if (!colors.empty())
        colors_.emplace(color_map_texture(*gl_, colors));
}

void GhostPass::send() {
    orders_.clear();
    std::size_t vertices = 0;
    for (const GhostMesh& ghost : held_)
        vertices += ghost.mesh->vertices.size();
    constexpr auto kVertex = sizeof(index::MeshVertex);
    std::vector<std::uint16_t> numbers;
    numbers.reserve(vertices);
    gl_->NamedBufferData(vertices_.name(), static_cast<GLsizeiptr>(vertices * kVertex), nullptr,
                         GL_STREAM_DRAW);
    for (std::size_t i = 0; i < held_.size(); ++i) {
        const auto& own = held_[i].mesh->vertices;
        gl_->NamedBufferSubData(vertices_.name(), static_cast<GLintptr>(numbers.size() * kVertex),
                                static_cast<GLsizeiptr>(own.size() * kVertex), own.data());
        if (const auto& colors = held_[i].mesh->colors; by_values())
            numbers.insert(numbers.end(), colors.begin(), colors.end());
        else
            numbers.insert(numbers.end(), own.size(), band_on_map(i, held_.size()));
    }
    gl_->NamedBufferData(numbers_.name(),
                         static_cast<GLsizeiptr>(numbers.size() * sizeof(std::uint16_t)),
                         numbers.data(), GL_STREAM_DRAW);
    expect_memory(*gl_, "ghosts");
}

const FarOrders::Order& GhostPass::sorted_along(const glm::vec3& ahead,
                                                const Placement& placement) {
    const auto measure = [&](std::vector<float>& distances, std::vector<std::uint32_t>& corners) {
        std::uint32_t before = 0; // vertices of the ghosts before
        for (const GhostMesh& ghost : held_) {
            const auto& vertices = ghost.mesh->vertices;
            const auto& triangles = ghost.mesh->triangles;
            for (std::size_t i = 0; i < triangles.size(); i += 3) {
                const index::MeshVertex& first = vertices[triangles[i]];
                distances.push_back(ahead.x * places_[0][first.x] + ahead.y * places_[1][first.y] +
                                    ahead.z * places_[2][first.z]);
            }
            for (const std::uint32_t corner : triangles)
                corners.push_back(before + corner);
            before += static_cast<std::uint32_t>(vertices.size());
        }
    };
    if (kind_ == GhostKind::opaque) // one order serves for all views
        return orders_.along(glm::vec3(0.0f), 0.0f, 0, measure);
    return orders_.along(ahead, 0.5f * glm::dot(ahead, placement.extent), kMostSorted, measure);
}

/// Which vertices are whose, where each mesh has an opacity of its own.
void GhostPass::tell_meshes(GLuint program) const {
    std::size_t before = 0;
    for (std::size_t i = 0; i < index::kMostSurfaces; ++i) {
        const bool own = i < held_.size() && held_.size() <= index::kMostSurfaces;
        gl_->ProgramUniform1i(program, kFirstGhostVertices + static_cast<GLint>(i),
                              own ? static_cast<GLint>(before) : std::numeric_limits<GLint>::max());
        before += own ? held_[i].mesh->vertices.size() : 0;
    }
}

void GhostPass::draw(const View& view, const Placement& placement, float opacity,
                     const CellAppearance& appearance, TriangleShare share) {
    if (held_.empty() || !(opacity > 0))
        return;
    CellAppearance look = appearance;
    look.surfaces.fill({.opacity = opacity});
    if (held_.size() <= look.surfaces.size())
        for (std::size_t i = 0; i < held_.size(); ++i)
            look.surfaces[i].opacity = opacity * held_[i].opacity;
    if (!by_values() || !look.values)
        look.values = ValueColors{.map = colors_->name(), .bands = true};
    FrameBlock frame = frame_of(look, {}, Footprint::mesh, 1, kind_ == GhostKind::translucent,
                                placement, nothing_around_, false);
    if (kind_ == GhostKind::opaque) // as meshes of cells
        frame.linear_light = 1;
    frame.eyes[0] = eye_block(view, placement, look);
    const FarOrders::Order& order =
        sorted_along(rounded_direction(frame.eyes[0].eye_from_index), placement);
    const auto [first, end] = order.part(share);
    if (first == end)
        return;
    gl_->NamedBufferData(frame_.name(), sizeof(frame), &frame, GL_STREAM_DRAW);
    gl_->BindBufferBase(GL_UNIFORM_BUFFER, 0, frame_.name());
    gl_->BindTextureUnit(kMapUnit, look.values->map);
    gl_->BindTextureUnit(kFieldUnit, nothing_around_.texture());
    axes_.bind();
    set_viewport(*gl_, view);
    const MeshLook size = mesh_look(view, placement, axes_, look);
    const GLuint program = (size.small && !size.near ? small_ : near_).name();
    tell_meshes(program);
    gl_->UseProgram(program);
    if (!frame.linear_light)
        gl_->Disable(GL_FRAMEBUFFER_SRGB);
    gl_->Enable(GL_DEPTH_TEST);
    gl_->DepthFunc(GL_LESS);
    gl_->DepthMask(kind_ == GhostKind::opaque ? GL_TRUE : GL_FALSE);
    gl_->Disable(GL_CULL_FACE);
    if (kind_ == GhostKind::opaque)
        gl_->Disable(GL_BLEND);
    else
        blend_over(*gl_);
    const GLuint array = vertex_array_.name();
    gl_->VertexArrayVertexBuffer(array, 0, vertices_.name(), 0, sizeof(index::MeshVertex));
    gl_->VertexArrayVertexBuffer(array, kColorOnMap, numbers_.name(), 0, sizeof(std::uint16_t));
    gl_->VertexArrayElementBuffer(array, order.corners.name());
    gl_->BindVertexArray(array);
    gl_->DrawElements(GL_TRIANGLES, static_cast<GLsizei>(end - first), GL_UNSIGNED_INT,
                      reinterpret_cast<const void*>(first * sizeof(std::uint32_t)));
    gl_->BindVertexArray(0);
    gl_->Enable(GL_FRAMEBUFFER_SRGB);
    gl_->Disable(GL_BLEND);
    gl_->DepthMask(GL_TRUE);
    gl_->UseProgram(0);
}

} // namespace isochron::render
