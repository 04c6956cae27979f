// Draws meshes of other instants or arrays beside the cells, each of one color or by values, lit as surfaces are.
//
//     pass.hold(ghosts);                                  // all that are drawn from now on
//     pass.draw(view, placement, opacity, appearance);
#pragma once

#include "index/surface/cell_mesh.h"
#include "index/volume/grid.h"
#include "render/cells/axis_table.h"
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
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace isochron::render {

struct GhostMesh {
    index::CellMeshPtr mesh;
    glm::vec3 color{1.0f}; ///< sRGB, 0 to 1
    float opacity = 1.0f;  ///< factor of that of all; where a pass holds more than kMostSurfaces, 1
    bool by_values = false; ///< the mesh has colors, of the map of the appearance
    bool operator==(const GhostMesh&) const = default;
};

/// Opaque meshes write depth, in whatever order they are; translucent ones blend.
enum class GhostKind : std::uint8_t { translucent, opaque };

class GhostPass {
  public:
    /// Triangles that are sorted; of more, those beyond the middle of the volume come first.
    static constexpr std::size_t kMostSorted = 1 << 20;

    /// @param grid of all meshes @throws Error when a shader does not compile
    GhostPass(const Gl& gl, const index::Grid& grid, GhostKind kind = GhostKind::translucent);

    /// Sends meshes to the GPU unless they are there. By values are either all of them or none: while
    /// some have no values, each has its own color. @param ghosts all that are drawn from now on
    void hold(std::span<const GhostMesh> ghosts);
    /// Draws the triangles of all meshes into the view's viewport of the bound framebuffer, translucent
    /// ones the farthest first along the view's rounded direction (`rounded_direction`). Tests depth; opaque
    /// ones write it. Leaves depth test, depth writes and GL_FRAMEBUFFER_SRGB on, blending and culling
    /// off.
    /// @param opacity of each layer that is seen face-on, 0 to 1; above 0 for opaque meshes
    /// @param share of translucent triangles
    void draw(const View& view, const Placement& placement, float opacity,
              const CellAppearance& appearance, TriangleShare share = TriangleShare::all);

  private:
    void send();
    void tell_meshes(GLuint program) const;
    bool by_values() const;
    const FarOrders::Order& sorted_along(const glm::vec3& ahead, const Placement& placement);

    const Gl* gl_;
    GhostKind kind_;
    /// Where the vertices of the grid lie along each axis, in even coordinates.
    std::array<std::vector<float>, 3> places_;
    LazyProgram near_, small_; ///< see `MeshLook`
    VertexArray vertex_array_;
    Buffer frame_, vertices_, numbers_; ///< `numbers_`: place of each vertex on the map
    AxisTable axes_;
    Surroundings nothing_around_;
    std::optional<Texture> colors_;
    std::vector<GhostMesh> held_;
    FarOrders orders_; ///< triangles of all ghosts together
};

} // namespace isochron::render
