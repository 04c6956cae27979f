// Fills the table of a rectilinear grid's axes.
#include "render/cells/axis_table.h"

#include "render/cells/axis_places.h"

#include <glm/vec4.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace isochron::render {
namespace {

constexpr GLuint kUnit = 10; ///< texture unit of cell_place.glsl

} // namespace

const char* prelude_for(const index::Grid& grid) {
    return grid.rectilinear() ? "#define UNEVEN\n" : "";
}

AxisTable::AxisTable(const Gl& gl, const index::Grid& grid) : gl_(&gl) {
    if (!grid.rectilinear())
        return;
    const auto places = axis_places(grid);
    const std::size_t longest = std::ranges::max(grid.vertices);
    std::vector<glm::vec4> texels(4 * longest, glm::vec4(0.0f));
    for (int axis = 0; axis < 3; ++axis) {
        const std::uint32_t count = grid.vertices[static_cast<std::size_t>(axis)];
        float& largest = largest_[axis] = 0.0f;
        for (std::uint32_t i = 0; i < count; ++i) {
            const AxisPlaces& of_axis = places[static_cast<std::size_t>(axis)];
            const float size = of_axis.side[i];
            const auto weights = grid.slope_weights(axis, i);
            glm::vec4* const of_vertex = &texels[std::size_t{4} * i];
            of_vertex[0][axis] = of_axis.place[i];
            of_vertex[1][axis] = size;
            of_vertex[2][axis] = static_cast<float>(weights.before);
            of_vertex[3][axis] = static_cast<float>(weights.behind);
            largest = std::max(largest, size);
            smallest_ = std::min(smallest_, size);
        }
    }
    texels_.emplace(gl).set(GL_RGBA32F, sizeof(texels[0]), std::as_bytes(std::span(texels)));
}

void AxisTable::bind() const {
    if (texels_)
        gl_->BindTextureUnit(kUnit, texels_->texture());
}

} // namespace isochron::render
