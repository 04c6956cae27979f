// Gives the points of a set, with their styles.
#include "render/cells/ranked_points.h"

#include <algorithm>

namespace isochron::render {

RankedPoints::RankedPoints(const index::Extraction& set) : set_(&set) {
    slots_.places.reserve(set.cells());
    slots_.planes.reserve(set.cells());
    if (set.coarse())
        slots_.largest = 1u << set.coarsest;
}

std::span<const index::CellPoint> RankedPoints::next(std::size_t most) {
    given_.clear();
    for (; surface_ < set_->surfaces.size(); ++surface_, at_ = 0) {
        const auto from = std::span(set_->surfaces[surface_].points).subspan(at_);
        const auto part = from.first(std::min(most - given_.size(), from.size()));
        for (index::CellPoint point : part) {
            const std::size_t rank = given();
            point.style = cell_style(surface_, set_->colors.empty() ? 0 : set_->colors[rank]);
            given_.push_back(point);
            slots_.places.push_back({point.x, point.y, point.z, point.style});
            slots_.planes.push_back(point.plane);
        }
        at_ += part.size();
        if (part.size() < from.size())
            break;
    }
    return given_;
}

} // namespace isochron::render
