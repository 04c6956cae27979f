// What is exported as files for other programs.
#include "app/panel/parts/export_section.h"

#include "app/panel/panel_words.h"
#include "app/panel/parts/icons.h"
#include "app/panel/parts/rows.h"
#include "app/panel/parts/written_pictures.h"
#include "index/export/surface_writer.h"
#include "interaction/step_track.h"

#include <fmt/format.h>
#include <imgui.h>

#include <string>
#include <vector>

namespace isochron::app {
namespace {

using interaction::Commands;
using interaction::ExportedSteps;
using interaction::ExportWork;

constexpr float kExportField = 190.0f;

void steps_row(const PanelModel& model, interaction::SurfaceExport& exported) {
    const auto steps = static_cast<std::uint32_t>(model.asked.known_steps(model.info.steps()));
    const interaction::StepRange& range = model.asked.play_range;
    const std::vector<std::string> words{
        "this time",
        fmt::format("steps {} to {}", first_of(range, steps) + 1, last_of(range, steps) + 1)};
    const std::vector<std::string> notes{interaction::name_of(model.asked.shown_instant()),
                                         "the range that plays"};
    row("what");
    ImGui::SetNextItemWidth(kExportField);
    if (const auto chosen =
            choice_field("##what", words[static_cast<std::size_t>(exported.steps)], words,
                         "the surfaces that are shown, at these steps", notes))
        exported.steps = static_cast<ExportedSteps>(*chosen);
}

void format_row(interaction::SurfaceExport& exported) {
    std::vector<std::string> names, notes;
    for (const index::SurfaceFormat& format : index::surface_formats()) {
        names.emplace_back(format.name);
        notes.emplace_back(format.words);
    }
    row("format");
    ImGui::SetNextItemWidth(kExportField);
    if (const auto chosen = choice_field("##format", exported.format, names,
                                         "which programs read the files", notes))
        exported.format = names[*chosen];
}

void export_rows(const PanelModel& model, Commands& commands) {
    if (model.asked.exporting.goes_on) {
        ImGui::ProgressBar(static_cast<float>(model.asked.exporting.percent) / 100.0f,
                           {160.0f, 0.0f});
        ImGui::SameLine();
        if (ImGui::Button("Cancel"))
            commands.exporting = ExportWork{};
        tip("stop: files that are whole stay (Ctrl + X)");
        return;
    }
    interaction::WrittenPictures pictures = model.asked.pictures;
    steps_row(model, pictures.surfaces);
    format_row(pictures.surfaces);
    if (model.asked.clip.shown || model.asked.clip_box.shown) {
        row("clip plane");
        tick_field("##clip", pictures.surfaces.clipped, "cuts them, too");
        tip("leave out the triangles that the clip plane cuts away");
    }
    folder_row(pictures);
    if (pictures != model.asked.pictures)
        commands.pictures = pictures;
    if (ImGui::Button("Export")) {
        commands.exporting = ExportWork{.goes_on = true};
        ImGui::CloseCurrentPopup();
    }
    tip("write the surfaces in the background (Ctrl + X)");
}

} // namespace

void export_button(const PanelModel& model, Commands& commands) {
    if (icon_button("export", Icon::send, "export the surfaces for other programs",
                    model.asked.exporting.goes_on))
        ImGui::OpenPopup("exports");
    if (!ImGui::BeginPopup("exports"))
        return;
    popup_title("Export surfaces");
    export_rows(model, commands);
    ImGui::EndPopup();
}

} // namespace isochron::app
