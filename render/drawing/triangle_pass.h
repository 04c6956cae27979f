// Draws triangles that stand beside the cells, lit as surfaces are.
#pragma once

#include "index/volume/grid.h"
#include "index/volume/triangle_mesh.h"
#include "render/cells/cell_appearance.h"
#include "render/cells/placement.h"
#include "render/cells/surroundings.h"
#include "render/drawing/far_orders.h"
#include "render/gl/gl_objects.h"
#include "render/gl/shader.h"
#include "render/gl/view.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace isochron::render {

struct TriangleLook {
    glm::vec3 color{1.0f}; ///< sRGB, 0 to 1
    float opacity = 1.0f;  ///< 0 to 1
    bool lines = false;    ///< edges a pixel wide, in the place of faces
    bool operator==(const TriangleLook&) const = default;
};

class TrianglePass {
  public:
    /// @param grid of the cells
    TrianglePass(const Gl& gl, const index::Grid& grid);

    /// Sends meshes to the GPU unless they are there, and forgets all others. @param meshes may be null
    void hold(std::span<const index::TriangleMeshPtr> meshes);
    /// Draws a mesh that is held into the view's viewport of the bound framebuffer. Opaque triangles
    /// test and write depth; translucent ones only test it, and blend over the target, the farthest
    /// first by their first corners, along the view's rounded direction (`rounded_direction`), up to
    /// kMostSorted of them: more are drawn as they come. Light,
    /// cuts and fading are those of surfaces. Leaves depth test, depth writes and
    /// GL_FRAMEBUFFER_SRGB on, blending and culling off.
    void draw(const View& view, const Placement& placement, const index::TriangleMesh& mesh,
              const TriangleLook& look, const CellAppearance& appearance,
              TriangleShare share = TriangleShare::all);

    static constexpr std::size_t kMostSorted = 1 << 20;

  private:
    struct Held {
        index::TriangleMeshPtr mesh;
        Buffer points, normals, corners, edges;
        FarOrders orders;
        bool has_edges = false;
    };
    void send_edges(Held& held) const;
    /// Draws corners of a buffer, from the first to that before the end.
    void draw_elements(const Held& held, bool lines, GLuint corners,
                       std::array<std::size_t, 2> part) const;

    const Gl* gl_;
    index::Grid grid_;
    std::array<LazyProgram, 4> programs_; ///< by blended + 2 * lines
    VertexArray vertex_array_;
    Buffer frame_, no_normal_;
    Surroundings nothing_around_;
    std::vector<Held> held_;
};

} // namespace isochron::render
