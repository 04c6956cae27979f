// Surfaces drawn for measurements: depth and normal of every pixel, in floats.
#pragma once

#include "render/drawing/cell_pass.h"
#include "tests/render/cells/extractions.h"
#include "tests/render/cells/vertex_field.h"
#include "tests/support/drawing/gl_test.h"

#include <glm/gtc/matrix_transform.hpp>

#include <optional>
#include <span>
#include <vector>

namespace isochron::render {

/// Places the volume around the room's origin so that it just fits into a sphere of radius 1.
Placement placed_at_origin(const index::Grid& grid,
                           const glm::dmat4& room_from_physical = glm::dmat4(1.0));

/// Rows from the bottom.
struct SurfacePicture {
    glm::ivec2 size{0};
    std::vector<float> depths;      ///< 1 where nothing was drawn
    std::vector<glm::vec4> normals; ///< physical space, of any length; w is the alpha drawn

    std::size_t index(int x, int y) const { return std::size_t(y) * size.x + x; }
    float depth(int x, int y) const { return depths[index(x, y)]; }
    bool covered(int x, int y) const { return normals[index(x, y)].w > 0.0f; }
    glm::dvec3 normal(int x, int y) const { return glm::dvec3(normals[index(x, y)]); }
};

class SurfaceTest : public GlTest {
  protected:
    SurfaceTest();

    /// The surface of the field, drawn alone, with its normals in place of its light.
    SurfacePicture draw(CellPass& pass, const VertexField& field, const Placement& placement,
                        std::span<const View> views, glm::ivec2 target_size,
                        const CellAppearance& appearance);
    SurfacePicture draw(const VertexField& field, const Placement& placement,
                        std::span<const View> views, glm::ivec2 target_size,
                        const CellAppearance& appearance = {}) {
        const bool uneven = field.values().grid.rectilinear();
        if (uneven && !uneven_pass_)
            uneven_pass_.emplace(normals_gl_, FootprintShapes{}, prelude_for(field.values().grid));
        return draw(uneven ? *uneven_pass_ : pass_, field, placement, views, target_size,
                    appearance);
    }
    SurfacePicture draw(const VertexField& field, const Placement& placement, const View& view) {
        return draw(field, placement, std::span(&view, 1), view.corner + view.size);
    }
    CellPass normals_pass() const { return CellPass(normals_gl_); }

  private:
    Gl normals_gl_; ///< compiles `shade` to return the normal
    CellPass pass_;
    std::optional<CellPass> uneven_pass_; ///< for rectilinear grids
};

} // namespace isochron::render
