// A plane in numbers.
#include "app/panel/parts/plane_fields.h"

#include "app/panel/parts/rows.h"
#include "app/panel/parts/theme.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace isochron::app {
namespace {

using interaction::Plane;

constexpr float kPartOfNormal = 48.0f; ///< width of the field of a part of the normal

/// The plane's normal or its opposite: the one whose largest part is positive, so that places along
/// it are coordinates where the plane lies across an axis.
glm::dvec3 upwards(const glm::dvec3& normal) {
    const glm::dvec3 size = glm::abs(normal);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    return normal[axis] < 0 ? -normal : normal;
}

/// The lowest and highest place of the data's box along a direction.
std::array<double, 2> span_along(const glm::dvec3& way, const interaction::DataFrame& data) {
    std::array<double, 2> span{glm::dot(data.at({0, 0, 0}), way),
                               glm::dot(data.at({0, 0, 0}), way)};
    for (int corner = 1; corner < 8; ++corner) {
        const double place = glm::dot(data.at({corner & 1, corner >> 1 & 1, corner >> 2 & 1}), way);
        span = {std::min(span[0], place), std::max(span[1], place)};
    }
    return span;
}

void place_field(const PanelModel& model, Plane& plane) {
    const glm::dvec3 way = upwards(plane.normal);
    const auto [low, high] = span_along(way, model.data);
    const double before = glm::dot(plane.point, way);
    double place = before;
    ImGui::SetNextItemWidth(110.0f);
    if (number_field("##place", place, {.low = low, .high = high},
                     format_with(model.info.length_unit).c_str()))
        plane.point += (place - before) * way;
    tip("where the plane lies along its normal: drag, or click and type");
}

/// The three parts of the normal. What the user types stands there as it was typed, although the
/// plane has the normal of length 1 in that direction.
void normal_fields(Plane& plane, const char* effect) {
    ImGuiStorage& kept = *ImGui::GetStateStorage();
    constexpr std::array<const char*, 3> kIds{"##nx", "##ny", "##nz"};
    glm::dvec3 typed;
    for (int axis = 0; axis < 3; ++axis)
        typed[axis] = static_cast<double>(
            kept.GetFloat(ImGui::GetID(kIds[static_cast<std::size_t>(axis)]), 0.0f));
    const bool same =
        glm::length(typed) > 0 && glm::distance(glm::normalize(typed), plane.normal) < 1e-5;
    if (!same)
        typed = plane.normal;
    for (int axis = 0; axis < 3; ++axis) {
        const char* const id = kIds[static_cast<std::size_t>(axis)];
        ImGui::SameLine();
        ImGui::SetNextItemWidth(kPartOfNormal);
        if (number_field(id, typed[axis], {.low = -1, .high = 1, .bounded = false}, "%.3g") &&
            std::isfinite(typed[axis]) && glm::length(typed) > 1e-6)
            plane.normal = glm::normalize(typed);
        tip(effect);
        kept.SetFloat(ImGui::GetID(id), static_cast<float>(typed[axis]));
    }
}

} // namespace

void plane_fields(const PanelModel& model, Plane& plane, float right, const char* normal) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(color_of(Ink::dim), "at");
    ImGui::SameLine();
    place_field(model, plane);
    go_on_within(right, ImGui::CalcTextSize("normal").x +
                            3 * (ImGui::GetStyle().ItemSpacing.x + kPartOfNormal));
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(color_of(Ink::dim), "normal");
    normal_fields(plane, normal);
}

} // namespace isochron::app
