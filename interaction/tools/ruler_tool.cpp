// The ruler tool: measures distances and angles between places on surfaces.
#include "interaction/tools/ruler_tool.h"

#include "interaction/next_number.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace isochron::interaction {
namespace {

constexpr glm::vec4 kRulerColor(0.45f, 0.85f, 1.0f, 1.0f), kOtherRuler(0.40f, 0.70f, 0.85f, 0.85f);
constexpr double kTick = 0.012; ///< half the size of a cross, as a fraction of the longest side

void add_cross(const glm::dvec3& at, const DataFrame& data, const glm::vec4& color,
               ToolDrawing& drawing) {
    const double arm = kTick * data.longest_side();
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 along(0.0);
        along[axis] = arm;
        drawing.lines.push_back({at - along, at + along, color});
    }
}

void add_ruler(const Ruler& ruler, const DataFrame& data, const glm::vec4& color, bool named,
               ToolDrawing& drawing) {
    const auto& places = ruler.places;
    for (std::size_t i = 0; i < places.size(); ++i) {
        add_cross(places[i], data, color, drawing);
        if (i > 0)
            drawing.lines.push_back({places[i - 1], places[i], color});
    }
    if (const std::string text = measured_text(ruler, data.unit); !text.empty())
        drawing.labels.push_back({ruler.angle ? places[1] : (places[0] + places[1]) / 2.0,
                                  named ? fmt::format("{}: {}", ruler.name, text) : text});
}

} // namespace

ToolOutcome RulerTool::update(std::span<const ToolHand> hands, const ToolContext& now) {
    ToolOutcome outcome;
    for (const ToolHand& hand : hands) {
        if (!hand.chosen || !hand.ray || !now.session.find_surface)
            continue;
        const auto found = now.session.find_surface(*hand.ray);
        const Rulers& rulers = now.session.settings.rulers;
        if (!found)
            outcome.note = "no surface there: the ruler measures between places on surfaces";
        else if (Rulers longer = with_place(rulers, found->point.position); longer != rulers)
            outcome.commands.rulers = std::move(longer);
        else
            outcome.note = fmt::format("there are {} rulers: remove one first", rulers.list.size());
    }
    return outcome;
}

Rulers with_place(Rulers rulers, const glm::dvec3& place) {
    if (rulers.list.empty() || rulers.list.back().complete()) {
        if (rulers.list.size() == kMostRulers)
            return rulers;
        rulers.list.push_back({.name = next_number(rulers.list), .angle = rulers.angle});
    }
    rulers.picked = static_cast<std::uint32_t>(rulers.list.size()) - 1;
    rulers.list.back().places.push_back(place);
    return rulers;
}

Rulers with_angle(Rulers rulers, bool angle) {
    rulers.angle = angle;
    if (!rulers.list.empty() && !rulers.list.back().complete())
        rulers.list.back().angle = angle;
    return rulers;
}

Rulers without_ruler(Rulers rulers, std::size_t removed) {
    if (removed >= rulers.list.size())
        return rulers;
    rulers.list.erase(rulers.list.begin() + static_cast<std::ptrdiff_t>(removed));
    if (rulers.picked > removed || rulers.picked == rulers.list.size())
        rulers.picked = std::max(rulers.picked, 1u) - 1;
    return rulers;
}

std::optional<double> measured(const Ruler& ruler) {
    if (!ruler.complete())
        return std::nullopt;
    const auto& places = ruler.places;
    if (!ruler.angle)
        return glm::distance(places[0], places[1]);
    const glm::dvec3 to_first = places[0] - places[1], to_last = places[2] - places[1];
    if (to_first == glm::dvec3(0.0) || to_last == glm::dvec3(0.0))
        return std::nullopt;
    // Exact also near 0 and 180 degrees, where the cosine alone is not.
    return glm::degrees(
        std::atan2(glm::length(glm::cross(to_first, to_last)), glm::dot(to_first, to_last)));
}

std::string measured_text(const Ruler& ruler, const std::string& unit) {
    const std::optional<double> value = measured(ruler);
    if (!value)
        return {};
    return ruler.angle ? fmt::format("{:.4g}\u00b0", *value)
                       : fmt::format("{:.4g}{}{}", *value, unit.empty() ? "" : " ", unit);
}

ToolDrawing draw_rulers(const Settings& settings, const DataFrame& data) {
    ToolDrawing drawing;
    const Rulers& rulers = settings.rulers;
    for (std::size_t i = 0; i < rulers.list.size(); ++i)
        if (rulers.list[i].shown)
            add_ruler(rulers.list[i], data, i == rulers.picked ? kRulerColor : kOtherRuler,
                      rulers.list.size() > 1, drawing);
    return drawing;
}

std::string ruler_line(const Settings& settings) {
    const Rulers& rulers = settings.rulers;
    if (!rulers.list.empty() && rulers.list.back().complete())
        return "ruler";
    const bool angle = rulers.list.empty() ? rulers.angle : rulers.list.back().angle;
    return fmt::format("click {} places", angle ? "three" : "two");
}

std::vector<MarkedRow> ruler_rows(const Commands& commands, const Settings& before) {
    std::vector<MarkedRow> rows;
    if (!commands.rulers)
        return rows;
    const auto same = [](const Ruler& a, const Ruler& b) {
        return a.places == b.places && a.angle == b.angle;
    };
    for (const Ruler& ruler : commands.rulers->list) {
        const bool known = std::ranges::any_of(
            before.rulers.list, [&](const Ruler& each) { return same(each, ruler); });
        if (!ruler.complete() || known)
            continue;
        for (std::size_t i = 0; i < ruler.wanted(); ++i)
            rows.push_back({.position = ruler.places[i], .name = ruler.name});
        rows.back().value = measured(ruler);
    }
    return rows;
}

} // namespace isochron::interaction
