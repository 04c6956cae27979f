// Programs, buffers and GL state for drawing meshes.
#include "render/drawing/mesh_pass.h"

#include "index/surface/mesh_cases.h"
#include "render/gl/shader.h"

#include <algorithm>
#include <limits>
#include <string>

namespace isochron::render {

constexpr GLuint kStylesUnit = 8; ///< of mesh.frag

constexpr GLint kFirstVertices = 1; ///< of mesh.vert

/// Cells whose triangles are put in order in some milliseconds. More are drawn as they come.
constexpr std::size_t kMostSorted = 1 << 18;

MeshPass::MeshPass(const Gl& gl, const std::string& grid_prelude)
    : gl_(&gl), vertex_array_(gl), styles_(gl), near_first_(gl), order_(gl) {
    for (const Kind kind : {Kind::plain, Kind::styled, Kind::blended})
        for (const Way way : {Way::plain, Way::near, Way::small})
            if (kind != Kind::blended || way == Way::near) // what blends is asked how near it is
                programs_[static_cast<std::size_t>(kind)][static_cast<std::size_t>(way)] =
                    make_program(kind, way, grid_prelude);
    gl.EnableVertexArrayAttrib(vertex_array_.name(), 0);
    gl.VertexArrayAttribIFormat(vertex_array_.name(), 0, 4, GL_UNSIGNED_INT, 0);
    gl.VertexArrayAttribBinding(vertex_array_.name(), 0, 0);
}

Program MeshPass::make_program(Kind kind, Way way, const std::string& grid_prelude) const {
    const std::string prelude = grid_prelude + (kind == Kind::plain ? "" : "#define STYLES\n") +
                                (kind == Kind::blended ? "#define BLENDED\n" : "") +
                                (way == Way::near    ? "#define NEAR\n"
                                 : way == Way::small ? "#define LIT_AT_VERTICES\n"
                                                     : "#define SHARP_HIGHLIGHTS\n");
    const std::vector sources{shader_file("mesh.vert"), shader_file("mesh.frag")};
    return link_program(*gl_, sources, prelude);
}

GLuint MeshPass::program(Kind kind, const MeshLook& look) const {
    const Way way = kind == Kind::blended || look.near ? Way::near
                    : look.small                       ? Way::small
                                                       : Way::plain;
    return programs_[static_cast<std::size_t>(kind)][static_cast<std::size_t>(way)]->name();
}

/// Finds the style of each triangle of the shown set, and the first triangle of each cell.
void MeshPass::find_styles(const CellBuffers& cells) {
    if (cells_version_ == cells.version())
        return;
    cells_version_ = cells.version();
    style_of_triangle_.clear();
    first_of_cell_.clear();
    const std::span<const CellPlace> places =
        cells.slots().places; // slots are ranks in sets with meshes
    for (const index::CellSet& surface : cells.shown()->surfaces)
        for (std::size_t i = 0; i < surface.ids.size(); ++i) {
            const std::size_t count = index::mesh_cases()[surface.mesh->cases[i]].triangles;
            const std::uint16_t style = places[first_of_cell_.size()].style;
            first_of_cell_.push_back(static_cast<std::uint32_t>(style_of_triangle_.size()));
            style_of_triangle_.insert(style_of_triangle_.end(), count, style);
        }
}

/// Which vertices are whose.
void MeshPass::tell_surfaces(GLuint program, const CellBuffers& cells) const {
    const auto surfaces = cells.mesh().surfaces();
    for (std::size_t i = 0; i < index::kMostSurfaces; ++i)
        gl_->ProgramUniform1i(program, kFirstVertices + static_cast<GLint>(i),
                              i < surfaces.size() ? static_cast<GLint>(surfaces[i].first_vertex)
                                                  : std::numeric_limits<GLint>::max());
}

void MeshPass::draw_triangles(const CellBuffers& cells, GLuint indices, std::size_t first,
                              std::size_t count, std::size_t base) const {
    gl_->VertexArrayVertexBuffer(vertex_array_.name(), 0, cells.mesh().vertices(), 0,
                                 sizeof(index::MeshVertex));
    gl_->VertexArrayElementBuffer(vertex_array_.name(), indices);
    gl_->BindVertexArray(vertex_array_.name());
    gl_->DrawElementsBaseVertex(GL_TRIANGLES, static_cast<GLsizei>(count), GL_UNSIGNED_INT,
                                reinterpret_cast<const void*>(first * sizeof(std::uint32_t)),
                                static_cast<GLint>(base));
    gl_->BindVertexArray(0);
}

std::size_t MeshPass::triangles(const CellBuffers& cells, std::int32_t surfaces) {
    const auto all = cells.mesh().surfaces();
    std::size_t count = 0;
    for (std::size_t i = 0; i < all.size(); ++i)
        if ((surfaces >> i & 1) != 0)
            count += all[i].indices / 3;
    return count;
}

/// Puts the triangles of all surfaces in this order.
void MeshPass::put_near_first(const CellBuffers& cells, PlaneOrder order) {
    if (sorted_version_ == cells.version() && sorted_ == order)
        return;
    sorted_version_ = cells.version();
    sorted_ = order;
    styles_version_ = 0; // of another order
    near_triangles_.corners.clear();
    near_triangles_.numbers.clear();
    const std::span<const CellPlace> places = cells.slots().places;
    std::size_t before = 0;
    for (const index::CellSet& surface : cells.shown()->surfaces) {
        if (surface.mesh)
            append_in_order(places.subspan(before, surface.ids.size()), *surface.mesh, order,
                            near_triangles_);
        before += surface.ids.size();
    }
    const std::span<const std::uint32_t> corners = near_triangles_.corners;
    gl_->NamedBufferData(near_first_.name(), static_cast<GLsizeiptr>(corners.size_bytes()),
                         corners.data(), GL_STREAM_DRAW);
}

/// The styles of triangles in the order in which they are drawn.
void MeshPass::send_styles(const CellBuffers& cells, bool sorted) {
    find_styles(cells);
    if (styles_version_ == cells.version() && styles_sorted_ == sorted)
        return;
    styles_version_ = cells.version();
    styles_sorted_ = sorted;
    std::vector<std::uint16_t> styles;
    if (sorted)
        for (const std::uint32_t triangle : near_triangles_.numbers)
            styles.push_back(style_of_triangle_[triangle]);
    const std::span<const std::uint16_t> sent = sorted ? styles : style_of_triangle_;
    styles_.set(GL_R16UI, sizeof(sent[0]), std::as_bytes(sent));
}

void MeshPass::draw(const CellBuffers& cells, const MeshLook& look, PlaneOrder order,
                    DrawPart part) {
    const bool sorted = !order.of_mesh() && cells.size() <= kMostSorted;
    if (sorted)
        put_near_first(cells, order);
    if (look.colored) {
        send_styles(cells, sorted);
        gl_->BindTextureUnit(kStylesUnit, styles_.texture());
    }
    const GLuint of_look = program(look.colored ? Kind::styled : Kind::plain, look);
    gl_->UseProgram(of_look);
    tell_surfaces(of_look, cells);
    const GLuint triangles = sorted ? near_first_.name() : cells.mesh().indices();
    const auto surfaces = cells.mesh().surfaces();
    std::size_t before = 0;
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        const auto& [first_vertex, first_index, indices] = surfaces[i];
        if ((look.surfaces >> i & 1) == 0)
            continue;
        const DrawPart cut = part.among(before, indices / 3);
        before += indices / 3;
        if (cut.count == 0)
            continue;
        const std::size_t from = first_index / 3 + cut.first;
        if (look.colored)
            gl_->ProgramUniform1i(of_look, 0, static_cast<GLint>(from));
        else
            gl_->ProgramUniform3f(of_look, 0, look.colors[i].x, look.colors[i].y, look.colors[i].z);
        draw_triangles(cells, triangles, 3 * from, 3 * cut.count, first_vertex);
    }
}

void MeshPass::draw_blended(const CellBuffers& cells, const MeshLook& look,
                            std::span<const std::uint32_t> back_to_front) {
    find_styles(cells);
    std::vector<std::uint32_t> indices;
    std::vector<std::uint16_t> styles;
    indices.reserve(3 * style_of_triangle_.size());
    styles.reserve(style_of_triangle_.size());
    const auto surfaces = cells.mesh().surfaces();
    const auto& sets = cells.shown()->surfaces;
    for (const std::uint32_t slot : back_to_front) {
        const std::size_t first = first_of_cell_[slot];
        const std::size_t end = slot + std::size_t{1} < first_of_cell_.size()
                                    ? first_of_cell_[slot + 1]
                                    : style_of_triangle_.size();
        const std::size_t surface = cells.slots().places[slot].style & ((1u << kColorShift) - 1);
        if ((look.surfaces >> surface & 1) == 0)
            continue;
        const auto& [first_vertex, first_index, count] = surfaces[surface];
        for (std::size_t k = 3 * first - first_index; k < 3 * end - first_index; ++k)
            indices.push_back(
                static_cast<std::uint32_t>(first_vertex + sets[surface].mesh->triangles[k]));
        styles.insert(styles.end(), style_of_triangle_.begin() + static_cast<std::ptrdiff_t>(first),
                      style_of_triangle_.begin() + static_cast<std::ptrdiff_t>(end));
    }
    if (indices.empty())
        return;
    gl_->NamedBufferData(order_.name(), static_cast<GLsizeiptr>(std::span(indices).size_bytes()),
                         indices.data(), GL_STREAM_DRAW);
    styles_.set(GL_R16UI, sizeof(styles[0]), std::as_bytes(std::span(styles)));
    styles_version_ = 0; // of no set
    gl_->BindTextureUnit(kStylesUnit, styles_.texture());
    const GLuint of_look = program(Kind::blended, look);
    gl_->ProgramUniform1i(of_look, 0, 0);
    tell_surfaces(of_look, cells);
    gl_->UseProgram(of_look);
    draw_triangles(cells, order_.name(), 0, indices.size(), 0);
}

} // namespace isochron::render
