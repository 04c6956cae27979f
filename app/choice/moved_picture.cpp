// The last exact picture, moved to where its cells are seen now.
#include "app/choice/moved_picture.h"

#include "app/scene/cells_picture.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>

namespace isochron::app {
namespace {

/// Whether the same viewers look, wherever they are.
bool same_viewers(const Picture& a, const Picture& b) {
    return a.audience.eyes.size() == b.audience.eyes.size() &&
           std::ranges::equal(a.audience.viewers, b.audience.viewers,
                              [](const stereo::ViewerPose& one, const stereo::ViewerPose& other) {
                                  return one.eyes == other.eyes && one.parallel == other.parallel;
                              });
}

} // namespace

bool stand_as(const Picture& then, const Picture& now) {
    return then.audience.viewers == now.audience.viewers &&
           then.audience.eyes == now.audience.eyes &&
           then.room_from_physical == now.room_from_physical;
}

double moved_by(const Picture& then, const Picture& now) {
    const glm::dmat4 now_from_then = interaction::matrix(now.room_from_physical) *
                                     glm::inverse(interaction::matrix(then.room_from_physical));
    double most = 0;
    const std::size_t viewers = now.audience.viewers.size();
    if (then.audience.viewers.size() != viewers)
        return std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < viewers; ++i) {
        const glm::dvec4 head(then.audience.viewers[i].head.position, 1);
        most = std::max(most, glm::distance(glm::dvec3(now_from_then * head),
                                            glm::dvec3(now.audience.viewers[i].head.position)));
    }
    return most;
}

bool may_be_moved(const Picture& exact, const Picture& now, const index::SurfacesQuery& asked) {
    // What stands beside the cells may lie outside of the box that is moved.
    if (exact.footprint != render::Footprint::surface || !exact.cells || !now.beside.empty() ||
        exact.cells->query.of_cells() != asked || !same_viewers(exact, now) ||
        moved_by(exact, now) > kMovedAtMost)
        return false;
    Picture same = exact;
    same.audience.viewers = now.audience.viewers;
    same.audience.eyes = now.audience.eyes;
    same.layout = now.layout; // which only places the views otherwise
    same.room_from_physical = now.room_from_physical;
    return same_cells(same, drawn_as(now, exact));
}

} // namespace isochron::app
