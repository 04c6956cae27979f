// Icons of the panel, drawn as lines.
#include "app/panel/parts/icons.h"

#include "app/panel/panel_words.h"
#include "app/panel/parts/theme.h"

#include <array>
#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

namespace isochron::app {
namespace {

constexpr std::array<const char*, static_cast<std::size_t>(Icon::count)> kPaths{
    "M 3 19 L 3 5 L 9 5 L 11 8 L 19 8 L 19 11 M 3 19 L 7 11 L 22 11 L 18 19 Z",   // open
    "M 9 5 L 4 10 L 9 15 M 4 10 L 15 10 L 19 12 L 20 15 L 19 18 L 15 20 L 10 20", // undo
    "M 15 5 L 20 10 L 15 15 M 20 10 L 9 10 L 5 12 L 4 15 L 5 18 L 9 20 L 14 20",  // redo
    "O 12 12 9 D 12 12 5",                                                        // record
    "M 3 7 L 8 7 L 10 4 L 14 4 L 16 7 L 21 7 L 21 19 L 3 19 Z O 12 13 3.6",       // picture
    "M 3 5 L 21 5 L 21 19 L 3 19 Z M 7 5 L 7 19 M 17 5 L 17 19 M 3 12 L 7 12 "    // movie
    "M 17 12 L 21 12",
    "O 10.5 10.5 6.5 M 15.5 15.5 L 21 21",                                               // search
    "O 12 12 9.5 M 9 9.5 L 10 7.6 L 12 7 L 14 7.6 L 15 9.5 L 14 11.2 L 12 12.5 L 12 14 " // help
    "D 12 17 1.2",
    "D 12 5 1.7 D 12 12 1.7 D 12 19 1.7",                                        // menu
    "M 6 6 L 18 18 M 18 6 L 6 18",                                               // close
    "M 2 12 L 6 8 L 12 6 L 18 8 L 22 12 L 18 16 L 12 18 L 6 16 Z D 12 12 3",     // eye
    "M 2 12 L 6 8 L 12 6 L 18 8 L 22 12 L 18 16 L 12 18 L 6 16 Z M 4 20 L 20 4", // eye_shut
    "M 12 5 L 12 19 M 5 12 L 19 12",                                             // add
    "M 6 5 L 6 19 M 18 5 L 18 19 L 9 12 F",                                      // first
    "M 16 5 L 16 19 L 7 12 F",                                                   // back
    "M 7 4 L 20 12 L 7 20 F",                                                    // play
    "M 6 5 L 10 5 L 10 19 L 6 19 F M 14 5 L 18 5 L 18 19 L 14 19 F",             // pause
    "M 8 5 L 17 12 L 8 19 F",                                                    // forward
    "M 18 5 L 18 19 M 6 5 L 15 12 L 6 19 F",                                     // last
    "M 17 3 L 20 6 L 17 9 M 20 6 L 6 6 L 4 8 L 4 12 M 7 21 L 4 18 L 7 15 M 4 18 L 18 18 " // loop
    "L 20 16 L 20 12",
    "M 4 7 L 12 3 L 20 7 L 20 17 L 12 21 L 4 17 Z M 4 7 L 12 11 L 20 7 M 12 11 L 12 21", // data
    "D 4 6 1.8 M 9 6 L 21 6 D 4 12 1.8 M 9 12 L 21 12 D 4 18 1.8 M 9 18 L 21 18",        // objects
    "M 2 16 L 7 8 L 12 6 L 17 8 L 22 16 M 6 19 L 9 13 L 12 11.5 L 15 13 L 18 19",        // surfaces
    "M 12 3 L 17 10 L 18 14 L 16 19 L 12 21 L 8 19 L 6 14 L 7 10 Z M 12 21 L 12 3",      // color
    "O 12 12 4.5 M 12 1.5 L 12 4.5 M 12 19.5 L 12 22.5 M 1.5 12 L 4.5 12 M 19.5 12 "     // view
    "L 22.5 12 M 4.6 4.6 L 6.7 6.7 M 17.3 17.3 L 19.4 19.4 M 4.6 19.4 L 6.7 17.3 "
    "M 17.3 6.7 L 19.4 4.6",
    "M 12 3 L 12 21 M 9 7 L 3 12 L 9 17 F M 15 7 L 21 12 L 15 17 Z",            // flip
    "M 5 7 L 19 7 M 9 7 L 9 4 L 15 4 L 15 7 M 7 7 L 8 20 L 16 20 L 17 7",       // remove
    "M 3 12 L 21 12 M 7 8 L 3 12 L 7 16 M 17 8 L 21 12 L 17 16",                // to_and_fro
    "O 9 12 6 O 15 12 6",                                                       // blend
    "M 7 21 L 7 4 M 7 4 L 18 7 L 7 11",                                         // bookmark
    "M 14 21 L 14 4 M 14 4 L 22 7 L 14 11 M 9 10 L 3 15 L 9 20",                // bookmark_back
    "M 4 21 L 4 4 M 4 4 L 12 7 L 4 11 M 15 10 L 21 15 L 15 20",                 // bookmark_forward
    "M 12 20 L 12 5 M 6 11 L 12 5 L 18 11",                                     // up
    "M 4 12 L 19 12 M 13 6 L 19 12 L 13 18",                                    // go
    "M 10 5 L 4 5 L 4 20 L 19 20 L 19 14 M 11 13 L 21 3 M 14 3 L 21 3 L 21 10", // send
    "M 3 3 L 3 20 L 22 20 M 6 15 L 10 8 L 14 12 L 21 4"};                       // curves

/// Draws the steps of one path.
struct Pen {
    ImDrawList& list;
    ImVec2 corner;
    float unit;
    ImU32 color;
    std::vector<ImVec2> points = {};

    ImVec2 place(float x, float y) const { return {corner.x + unit * x, corner.y + unit * y}; }
    float thickness() const { return 1.75f * unit; }
    void finish(char how) {
        const int count = static_cast<int>(points.size());
        if (how == 'F')
            list.AddConvexPolyFilled(points.data(), count, color);
        else if (count > 1)
            list.AddPolyline(points.data(), count, color,
                             how == 'Z' ? ImDrawFlags_Closed : ImDrawFlags_None, thickness());
        points.clear();
    }
};

} // namespace

IconPath::IconPath(Icon icon) : steps(kPaths[static_cast<std::size_t>(icon)]) {}

void draw_icon(ImDrawList& list, IconPath icon, const ImVec2& middle, float size, ImU32 color) {
    Pen pen{list, {middle.x - size / 2, middle.y - size / 2}, size / 24.0f, color};
    std::istringstream path{std::string(icon.steps)};
    char step = 0;
    float x = 0, y = 0, radius = 0;
    while (path >> step) {
        if (step == 'Z' || step == 'F') {
            pen.finish(step);
            continue;
        }
        path >> x >> y;
        if (step == 'M')
            pen.finish('M');
        if (step == 'M' || step == 'L') {
            pen.points.push_back(pen.place(x, y));
            continue;
        }
        path >> radius;
        if (step == 'O')
            list.AddCircle(pen.place(x, y), radius * pen.unit, color, 0, pen.thickness());
        else
            list.AddCircleFilled(pen.place(x, y), radius * pen.unit, color);
    }
    pen.finish('M');
}

bool icon_button(const char* id, IconPath icon, const char* tip_words, bool on, float side) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const bool pressed = ImGui::InvisibleButton(id, {side, side});
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const bool usable = ImGui::GetStyle().Alpha >= 1.0f;
    const bool hovered = ImGui::IsItemHovered();
    if (on || hovered)
        list.AddRectFilled(corner, {corner.x + side, corner.y + side},
                           ImGui::GetColorU32(ImGui::IsItemActive() ? ImGuiCol_ButtonActive
                                              : on                  ? ImGuiCol_Header
                                                                    : ImGuiCol_ButtonHovered),
                           ImGui::GetStyle().FrameRounding);
    const Ink ink = !usable ? Ink::dim : on ? Ink::accent : Ink::text;
    draw_icon(list, icon, {corner.x + side / 2, corner.y + side / 2}, 0.64f * side,
              ImGui::GetColorU32(color_of(ink)));
    if (*tip_words != '\0')
        tip(tip_words);
    return pressed;
}

} // namespace isochron::app
