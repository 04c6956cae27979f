// The places of vertices in files.
#include "index/export/exported_step.h"

#include "index/export/simplified_mesh.h"
#include "index/volume/grid_corners.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace isochron::index {

float linear_light(std::uint8_t srgb) {
    const double c = srgb / 255.0;
    return static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
}

ExportedPlaces::ExportedPlaces(const Grid& grid, const ExportPlan& plan)
    : grid_(grid), factor_(plan.unit_factor), double_(plan.double_precision),
      quantized_(plan.quantized), turned_(glm::determinant(grid.direction) < 0) {
    const double side = shortest_side(grid) * factor_;
    find_farthest();
    if (double_ || farthest_ * std::numeric_limits<float>::epsilon() <= kMostOfSide * side)
        return;
    origin_ = glm::dvec3(glm::vec3(grid.origin * factor_));
    find_farthest();
}

void ExportedPlaces::find_farthest() {
    farthest_ = 0;
    for (const glm::dvec3& corner : corners_of(grid_)) {
        const glm::dvec3 at = glm::abs(corner * factor_ - origin_);
        farthest_ = std::max({farthest_, at.x, at.y, at.z});
    }
}

double ExportedPlaces::rounding(double longest_side) const {
    const double step = double_ ? std::numeric_limits<double>::epsilon()
                                : double{std::numeric_limits<float>::epsilon()};
    const double half_steps = farthest_ * step / 2 + (quantized_ ? longest_side / 65535 / 2 : 0);
    return std::sqrt(3.0) * half_steps; // along three axes
}

std::string words_of(const ExportPlan& plan, const ExportedPlaces& places) {
    const glm::dvec3& origin = places.origin();
    return fmt::format("coordinates in {}, less origin {} {} {}",
                       plan.length_unit.empty() ? "a unit that is not known" : plan.length_unit,
                       origin.x, origin.y, origin.z);
}

std::string words_of(const ExportPlan& plan, const ExportedStep& step) {
    return fmt::format("step {}, time {}{}", number_text(step.instant), step.time,
                       plan.time_unit.empty() ? "" : " " + plan.time_unit);
}

} // namespace isochron::index
