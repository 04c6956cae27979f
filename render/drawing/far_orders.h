// Triangles with the farthest first, in orders that serve while a view turns little.
#pragma once

#include "render/gl/gl_objects.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <vector>

namespace isochron::render {

/// What is drawn of translucent triangles: those beyond the middle of the volume come before cells
/// that write no depth, the others after them.
enum class TriangleShare : std::uint8_t { all, beyond, before };

/// The direction of a view through the volume, in index coordinates, of some length: rounded to some two
/// degrees, so an order serves for both eyes and while a head sways, and depends on nothing that
/// was drawn before.
glm::vec3 rounded_direction(const glm::mat4& eye_from_index);

/// Orders of the triangles of one or several meshes, on the GPU.
class FarOrders {
  public:
    struct Order {
        glm::vec3 ahead;
        Buffer corners;            ///< three numbers of vertices a triangle
        std::size_t beyond, count; ///< corners of triangles beyond the volume's middle; of all

        /// The corners of a share: the first one, and that behind the last.
        std::array<std::size_t, 2> part(TriangleShare share) const {
            return {share == TriangleShare::before ? beyond : 0,
                    share == TriangleShare::beyond ? beyond : count};
        }
    };
    /// Appends the distance of each triangle along the direction, and its corners.
    using Measure =
        std::function<void(std::vector<float>& distances, std::vector<std::uint32_t>& corners)>;

    explicit FarOrders(const Gl& gl) : gl_(&gl) {}

    /// The order along a direction; made unless it is one of the last.
    /// @param middle distance of the volume's middle
    /// @param most of more triangles, those beyond the middle come first, each half as it is measured
    const Order& along(const glm::vec3& ahead, float middle, std::size_t most,
                       const Measure& measure);
    /// Forgets all: the triangles have changed.
    void clear() { orders_.clear(); }

  private:
    const Gl* gl_;
    std::deque<Order> orders_; ///< the last ones
};

} // namespace isochron::render
