// The models in the panel.
#include "app/panel/parts/model_lines.h"

#include "app/panel/panel_words.h"
#include "app/panel/parts/icons.h"
#include "app/panel/parts/rows.h"
#include "app/panel/parts/theme.h"

#include <fmt/format.h>
#include <imgui.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace isochron::app {
namespace {

using interaction::Model;

constexpr float kModelIcon = 22.0f, kModelOpacity = 54.0f;

/// Shows and hides a model; one that lies elsewhere is opened.
void model_eye(const PanelModel& model, const ListedModel& line, Model& shown) {
    const bool seen = shown.shown && line.fault.empty();
    if (!icon_button("eye", seen ? Icon::eye : Icon::eye_shut,
                     line.refused ? "open this model, though it lies outside of the data's folder"
                     : seen       ? "hide this model"
                                  : "show this model",
                     false, kModelIcon))
        return;
    if (line.refused && model.models.allow)
        model.models.allow(shown.path);
    shown.shown = line.refused || !shown.shown;
}

/// @return whether the model is to go
bool model_row(const PanelModel& model, const ListedModel& line, Model& shown) {
    ImGui::ColorEdit3("##color", &shown.color.x,
                      ImGuiColorEditFlags_NoInputs | ImGuiColorEditFlags_NoTooltip);
    tip("its color");
    ImGui::SameLine();
    model_eye(model, line, shown);
    ImGui::SameLine();
    const float gap = ImGui::GetStyle().ItemSpacing.x, width = ImGui::GetContentRegionAvail().x;
    const float left = ImGui::GetCursorPosX();
    constexpr float kEdges = 68.0f;
    ImGui::AlignTextToFramePadding();
    fitted_text(std::filesystem::path(shown.path).filename().string(),
                width - kModelOpacity - kModelIcon - kEdges - 3 * gap,
                color_of(line.fault.empty() ? Ink::text : Ink::warning));
    tip(line.fault.empty() ? fmt::format("{}\n{}", shown.path, line.words).c_str()
                           : line.fault.c_str());
    ImGui::SameLine(left + width - kModelOpacity - kModelIcon - kEdges - 2 * gap);
    tick_field("##lines", shown.lines, "edges");
    tip("the edges of its triangles, not their faces");
    ImGui::SameLine(left + width - kModelOpacity - kModelIcon - gap);
    ImGui::SetNextItemWidth(kModelOpacity);
    share_field("##opacity", shown.opacity);
    tip("opacity");
    ImGui::SameLine();
    return icon_button("remove", Icon::remove, "remove this model", false, kModelIcon);
}

} // namespace

void model_lines(const PanelModel& model, PanelPages& pages, interaction::Commands& commands) {
    std::vector<Model> models = model.asked.models;
    if (models.empty() && !pages.offers_files)
        return;
    row("models");
    if (pages.offers_files) {
        if (ImGui::Button("open ...##model", {ImGui::CalcItemWidth(), 0.0f}))
            pages.files = true;
        tip("triangles of a file beside the surfaces, in the data's coordinates: STL, PLY, OBJ, "
            "VTP, "
            "glTF; or drop the file here");
    } else {
        text(fmt::format("{}", models.size()));
    }
    std::optional<std::size_t> removed;
    for (std::size_t i = 0; i < models.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        const ListedModel line =
            i < model.models.lines.size() ? model.models.lines[i] : ListedModel{};
        if (model_row(model, line, models[i]))
            removed = i;
        ImGui::PopID();
    }
    if (removed)
        models.erase(models.begin() + static_cast<std::ptrdiff_t>(*removed));
    if (models != model.asked.models)
        commands.models = std::move(models);
}

} // namespace isochron::app
