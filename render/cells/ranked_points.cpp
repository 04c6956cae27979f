// Copies the points of a set, with their styles.
#include "render/cells/ranked_points.h"

#include <algorithm>

namespace isochron::render {

RankedPoints::RankedPoints(const index::Extraction& set) : set_(&set) {
    points_.reserve(set.cells());
    slots_.places.reserve(set.cells());
    slots_.planes.reserve(set.cells());
    slots_.slot_of_rank.reserve(set.cells());
    if (set.coarse())
        slots_.largest = 1u << set.coarsest;
}

bool RankedPoints::copy(std::size_t cells) {
    for (; surface_ < set_->surfaces.size(); ++surface_, at_ = 0) {
        const auto from = std::span(set_->surfaces[surface_].points).subspan(at_);
        const auto part = from.first(std::min(cells, from.size()));
        for (index::CellPoint point : part) {
            const std::size_t rank = points_.size();
            point.style = cell_style(surface_, set_->colors.empty() ? 0 : set_->colors[rank]);
            points_.push_back(point);
            slots_.places.push_back({point.x, point.y, point.z, point.style});
            slots_.planes.push_back(point.plane);
            slots_.slot_of_rank.push_back(static_cast<std::uint32_t>(rank));
        }
        cells -= part.size();
        at_ += part.size();
        if (part.size() < from.size())
            return false;
    }
    return true;
}

} // namespace isochron::render
