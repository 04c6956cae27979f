// Draws the meshes that come with a set of cells.
#pragma once

#include "render/cells/cell_buffers.h"
#include "render/cells/draw_part.h"
#include "render/drawing/mesh_look.h"
#include "render/drawing/mesh_order.h"
#include "render/gl/shader.h"

#include <glm/vec4.hpp>
#include <string>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace isochron::render {

class MeshPass {
  public:
    /// @param grid_prelude see CellPass
    /// @throws Error when a shader does not compile
    MeshPass(const Gl& gl, const std::string& grid_prelude);

    /// Draws one view with the frame and viewport that CellPass has bound, and its depth and blend
    /// state. (Two in one pass take software GL a third longer.)
    /// @param cells with a mesh, see `CellBuffers::has_mesh`
    /// @param order of planes, near ones first, so that most triangles are hidden when their turn
    ///   comes; ignored if there are too many triangles
    /// @param part of the triangles of the surfaces that are drawn
    void draw(const CellBuffers& cells, const MeshLook& look, PlaneOrder order, DrawPart part);
    /// Triangles of the surfaces that `draw` draws.
    static std::size_t triangles(const CellBuffers& cells, std::size_t level,
                                 std::int32_t surfaces);
    /// Draws blended triangles of mesh level 0, cell by cell in this order.
    /// @param back_to_front slots of the cells
    void draw_blended(const CellBuffers& cells, const MeshLook& look,
                      std::span<const std::uint32_t> back_to_front);
    /// Draws blended triangles of a simplified mesh, the farthest first. @param ahead see far_first
    /// @param part of the triangles of the surfaces that are drawn
    void draw_blended(const CellBuffers& cells, const MeshLook& look, const glm::vec4& ahead,
                      DrawPart part);

  private:
    enum class Kind : std::uint8_t { plain, colored, blended };
    enum class Way : std::uint8_t { plain, near, small }; ///< which shader a MeshLook asks for
    LazyProgram make_program(Kind kind, Way way, const std::string& grid_prelude) const;
    GLuint program(Kind kind, const MeshLook& look) const;
    void put_near_first(const CellBuffers& cells, std::size_t level, PlaneOrder order);
    void find_cells(const CellBuffers& cells);
    void tell_surfaces(GLuint program, const MeshBuffers& mesh) const;
    void draw_blended(const MeshBuffers& mesh, const MeshLook& look,
                      std::span<const std::uint32_t> corners);
    void draw_triangles(const MeshBuffers& mesh, GLuint indices, std::size_t first,
                        std::size_t count, std::size_t base) const;

    const Gl* gl_;
    std::array<std::array<std::optional<LazyProgram>, 3>, 3> programs_; ///< [kind][way]
    VertexArray vertex_array_;
    Buffer no_color_;           ///< one color coordinate, 0
    Buffer near_first_, order_; ///< vertex indices, also to be blended
    std::vector<std::uint32_t>
        first_of_cell_;            ///< first triangle of each cell, by slot, and the end
    PlaneOrder sorted_;            ///< order of `near_first_`
    std::size_t sorted_level_ = 0; ///< mesh level of `near_first_`
    std::uint64_t cells_version_ = 0, sorted_version_ = 0;
};

} // namespace isochron::render
