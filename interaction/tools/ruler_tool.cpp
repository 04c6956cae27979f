// The ruler tool: measures the distance between two places on surfaces.
#include "interaction/tools/ruler_tool.h"

#include <glm/geometric.hpp>

#include <fmt/format.h>

namespace isochron::interaction {
namespace {

constexpr glm::vec4 kRulerColor(0.45f, 0.85f, 1.0f, 1.0f);
constexpr double kTick = 0.012; ///< half the size of a cross, as a fraction of the longest side

void add_cross(const glm::dvec3& at, const DataFrame& data, ToolDrawing& drawing) {
    const double arm = kTick * data.longest_side();
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 along(0.0);
        along[axis] = arm;
        drawing.lines.push_back({at - along, at + along, kRulerColor});
    }
}

} // namespace

ToolOutcome RulerTool::update(std::span<const ToolHand> hands, const ToolContext& now) {
    ToolOutcome outcome;
    for (const ToolHand& hand : hands) {
        if (!hand.chosen || !hand.ray || !now.session.find_surface)
            continue;
        const auto found = now.session.find_surface(*hand.ray);
        if (!found) {
            outcome.note = "no surface there: the ruler measures between places on surfaces";
            continue;
        }
        Ruler ruler = now.session.settings.ruler;
        if (ruler.places.size() == kMostRulerPlaces)
            ruler.places.clear();
        ruler.places.push_back(found->point.position);
        outcome.commands.ruler = std::move(ruler);
    }
    return outcome;
}

std::string ruler_line(const Settings& settings) {
    const std::size_t places = settings.ruler.places.size();
    return places == 0                 ? "click two places on surfaces"
           : places < kMostRulerPlaces ? "click the other place"
                                       : "ruler";
}

std::vector<MarkedRow> ruler_rows(const Commands& commands) {
    if (!commands.ruler || commands.ruler->places.size() != kMostRulerPlaces)
        return {};
    const auto& places = commands.ruler->places;
    return {{places[0]}, {places[1], glm::distance(places[0], places[1])}};
}

ToolDrawing draw_ruler(const Settings& settings, const DataFrame& data) {
    ToolDrawing drawing;
    const auto& places = settings.ruler.places;
    for (const glm::dvec3& place : places)
        add_cross(place, data, drawing);
    if (places.size() == kMostRulerPlaces) {
        drawing.lines.push_back({places[0], places[1], kRulerColor});
        drawing.labels.push_back({(places[0] + places[1]) / 2.0,
                                  fmt::format("{:.4g}{}{}", glm::distance(places[0], places[1]),
                                              data.unit.empty() ? "" : " ", data.unit)});
    }
    return drawing;
}

} // namespace isochron::interaction
