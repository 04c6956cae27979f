// Words of a picked place.
#include "app/scene/mark.h"

#include "app/scene/caption.h"
#include "app/text.h"
#include "index/volume/instant_text.h"

#include <fmt/format.h>

namespace isochron::app {
namespace {

std::string place_text(const interaction::MarkedPoint& point, const index::SeriesInfo& info) {
    const glm::dvec3& p = point.position;
    return fmt::format("{:.5g}, {:.5g}, {:.5g}{}", p.x, p.y, p.z, with_space(info.length_unit));
}

std::string time_text(const interaction::MarkedPoint& point, const index::SeriesInfo& info) {
    const index::Instant at = point.instant.within(info.steps());
    const std::string time = index::instant_text(info.times, at, info.time_unit);
    return at.between() ? fmt::format("{}, {}", time, steps_text(at)) : time;
}

} // namespace

std::string mark_text(const interaction::MarkedPoint& point, const index::SeriesInfo& info) {
    return fmt::format("{}: {} at {}", place_text(point, info),
                       with_unit(point.value, info.value_unit), time_text(point, info));
}

std::vector<std::string> mark_lines(const interaction::MarkedPoint& point,
                                    const index::SeriesInfo& info) {
    return {with_unit(point.value, info.value_unit), place_text(point, info),
            "at " + time_text(point, info)};
}

std::vector<std::string> pointed_lines(const interaction::Pointed& pointed, std::size_t surfaces,
                                       const index::SeriesInfo& info) {
    std::vector<std::string> lines{with_unit(pointed.point.value, info.value_unit),
                                   place_text(pointed.point, info)};
    if (pointed.point.instant.between())
        lines.push_back(steps_text(pointed.point.instant));
    if (surfaces > 1)
        lines.push_back(fmt::format("surface {} of {}", pointed.surface + 1, surfaces));
    return lines;
}

} // namespace isochron::app
