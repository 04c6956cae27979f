// The panel's sections: data, objects, surfaces, color and view.
#include "app/panel/parts/sections.h"
#include "app/panel/parts/session_field.h"

#include "app/config/first_placement.h"
#include "app/panel/panel_help.h"
#include "app/panel/panel_statistics.h"
#include "app/panel/panel_words.h"
#include "app/panel/parts/color_section.h"
#include "app/panel/parts/named_list.h"
#include "app/panel/parts/objects_section.h"
#include "app/panel/parts/rows.h"
#include "app/panel/parts/surfaces_section.h"
#include "app/panel/parts/theme.h"
#include "app/panel/parts/time_track.h"
#include "app/panel/parts/view_cube.h"
#include "app/scene/look.h"
#include "app/text.h"
#include "interaction/navigation/navigation.h"
#include "interaction/navigation/navigator.h"
#include "interaction/tools/tool_table.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <utility>

namespace isochron::app {
namespace {

using interaction::Commands;

/// The array that is shown, and the others to choose from.
void array_row(const PanelModel& model, PanelPages& pages, Commands& commands) {
    std::vector<std::string> words(model.arrays.names.begin(), model.arrays.names.end());
    if (words.size() < 2 && !pages.offers_arrays)
        return text_row("array", model.info.array);
    if (words.empty())
        words.push_back(model.info.array);
    const std::size_t count = words.size();
    words.emplace_back("all arrays ...");
    row("array");
    const auto chosen = choice_field("##array", words[model.arrays.asked], words,
                                     "array whose isosurfaces are shown (Ctrl + A: the next one, "
                                     "Ctrl + Shift + A: all of them)",
                                     model.arrays.notes);
    if (chosen == count)
        pages.arrays = true;
    else if (chosen && *chosen != model.arrays.asked)
        interaction::merge(commands, model.arrays.way_to(*chosen));
}

/// Opens a model; those that are open stand among the objects.
void model_row(PanelPages& pages) {
    if (!pages.offers_files)
        return;
    row("models");
    if (ImGui::Button("open ...##model", {ImGui::CalcItemWidth(), 0.0f}))
        pages.files = true;
    tip("triangles of a file beside the surfaces, in the data's coordinates: STL, PLY, OBJ, VTP, "
        "glTF; or drop the file here. The list of objects has those that are open");
}

void data_section(const PanelModel& model, PanelPages& pages, Commands& commands) {
    const index::SeriesInfo& info = model.info;
    array_row(model, pages, commands);
    text_row("values", range_text(model.stats.low, model.stats.high, info.value_unit));
    if (const std::string missing = missing_text(model.stats.nan_values, info); !missing.empty()) {
        text_row("missing", missing + ": holes there");
        tip("values that are missing (NaN), in all steps: a surface has a hole there");
    }
    const glm::dvec3 size = physical_size(info.grid);
    text_row("size", lengths_text({size.x, size.y, size.z}, info.length_unit));
    text_row("grid", grid_words(info));
    if (const std::string gaps = gaps_words(model); !gaps.empty()) {
        text_row("gaps", gaps);
        tip(gaps_in_words(model).c_str());
    }
    model_row(pages);
    if (model.sessions.empty())
        return;
    row("sessions");
    if (const auto chosen = session_field(
            "##sessions", fmt::format("{} earlier", model.sessions.size()), model.sessions)) {
        pages.session = chosen;
        interaction::merge(commands, model.sessions[*chosen].commands);
    }
}

/// A row with the names of an enumeration.
template <class Value>
void named_row(const char* label, Value& value, const char* effect) {
    const std::vector<std::string> words = interaction::all_names<Value>();
    row(label);
    const std::string id = fmt::format("##{}", label);
    if (const auto chosen =
            choice_field(id.c_str(), words[static_cast<std::size_t>(value)], words, effect))
        value = static_cast<Value>(*chosen);
}

/// Where the light comes from, as two angles.
void light_row(interaction::Look& look) {
    const std::array<double, 2> usual = light_angles(render::CellAppearance{}.key_direction);
    std::array<double, 2> angles = look.light.value_or(usual);
    constexpr float kReset = 22.0f;
    row("light", look.light ? kReset + 6.0f : 0.0f);
    const float width = (ImGui::CalcItemWidth() - ImGui::GetStyle().ItemSpacing.x) / 2;
    ImGui::SetNextItemWidth(width);
    bool turned = number_field("##turn", angles[0], {.low = -180, .high = 180}, "turn %.0f\u00b0");
    tip("from where the light comes: to the right of the viewer, in degrees");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(width);
    turned |= number_field("##height", angles[1], {.low = -90, .high = 90}, "height %.0f\u00b0");
    tip("how high above the floor the light stands, in degrees");
    if (turned)
        look.light = angles;
    if (!look.light)
        return;
    ImGui::SameLine();
    if (icon_button("usual light", Icon::close, "the usual light again", false, kReset))
        look.light.reset();
}

void look_rows(const PanelModel& model, Commands& commands) {
    interaction::Look look = model.asked.look;
    named_row("background", look.background,
              "what is behind the data: gray shows dark surfaces; with the light one the panel is "
              "light, too");
    named_row("material", look.material, "how surfaces shine");
    light_row(look);
    row("occlusion");
    share_field("##occlusion", look.occlusion);
    tip("ambient occlusion: how dark crevices are");
    if (look != model.asked.look)
        commands.look = look;
}

void projection_rows(const PanelModel& model, Commands& commands) {
    row("show");
    bool box = model.asked.bounding_box;
    if (tick_field("##box", box, "box"))
        commands.bounding_box = box;
    tip("the data's box, with ticks in their units (O)");
    ImGui::SameLine(0.0f, 14.0f);
    bool orthographic = model.asked.orthographic;
    if (tick_field("##parallel", orthographic, "parallel"))
        commands.orthographic = orthographic;
    tip("parallel (orthographic) projection (0)");
    row("heights");
    double exaggeration = model.asked.room_from_physical.exaggeration;
    if (number_field("##heights", exaggeration, {.low = 0.1, .high = 100, .logarithmic = true},
                     "x %.3g"))
        commands.room_from_physical = exaggerated(model.asked.room_from_physical,
                                                  physical_center(model.info.grid), exaggeration);
    tip("vertical exaggeration, along z (Ctrl + E, Ctrl + Shift + E)");
}

/// The saved viewpoints by name, each with a picture of how the data lie there.
void viewpoint_row(const PanelModel& model, Commands& commands) {
    auto views = model.asked.views;
    row("viewpoints");
    const std::string words =
        views.empty() ? std::string("save this one") : fmt::format("{} saved", views.size());
    if (ImGui::Button(words.c_str(), {ImGui::CalcItemWidth(), 0.0f})) {
        if (views.empty())
            commands.views = with_view(views, model.asked.room_from_physical);
        else
            ImGui::OpenPopup("viewpoints");
    }
    tip("places to look from, to come back to (B, N)");
    if (!ImGui::BeginPopup("viewpoints"))
        return;
    popup_title("Viewpoints");
    if (ImGui::MenuItem("save this viewpoint", "B"))
        commands.views = with_view(views, model.asked.room_from_physical);
    ImGui::Separator();
    std::vector<NamedRow> rows;
    for (const interaction::Viewpoint& each : views)
        rows.push_back({each.name, {}, each.room_from_physical == model.asked.room_from_physical});
    const NamedChange change =
        named_list(rows, "go to this viewpoint", [&](std::size_t i, const ImVec2& middle) {
            small_cube(model, views[i].room_from_physical, middle, 7.0f);
        });
    if (change.chosen)
        commands.room_from_physical = views[*change.chosen].room_from_physical;
    if (change.renamed)
        views[change.renamed->first].name = change.renamed->second;
    if (change.removed)
        views.erase(views.begin() + static_cast<std::ptrdiff_t>(*change.removed));
    if (change.renamed || change.removed)
        commands.views = views;
    ImGui::EndPopup();
}

/// Only where there is something to set: with one picture for both eyes there is none.
void stereo_rows(const PanelModel& model, Commands& commands) {
    if (model.asked.stereo_mode() == stereo::StereoMode::mono && !model.quad_buffered)
        return;
    const std::vector<std::string> modes = offered_stereo(model);
    row("stereo");
    if (const auto chosen = choice_field("##stereo", model.asked.stereo, modes,
                                         "how both eyes' pictures are shown (V)"))
        commands.stereo = modes[*chosen];
    row("eyes");
    float millimeters = model.asked.eye_separation * 1000.0f;
    if (number_field("##eyes", millimeters,
                     {.low = 0, .high = static_cast<double>(interaction::kWidestEyes) * 1000},
                     "%.0f mm"))
        commands.eye_separation = millimeters / 1000.0f;
    tip("distance between the eyes ( [ and ] )");
}

void hand_rows(const PanelModel& model, Commands& commands) {
    const auto has = [&](interaction::DeviceKind kind) {
        return std::ranges::find(model.at_hand, kind) != model.at_hand.end();
    };
    if (model.place != PanelPlace::in_room && !has(interaction::DeviceKind::hands) &&
        !has(interaction::DeviceKind::gamepad))
        return;
    std::vector<std::string> words;
    for (const interaction::ToolRow& each : interaction::tool_table())
        words.emplace_back(each.words);
    const std::string keys =
        fmt::format("what the hand's first button does ({})", interaction::tool_keys());
    interaction::Tools tools = model.asked.tools;
    const auto tool_row = [&](const char* label, const char* id, interaction::ToolKind& tool) {
        row(label);
        if (const auto chosen =
                choice_field(id, words[static_cast<std::size_t>(tool)], words, keys.c_str()))
            tool = interaction::tool_table()[*chosen].kind;
    };
    tool_row("right hand", "##right", tools.wand);
    tool_row("left hand", "##left", tools.other);
    if (tools != model.asked.tools)
        commands.tools = tools;
}

void view_section(const PanelModel& model, PanelPages&, Commands& commands) {
    interaction::QualityMode quality = model.asked.quality;
    named_row("quality", quality,
              "auto (1): the best that keeps up while something moves, then the exact surface\n"
              "fast (2): quads of all cells, always\n"
              "quality (3): the exact surface or triangles of all cells, however long they take");
    if (quality != model.asked.quality)
        commands.quality = quality;
    look_rows(model, commands);
    projection_rows(model, commands);
    viewpoint_row(model, commands);
    stereo_rows(model, commands);
    hand_rows(model, commands);
}

/// A section that opens nothing beside the panel.
template <void (*lay_out)(const PanelModel&, Commands&)>
void alone(const PanelModel& model, PanelPages&, Commands& commands) {
    lay_out(model, commands);
}

/// A line with the section's name, which folds it.
/// @param pointed the search points at it, so that it is open
/// @return whether it is open
bool section_line(const Section& section, bool pointed) {
    bool* const open = ImGui::GetStateStorage()->GetBoolRef(ImGui::GetID(section.name), true);
    *open = *open || pointed;
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x, height = ImGui::GetFrameHeight();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    if (ImGui::InvisibleButton(section.name, {width, height}))
        *open = !*open;
    if (ImGui::IsItemHovered())
        list.AddRectFilled(corner, {corner.x + width, corner.y + height},
                           ImGui::GetColorU32(ImGuiCol_FrameBg), 3.0f);
    const float middle = corner.y + height / 2;
    const ImU32 ink = packed(Ink::text);
    draw_icon(list, section.icon, {corner.x + 9.0f, middle}, 17.0f, packed(Ink::dim));
    list.AddText({corner.x + 26.0f, middle - ImGui::GetFontSize() / 2}, ink, section.name);
    const float x = corner.x + width - 9.0f;
    if (*open)
        list.AddTriangleFilled({x - 4, middle - 2}, {x + 4, middle - 2}, {x, middle + 3},
                               packed(Ink::dim));
    else
        list.AddTriangleFilled({x - 2, middle - 4}, {x - 2, middle + 4}, {x + 3, middle},
                               packed(Ink::dim));
    return *open;
}

} // namespace

std::vector<std::string> offered_stereo(const PanelModel& model) {
    std::vector<std::string> modes;
    for (const stereo::StereoMode mode : stereo::all_stereo_modes())
        if (upright(mode) != stereo::StereoMode::quadbuffer || model.quad_buffered)
            modes.emplace_back(stereo::name_of(mode));
    return modes;
}

const std::array<Section, kSections>& sections() {
    static constexpr std::array<Section, kSections> kAll{
        {{"Data", Icon::data, data_section},
         {"Objects", Icon::objects, alone<objects_section>},
         {"Surfaces", Icon::surfaces, surfaces_section},
         {"Color", Icon::color, alone<color_section>},
         {"View", Icon::view, view_section}}};
    return kAll;
}

void section_column(const PanelModel& model, PanelPages& pages, Commands& commands,
                    const std::optional<std::size_t>& pointed) {
    for (const Section& section : sections()) {
        const bool here = pointed && &section == &sections()[std::min(*pointed, kSections - 1)] &&
                          *pointed < kSections;
        const ImVec2 corner = ImGui::GetCursorScreenPos();
        if (here)
            ImGui::SetScrollHereY(0.0f);
        if (section_line(section, here)) {
            ImGui::PushID(section.name);
            section.lay_out(model, pages, commands);
            ImGui::PopID();
            ImGui::Dummy({0.0f, 2.0f});
        }
        if (here)
            point_at({corner.x - 4.0f, corner.y},
                     {corner.x + ImGui::GetContentRegionAvail().x + 4.0f,
                      ImGui::GetCursorScreenPos().y - 2.0f});
        if (&section != &sections().back())
            ImGui::Separator();
    }
    complaints(model);
}

void section_pages(const PanelModel& model, PanelPages& pages, Commands& commands,
                   std::optional<std::size_t>& pointed, float below) {
    constexpr int kFirst = 2; // the surfaces
    int* const page = ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("page"), kFirst);
    if (pointed && *pointed < kSections)
        *page = static_cast<int>(*std::exchange(pointed, {}));
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    const float width = (ImGui::GetContentRegionAvail().x - (kSections - 1) * gap) / kSections;
    for (int i = 0; i < static_cast<int>(kSections); ++i) {
        if (i > 0)
            ImGui::SameLine();
        const bool chosen = i == *page;
        if (chosen)
            ImGui::PushStyleColor(ImGuiCol_Button, color_of(Ink::chosen));
        if (ImGui::Button(sections()[static_cast<std::size_t>(i)].name, {width, 0.0f}))
            *page = i;
        if (chosen)
            ImGui::PopStyleColor();
    }
    ImGui::Dummy({0.0f, 1.0f});
    const Section& section = sections()[static_cast<std::size_t>(*page)];
    ImGui::BeginChild(section.name, {0.0f, -below});
    section.lay_out(model, pages, commands);
    if (model.place == PanelPlace::in_room && section.lay_out == view_section &&
        ImGui::CollapsingHeader("hands"))
        controls_of(std::array{interaction::DeviceKind::hands}, model.controls);
    complaints(model); // below all controls, so that it does not move them
    ImGui::EndChild();
}

} // namespace isochron::app
