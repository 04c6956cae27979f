// A cube in the picture's corner that shows how the data lie; a click on it turns them.
#include "app/panel/parts/view_cube.h"

#include "app/config/first_placement.h"
#include "app/panel/panel_words.h"
#include "app/panel/parts/theme.h"
#include "interaction/navigation/axis_views.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {
namespace {

using interaction::AxisView;

constexpr float kAbove = 6.0f;               ///< the cube, panel pixels
constexpr float kSide = kCubeEnd.y - kAbove; ///< side of the cube's window, panel pixels
constexpr float kHalfEdge = 25.0f; ///< half an edge of the cube: its corners stay in the window
constexpr float kCornerReach = 7.0f;
constexpr double kSeen = 0.08;   ///< cosine from which on a face is drawn
constexpr double kLegible = 0.4; ///< cosine from which on a face is drawn with its name

/// From directions of the data to the window: x to the right, y down, z towards the viewer.
class Turn {
  public:
    Turn(const PanelModel& model, const interaction::Similarity& placed, const ImVec2& middle,
         float half_edge)
        : turn_(glm::conjugate(glm::normalize(glm::dquat(model.head.orientation))) *
                placed.rotation),
          middle_(middle), half_edge_(half_edge) {}

    double towards_viewer(const glm::dvec3& way) const { return (turn_ * way).z; }
    ImVec2 way(const glm::dvec3& way) const {
        const glm::dvec3 seen = turn_ * way;
        return {static_cast<float>(seen.x), static_cast<float>(-seen.y)};
    }
    ImVec2 place(const glm::dvec3& corner) const {
        const ImVec2 at = way(corner);
        return {middle_.x + half_edge_ * at.x, middle_.y + half_edge_ * at.y};
    }

  private:
    glm::dquat turn_;
    ImVec2 middle_;
    float half_edge_;
};

struct Face {
    const AxisView* view;
    glm::dvec3 right;
    std::array<ImVec2, 4> corners;
};

std::vector<Face> seen_faces(const Turn& turn) {
    std::vector<Face> faces;
    for (std::size_t i = 0; i < interaction::kIsometric; ++i) {
        const AxisView& view = interaction::axis_views()[i];
        if (turn.towards_viewer(view.towards_eye) < kSeen)
            continue;
        const glm::dvec3 right = glm::cross(view.up, view.towards_eye);
        Face face{&view, right, {}};
        constexpr std::array<glm::dvec2, 4> kAround{{{-1, 1}, {1, 1}, {1, -1}, {-1, -1}}};
        for (std::size_t corner = 0; corner < 4; ++corner)
            face.corners[corner] = turn.place(view.towards_eye + kAround[corner].x * right +
                                              kAround[corner].y * view.up);
        faces.push_back(face);
    }
    return faces;
}

bool is_on(const Face& face, const ImVec2& at) {
    for (std::size_t i = 0; i < 4; ++i) {
        const ImVec2 &a = face.corners[i], &b = face.corners[(i + 1) % 4];
        if ((b.x - a.x) * (at.y - a.y) - (b.y - a.y) * (at.x - a.x) < 0)
            return false;
    }
    return true;
}

/// The name, as if it were painted on the face.
void paint_name(const Face& face, const Turn& turn) {
    if (turn.towards_viewer(face.view->towards_eye) < kLegible)
        return;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 middle = turn.place(face.view->towards_eye);
    const ImVec2 size = ImGui::CalcTextSize(face.view->name);
    const int first = list.VtxBuffer.Size;
    list.AddText({middle.x - size.x / 2, middle.y - size.y / 2}, packed(Ink::text),
                 face.view->name);
    constexpr float kLarger = 1.25f;
    const ImVec2 right = turn.way(face.right), down = turn.way(-face.view->up);
    for (int i = first; i < list.VtxBuffer.Size; ++i) {
        ImVec2& at = list.VtxBuffer[i].pos;
        const float x = kLarger * (at.x - middle.x), y = kLarger * (at.y - middle.y);
        at = {middle.x + x * right.x + y * down.x, middle.y + x * right.y + y * down.y};
    }
}

/// The corner that is nearest to the viewer, if three faces meet there.
std::optional<ImVec2> nearest_corner(const std::vector<Face>& faces, const Turn& turn) {
    if (faces.size() != 3)
        return std::nullopt;
    glm::dvec3 corner(0.0);
    for (const Face& face : faces)
        corner += face.view->towards_eye;
    return turn.place(corner);
}

} // namespace

void small_cube(const PanelModel& model, const interaction::Similarity& placed,
                const ImVec2& middle, float half_edge) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (const Face& face : seen_faces(Turn(model, placed, middle, half_edge))) {
        const glm::dvec3& way = face.view->towards_eye;
        // The faces towards the higher ends of the axes are lighter.
        const double shade = way.x + way.y + way.z > 0 ? 0.92 : 0.55;
        const auto part = [&](double along) {
            return static_cast<float>(shade * (0.45 + 0.55 * std::abs(along)));
        };
        list.AddConvexPolyFilled(
            face.corners.data(), 4,
            ImGui::ColorConvertFloat4ToU32({part(way.x), part(way.y), part(way.z), 1.0f}));
        list.AddPolyline(face.corners.data(), 4, packed(Ink::line), ImDrawFlags_Closed, 1.0f);
    }
}

float view_cube(const PanelModel& model, const PanelBox& picture, interaction::Commands& commands) {
    if (picture.size().x < 3 * kSide || picture.size().y < 2 * kSide)
        return picture.high.x;
    const ImVec2 corner(picture.high.x - kCubeEnd.x, picture.low.y + kAbove);
    ImGui::SetNextWindowPos(corner);
    ImGui::SetNextWindowSize({kSide, kSide});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0f, 0.0f});
    ImGui::Begin("###cube", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoFocusOnAppearing);
    const bool pressed = ImGui::InvisibleButton("cube", {kSide, kSide});
    const bool hovered = ImGui::IsItemHovered();
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const Turn turn(model, model.asked.room_from_physical,
                    {corner.x + kSide / 2, corner.y + kSide / 2}, kHalfEdge);
    const std::vector<Face> faces = seen_faces(turn);
    const std::optional<ImVec2> tip_of_cube = nearest_corner(faces, turn);
    const auto near_tip = [&] {
        const float x = mouse.x - tip_of_cube->x, y = mouse.y - tip_of_cube->y;
        return x * x + y * y < kCornerReach * kCornerReach;
    };
    const AxisView* pointed = nullptr;
    if (hovered && tip_of_cube && near_tip())
        pointed = &interaction::axis_views()[interaction::kIsometric];
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (const Face& face : faces) {
        if (hovered && !pointed && is_on(face, mouse))
            pointed = face.view;
        list.AddConvexPolyFilled(face.corners.data(), 4,
                                 packed(pointed == face.view ? Ink::chosen : Ink::control));
        list.AddPolyline(face.corners.data(), 4, packed(Ink::columns), ImDrawFlags_Closed, 1.2f);
        paint_name(face, turn);
    }
    if (tip_of_cube)
        list.AddCircleFilled(*tip_of_cube, 4.0f,
                             packed(hovered && near_tip() ? Ink::accent : Ink::columns));
    if (pointed) {
        tip(pointed == &interaction::axis_views()[interaction::kIsometric]
                ? "look from a corner (9)"
                : (std::string("look from ") + pointed->name + " (8)").c_str());
        if (pressed)
            commands.room_from_physical = seen_from(*pointed, model.asked.room_from_physical,
                                                    physical_center(model.info.grid), model.head);
    }
    ImGui::End();
    ImGui::PopStyleVar();
    return corner.x;
}

} // namespace isochron::app
