// Programs, buffers and GL state for drawing meshes.
#include "render/drawing/mesh_pass.h"

#include "index/surface/mesh_cases.h"

#include <algorithm>
#include <limits>

namespace isochron::render {

constexpr GLint kFirstVertices = 1; ///< uniform location in mesh.vert
constexpr GLuint kColors = 1;       ///< attribute of mesh.vert

/// Triangles that are put in order in some milliseconds. More are drawn as they come.
constexpr std::size_t kMostSorted = 1 << 19;

MeshPass::MeshPass(const Gl& gl, const std::string& grid_prelude)
    : gl_(&gl), vertex_array_(gl), no_color_(gl), near_first_(gl), order_(gl) {
    constexpr std::uint32_t kNone = 0;
    gl.NamedBufferData(no_color_.name(), sizeof(kNone), &kNone, GL_STATIC_DRAW);
    gl.EnableVertexArrayAttrib(vertex_array_.name(), kColors);
    for (const Kind kind : {Kind::plain, Kind::colored, Kind::blended})
        for (const Way way : {Way::plain, Way::near, Way::small})
            programs_[static_cast<std::size_t>(kind)][static_cast<std::size_t>(way)].emplace(
                make_program(kind, way, grid_prelude));
    gl.EnableVertexArrayAttrib(vertex_array_.name(), 0);
    gl.VertexArrayAttribIFormat(vertex_array_.name(), 0, 4, GL_UNSIGNED_INT, 0);
    gl.VertexArrayAttribBinding(vertex_array_.name(), 0, 0);
    gl.VertexArrayAttribIFormat(vertex_array_.name(), kColors, 1, GL_UNSIGNED_SHORT, 0);
    gl.VertexArrayAttribBinding(vertex_array_.name(), kColors, kColors);
}

LazyProgram MeshPass::make_program(Kind kind, Way way, const std::string& grid_prelude) const {
    const std::string prelude = grid_prelude + (kind == Kind::plain ? "" : "#define COLORS\n") +
                                (kind == Kind::blended ? "#define BLENDED\n" : "") +
                                (way == Way::near    ? "#define NEAR\n"
                                 : way == Way::small ? "#define LIT_AT_VERTICES\n"
                                                     : "#define SHARP_HIGHLIGHTS\n");
    const std::vector sources{shader_file("mesh.vert"), shader_file("mesh.frag")};
    return LazyProgram(*gl_, sources, prelude);
}

GLuint MeshPass::program(Kind kind, const MeshLook& look) const {
    // The full mesh blends as the exact surface does; a simplified one, which moves, may be faster.
    const bool in_full = look.near || (kind == Kind::blended && look.level == 0);
    const Way way = in_full ? Way::near : look.small ? Way::small : Way::plain;
    return programs_[static_cast<std::size_t>(kind)][static_cast<std::size_t>(way)]->name();
}

/// Finds the first triangle of each cell of the shown set.
void MeshPass::find_cells(const CellBuffers& cells) {
    if (cells_version_ == cells.version())
        return;
    cells_version_ = cells.version();
    first_of_cell_.clear();
    std::uint32_t triangles = 0;
    for (const index::CellMeshPtr& mesh : cells.mesh().meshes())
        for (std::size_t i = 0; mesh && i < mesh->cases.size(); ++i) {
            first_of_cell_.push_back(triangles);
            triangles += index::mesh_cases()[mesh->cases[i]].triangles;
        }
    first_of_cell_.push_back(triangles);
}

/// Which vertices are whose.
void MeshPass::tell_surfaces(GLuint program, const MeshBuffers& mesh) const {
    const auto surfaces = mesh.surfaces();
    for (std::size_t i = 0; i < index::kMostSurfaces; ++i)
        gl_->ProgramUniform1i(program, kFirstVertices + static_cast<GLint>(i),
                              i < surfaces.size() ? static_cast<GLint>(surfaces[i].first_vertex)
                                                  : std::numeric_limits<GLint>::max());
}

void MeshPass::draw_triangles(const MeshBuffers& mesh, GLuint indices, std::size_t first,
                              std::size_t count, std::size_t base) const {
    const GLuint array = vertex_array_.name();
    gl_->VertexArrayVertexBuffer(array, 0, mesh.vertices(), 0, sizeof(index::MeshVertex));
    // Without colors all vertices have the one that is there: for another format of vertices llvmpipe
    // would compile the shaders anew.
    gl_->VertexArrayVertexBuffer(array, kColors,
                                 mesh.colors() != 0 ? mesh.colors() : no_color_.name(), 0,
                                 mesh.colors() != 0 ? sizeof(std::uint16_t) : 0);
    gl_->VertexArrayElementBuffer(array, indices);
    gl_->BindVertexArray(array);
    gl_->DrawElementsBaseVertex(GL_TRIANGLES, static_cast<GLsizei>(count), GL_UNSIGNED_INT,
                                reinterpret_cast<const void*>(first * sizeof(std::uint32_t)),
                                static_cast<GLint>(base));
    gl_->BindVertexArray(0);
}

std::size_t MeshPass::triangles(const CellBuffers& cells, std::size_t level,
                                std::int32_t surfaces) {
    const auto all = cells.mesh(level).surfaces();
    std::size_t count = 0;
    for (std::size_t i = 0; i < all.size(); ++i)
        if ((surfaces >> i & 1) != 0)
            count += all[i].indices / 3;
    return count;
}

/// Puts the triangles of all surfaces in this order.
void MeshPass::put_near_first(const CellBuffers& cells, std::size_t level, PlaneOrder order) {
    if (sorted_version_ == cells.version() && sorted_ == order && sorted_level_ == level)
        return;
    sorted_version_ = cells.version();
    sorted_ = order;
    sorted_level_ = level;
    std::vector<std::uint32_t> corners;
    const std::span<const CellPlace> places = cells.slots().places; // slots are ranks here
    std::size_t before = 0;
    for (const index::CellMeshPtr& mesh : cells.mesh(level).meshes()) {
        if (mesh && level > 0)
            append_in_order(*mesh, order, corners);
        else if (mesh)
            append_in_order(places.subspan(before, mesh->cases.size()), *mesh, order, corners);
        before += mesh ? mesh->cases.size() : 0;
    }
    const std::span<const std::uint32_t> sent = corners;
    gl_->NamedBufferData(near_first_.name(), static_cast<GLsizeiptr>(sent.size_bytes()),
                         sent.data(), GL_STREAM_DRAW);
}

void MeshPass::draw(const CellBuffers& cells, const MeshLook& look, PlaneOrder order,
                    DrawPart part) {
    const MeshBuffers& mesh = cells.mesh(look.level);
    const bool sorted = !order.of_mesh() && mesh.triangles() <= kMostSorted;
    if (sorted)
        put_near_first(cells, look.level, order);
    const GLuint of_look = program(look.colored ? Kind::colored : Kind::plain, look);
    gl_->UseProgram(of_look);
    tell_surfaces(of_look, mesh);
    const GLuint triangles = sorted ? near_first_.name() : mesh.indices();
    const auto surfaces = mesh.surfaces();
    std::size_t before = 0;
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        const auto& [first_vertex, first_index, indices] = surfaces[i];
        if ((look.surfaces >> i & 1) == 0)
            continue;
        const DrawPart cut = part.among(before, indices / 3);
        before += indices / 3;
        if (cut.count == 0)
            continue;
        if (!look.colored)
            gl_->ProgramUniform3f(of_look, 0, look.colors[i].x, look.colors[i].y, look.colors[i].z);
        draw_triangles(mesh, triangles, 3 * (first_index / 3 + cut.first), 3 * cut.count,
                       first_vertex);
    }
}

void MeshPass::draw_blended(const CellBuffers& cells, const MeshLook& look,
                            std::span<const std::uint32_t> back_to_front) {
    find_cells(cells);
    std::vector<std::uint32_t> indices;
    indices.reserve(std::size_t{3} * first_of_cell_.back());
    const MeshBuffers& mesh = cells.mesh();
    const auto surfaces = mesh.surfaces();
    for (const std::uint32_t slot : back_to_front) {
        const std::size_t first = first_of_cell_[slot], end = first_of_cell_[slot + std::size_t{1}];
        const std::size_t surface = cells.slots().places[slot].style & ((1u << kColorShift) - 1);
        if ((look.surfaces >> surface & 1) == 0)
            continue;
        const auto& [first_vertex, first_index, count] = surfaces[surface];
        for (std::size_t k = 3 * first - first_index; k < 3 * end - first_index; ++k)
            indices.push_back(
                static_cast<std::uint32_t>(first_vertex + mesh.meshes()[surface]->triangles[k]));
    }
    draw_blended(mesh, look, indices);
}

void MeshPass::draw_blended(const CellBuffers& cells, const MeshLook& look, const glm::vec4& ahead,
                            DrawPart part) {
    const MeshBuffers& mesh = cells.mesh(look.level);
    std::vector<index::CellMeshPtr> meshes;
    std::vector<std::size_t> first_vertices;
    for (std::size_t i = 0; i < mesh.meshes().size(); ++i)
        if ((look.surfaces >> i & 1) != 0) {
            meshes.push_back(mesh.meshes()[i]);
            first_vertices.push_back(mesh.surfaces()[i].first_vertex);
        }
    const std::vector<std::uint32_t> corners = far_first(meshes, first_vertices, ahead);
    const DrawPart mine = part.among(0, corners.size() / 3);
    draw_blended(mesh, look, std::span(corners).subspan(3 * mine.first, 3 * mine.count));
}

void MeshPass::draw_blended(const MeshBuffers& mesh, const MeshLook& look,
                            std::span<const std::uint32_t> corners) {
    if (corners.empty())
        return;
    gl_->NamedBufferData(order_.name(), static_cast<GLsizeiptr>(corners.size_bytes()),
                         corners.data(), GL_STREAM_DRAW);
    const GLuint of_look = program(Kind::blended, look);
    tell_surfaces(of_look, mesh);
    gl_->UseProgram(of_look);
    draw_triangles(mesh, order_.name(), 0, corners.size(), 0);
}

} // namespace isochron::render
