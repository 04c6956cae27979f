// The control panel.
#include "app/panel/panel.h"

#include "app/config/config.h"
#include "app/config/first_placement.h"
#include "app/panel/number_entry.h"
#include "app/panel/panel_colors.h"
#include "app/panel/panel_help.h"
#include "app/panel/panel_statistics.h"
#include "app/panel/panel_tools.h"
#include "app/panel/panel_words.h"
#include "app/scene/mark.h"
#include "app/text.h"
#include "index/volume/time_unit.h"
#include "interaction/navigation/axis_views.h"
#include "interaction/navigation/navigation.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace isochron::app {
namespace {

using interaction::Commands;

constexpr float kDocked = 380.0f, kLeast = 260.0f; ///< width of the docked panel, at most, at least
constexpr ImU32 kBarColor = IM_COL32(120, 128, 140, 255);
constexpr ImU32 kAskedColor = IM_COL32(255, 196, 92, 255);
constexpr ImU32 kShownColor = IM_COL32(120, 220, 160, 255);
const ImVec4 kPaper(0.115f, 0.125f, 0.145f, 1.0f);

/// The number of the picked surface among the shown surfaces; fewer may be shown than are asked
/// for.
std::size_t shown_surface(const PanelModel& model) {
    return std::min<std::size_t>(model.asked.picked, model.frame.shown->isovalues.size() - 1);
}

/// Histogram of all values with logarithmic counts; pressing or dragging picks an isovalue.
void histogram(const PanelModel& model, Commands& commands) {
    const auto& bins = model.stats.histogram;
    const ImVec2 size(ImGui::GetContentRegionAvail().x, 64.0f);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("histogram", size);
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->AddRectFilled(corner, {corner.x + size.x, corner.y + size.y}, IM_COL32(20, 22, 26, 255),
                        3.0f);
    if (bins.empty())
        return;
    const auto most = static_cast<double>(*std::max_element(bins.begin(), bins.end()));
    const float width = size.x / static_cast<float>(bins.size());
    for (std::size_t bin = 0; bin < bins.size(); ++bin) {
        const double height =
            std::log1p(static_cast<double>(bins[bin])) / std::log1p(std::max(most, 1.0));
        const float x = corner.x + width * static_cast<float>(bin);
        list->AddRectFilled({x, corner.y + size.y * static_cast<float>(1.0 - height)},
                            {x + width, corner.y + size.y}, kBarColor);
    }
    // Halves keep the span finite for any two doubles.
    const double low = model.stats.low, high = model.stats.high, half_span = high / 2 - low / 2;
    const auto mark = [&](double value, ImU32 color) {
        const double at =
            half_span > 0 ? std::clamp((value / 2 - low / 2) / half_span, 0.0, 1.0) : 0.5;
        const float x = corner.x + size.x * static_cast<float>(at);
        list->AddLine({x, corner.y}, {x, corner.y + size.y}, color, 2.0f);
    };
    if (model.frame.shown)
        mark(model.frame.shown->isovalues[shown_surface(model)], kShownColor);
    mark(model.asked.isovalue(), kAskedColor);
    const double pointed = std::lerp(
        low, high, std::clamp((ImGui::GetIO().MousePos.x - corner.x) / size.x, 0.0f, 1.0f));
    if (ImGui::IsItemActive() && half_span > 0)
        commands.isovalue = pointed;
    if (ImGui::IsItemHovered() && half_span > 0)
        ImGui::SetTooltip("%s", with_unit(pointed, model.info.value_unit).c_str());
}

/// The format of a number with its unit for ImGui's sliders, with the unit's percent signs escaped.
std::string slider_format(const std::string& unit) {
    std::string format = unit.empty() ? "%.6g" : "%.6g ";
    for (char c : unit)
        format += c == '%' ? "%%" : std::string(1, c);
    return format;
}

/// Whether the panel is so narrow that lines are broken and words left out.
bool is_narrow() {
    return ImGui::GetWindowWidth() < 340.0f;
}

/// A line with the value asked for and the value shown. @param what their name
void asked_and_shown(const char* what, const std::string& asked, const std::string& shown) {
    state_note(fmt::format("{}asked {}{}shown {}", is_narrow() ? "" : fmt::format("{}: ", what),
                           asked, is_narrow() ? " " : "   ", shown),
               kDim);
}

void isovalue_section(const PanelModel& model, Commands& commands) {
    histogram(model, commands);
    ImGui::SetNextItemWidth(-1.0f);
    double value = model.asked.isovalue();
    // Beyond half of the doubles' range ImGui gives up.
    constexpr double kMost = std::numeric_limits<double>::max() / 2;
    const double low = std::clamp(model.stats.low, -kMost, kMost);
    const double high = std::clamp(model.stats.high, -kMost, kMost);
    if (ImGui::SliderScalar("##isovalue", ImGuiDataType_Double, &value, &low, &high,
                            slider_format(model.info.value_unit).c_str()))
        commands.isovalue = value;
    tip("isovalue of the selected surface (Up, Down); Ctrl + click to type it");
    const auto& shown = model.frame.shown;
    const double asked = model.asked.isovalue();
    if (asked < model.stats.low || asked > model.stats.high)
        return state_note(fmt::format("outside the data's range, {} to {}",
                                      human_number(model.stats.low),
                                      with_unit(model.stats.high, model.info.value_unit)),
                          kWarning);
    asked_and_shown("isovalue", with_unit(asked, model.info.value_unit),
                    shown ? with_unit(shown->isovalues[shown_surface(model)], model.info.value_unit)
                          : "nothing yet");
}

void playback_buttons(const PanelModel& model, Commands& commands) {
    interaction::PlaybackState playback = model.asked.playback;
    const auto last = static_cast<std::uint32_t>(model.asked.known_steps(model.info.steps()) - 1);
    const auto go_to = [&](std::uint32_t step) {
        commands.step = step;
        playback.playing = false;
    };
    if (ImGui::Button("|<"))
        go_to(0);
    tip("first step");
    ImGui::SameLine();
    if (ImGui::Button("<"))
        go_to(model.asked.step == 0 ? (playback.loop ? last : 0) : model.asked.step - 1);
    tip("one step back (Left)");
    ImGui::SameLine();
    if (ImGui::Button(playback.playing ? "Pause" : " Play "))
        playback.playing = !playback.playing;
    tip("play or pause (Space)");
    ImGui::SameLine();
    if (ImGui::Button(">"))
        go_to(model.asked.step == last ? (playback.loop ? 0 : last) : model.asked.step + 1);
    tip("one step forward (Right)");
    ImGui::SameLine();
    if (ImGui::Button(">|"))
        go_to(last);
    tip("last step");
    if (!is_narrow())
        ImGui::SameLine();
    ImGui::Checkbox("reverse", &playback.reverse);
    tip("play backwards (R)");
    ImGui::SameLine();
    ImGui::Checkbox("loop", &playback.loop);
    tip("start again after the last step (L)");
    auto speed = static_cast<float>(playback.speed);
    if (is_narrow())
        ImGui::SameLine();
    ImGui::SetNextItemWidth(is_narrow() ? 60.0f : -150.0f);
    if (ImGui::SliderFloat("speed", &speed, 1.0f / 64, 64.0f, "x %.3g",
                           ImGuiSliderFlags_Logarithmic))
        playback.speed = speed;
    tip("how fast time plays (+, -)");
    if (!is_narrow())
        ImGui::SameLine();
    if (bool follow = model.asked.follow; ImGui::Checkbox("follow", &follow)) {
        commands.follow = follow;
        if (follow)
            commands.step = last;
    }
    tip("always show the newest step (End)");
    if (playback != model.asked.playback)
        commands.playback = playback;
}

void time_section(const PanelModel& model, Commands& commands) {
    const auto& times = model.info.times;
    const int last = static_cast<int>(model.asked.known_steps(times.size())) - 1;
    int number = static_cast<int>(model.asked.step) + 1; // people count from 1
    ImGui::SetNextItemWidth(-1.0f);
    ImGui::BeginDisabled(last == 0);
    const std::string format = fmt::format("step %d of {}", last + 1);
    if (whole_number_slider("##step", &number, 1, last + 1, format.c_str()))
        commands.step = static_cast<std::uint32_t>(number - 1);
    tip("step (Left, Right); marks below: steps in memory");
    mark_steps_at_hand(model, last);
    const auto& shown = model.frame.shown;
    const auto time = [&](std::uint32_t at) {
        return index::time_text(times, at, model.info.time_unit);
    };
    asked_and_shown("time", time(model.asked.step), shown ? time(shown->step) : "nothing yet");
    playback_buttons(model, commands);
    ImGui::EndDisabled();
}

void view_buttons(const PanelModel& model, Commands& commands) {
    for (std::size_t i = 0; i < interaction::kAxisViews; ++i) {
        const interaction::AxisView& view = interaction::axis_views()[i];
        if (ImGui::SmallButton(view.name))
            commands.room_from_physical = seen_from(view, model.asked.room_from_physical,
                                                    physical_center(model.info.grid), model.head);
        tip("look along this axis (8, 9)");
        ImGui::SameLine();
    }
    bool orthographic = model.asked.orthographic;
    if (ImGui::Checkbox("parallel", &orthographic))
        commands.orthographic = orthographic;
    tip("parallel (orthographic) projection (0)");
    auto exaggeration = static_cast<float>(model.asked.room_from_physical.exaggeration);
    ImGui::SetNextItemWidth(-60.0f);
    if (ImGui::SliderFloat("heights", &exaggeration, 0.1f, 100.0f, "x %.3g",
                           ImGuiSliderFlags_Logarithmic))
        commands.room_from_physical = exaggerated(model.asked.room_from_physical,
                                                  physical_center(model.info.grid), exaggeration);
    tip("vertical exaggeration, along z (Ctrl+E, Ctrl+Shift+E)");
}

void view_section(const PanelModel& model, Commands& commands) {
    int mode = static_cast<int>(model.asked.quality);
    ImGui::SetNextItemWidth(110.0f);
    constexpr auto& kModes = interaction::kNames<interaction::QualityMode>;
    const auto mode_name = [](void*, int i, const char** text) {
        *text = kModes[static_cast<std::size_t>(i)].data();
        return true;
    };
    if (ImGui::Combo("quality", &mode, mode_name, nullptr, static_cast<int>(kModes.size())))
        commands.quality = static_cast<interaction::QualityMode>(mode);
    tip("auto (1): quads while something moves, then the best that fits the frame's time\n"
        "fast (2): always quads\nquality (3): always the best, however long it takes");
    const bool settled = model.frame.pace == interaction::Pace::settled;
    if (model.place == PanelPlace::in_room)
        ImGui::SameLine();
    // The footprint depends on what is drawn, such as the panel in the room, which cannot name it.
    state_note(model.place == PanelPlace::in_room ? name_of(model.frame.pace)
                                                  : quality_line(model.frame),
               settled ? ImVec4(0.47f, 0.86f, 0.63f, 1.0f) : ImVec4(1.0f, 0.77f, 0.36f, 1.0f));
    ImGui::SetNextItemWidth(-60.0f);
    const std::string& current = model.asked.stereo;
    const bool open = ImGui::BeginCombo("stereo", current.c_str());
    if (!open)
        tip("stereo mode (V)");
    if (open) {
        for (stereo::StereoMode candidate : stereo::all_stereo_modes()) {
            if (upright(candidate) == stereo::StereoMode::quadbuffer && !model.quad_buffered)
                continue;
            const std::string name(stereo::name_of(candidate));
            if (ImGui::Selectable(name.c_str(), candidate == model.asked.stereo_mode()))
                commands.stereo = name;
        }
        ImGui::EndCombo();
    }
    // In the room users walk around the data, and the panel has no line to spare.
    if (model.place != PanelPlace::in_room)
        view_buttons(model, commands);
    float millimeters = model.asked.eye_separation * 1000.0f;
    ImGui::SetNextItemWidth(-60.0f);
    if (ImGui::SliderFloat("eyes", &millimeters, 0.0f, interaction::kWidestEyes * 1000.0f,
                           "%.0f mm", ImGuiSliderFlags_AlwaysClamp))
        commands.eye_separation = millimeters / 1000.0f;
    tip("distance between the eyes ( [ and ] )");
}

/// The place that the user picked, with a button to remove it.
void mark_section(const PanelModel& model, Commands& commands) {
    const auto& point = model.asked.mark.point;
    if (!point)
        return;
    note(fmt::format("picked: {}", mark_text(*point, model.info)), kDim);
    if (ImGui::SmallButton("isovalue here"))
        commands.isovalue = point->value;
    tip("set the isovalue to that of the picked point");
    ImGui::SameLine();
    if (ImGui::SmallButton("remove mark"))
        commands.mark = interaction::Mark{};
    tip("remove the mark of the picked point");
    ImGui::Separator();
}

void page_buttons(PanelPages& pages) {
    ImGui::SameLine();
    if (pages.offers_files) {
        pages.files = ImGui::Button("Open");
        tip("other data (Ctrl + O)");
        ImGui::SameLine();
    }
    pages.help = ImGui::Button("?");
    tip("help: keys, mouse and devices (F1)");
}

} // namespace

std::string quality_line(const FrameReport& frame) {
    // Fast mode draws quads in motion and at rest.
    const bool fast = frame.reason == QualityReason::fast_mode;
    std::string line =
        fmt::format("{}: {}", fast ? "fast" : name_of(frame.pace), name_of(frame.footprint));
    if (frame.expected)
        line += fmt::format(", {:.1f} of {:.1f} ms", frame.expected->count(), frame.budget.count());
    if (frame.reason == QualityReason::over_budget && frame.better)
        line += fmt::format(" (the next better one takes {:.1f} ms)", frame.better->count());
    // The line already tells that the picture moves or fits.
    else if (!fast && frame.reason != QualityReason::moving && frame.reason != QualityReason::fits)
        line += fmt::format(" ({})", name_of(frame.reason));
    return line;
}

Commands draw_panel(const PanelModel& model, PanelArea& area, PanelPages& pages) {
    Commands commands;
    ImGuiWindowFlags flags = ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoSavedSettings;
    if (model.place == PanelPlace::over) {
        // Docked: at the left, as high as the picture; its arrow folds it.
        const ImVec2 picture = ImGui::GetIO().DisplaySize;
        ImGui::SetNextWindowPos({0.0f, 0.0f});
        ImGui::SetNextWindowSize(
            {std::min({kDocked, std::max(kLeast, 0.45f * picture.x), 0.9f * picture.x}),
             picture.y});
        // In a narrow picture it begins folded, as it would hide the data.
        const bool narrow = picture.x < 1.5f * kLeast;
        if (std::exchange(area.narrow, narrow) != narrow)
            ImGui::SetNextWindowCollapsed(narrow);
        ImGui::SetNextWindowBgAlpha(0.86f);
        flags |= ImGuiWindowFlags_NoMove;
    } else {
        ImGui::SetNextWindowPos({0.0f, 0.0f});
        ImGui::SetNextWindowSize(ImGui::GetIO().DisplaySize);
        ImGui::SetNextWindowBgAlpha(1.0f);
        ImGui::PushStyleColor(ImGuiCol_WindowBg, kPaper);
        flags |= ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse;
    }
    // A replay knows nothing of being recorded.
    const bool recording = model.recording && model.place != PanelPlace::in_room;
    const std::string title =
        fmt::format("Isochron: {}{}###panel", model.info.array, recording ? " (recording)" : "");
    ImGui::Begin(title.c_str(), nullptr, flags);
    history_section(model, commands);
    ImGui::SameLine();
    if (ImGui::Button("Screenshot"))
        commands.screenshot = true;
    tip("save a picture of every window (P)");
    if (model.place != PanelPlace::in_room)
        page_buttons(pages);
    array_section(model, commands);
    isovalue_section(model, commands);
    surfaces_section(model, commands);
    ImGui::Separator();
    coloring_section(model, commands);
    ImGui::Separator();
    time_section(model, commands);
    ImGui::Separator();
    mark_section(model, commands);
    // In the room this section begins folded, so that users need not scroll.
    const bool in_room = model.place == PanelPlace::in_room;
    if (ImGui::CollapsingHeader("tools", in_room ? 0 : ImGuiTreeNodeFlags_DefaultOpen))
        tools_section(model, commands);
    view_section(model, commands);
    if (model.movies.offered && !in_room && ImGui::CollapsingHeader("movies"))
        pages.movie = movie_section(model);
    ImGui::Separator();
    if (model.place != PanelPlace::in_room) {
        if (ImGui::CollapsingHeader("statistics")) {
            measurements(model);
            newest_note(model);
        }
        complaints(model);
    }
    if (in_room && ImGui::CollapsingHeader("hands"))
        controls_of(std::array{interaction::DeviceKind::hands}, model.controls);
    if (model.place == PanelPlace::in_room) // below all controls, so that it does not move them
        complaints(model);
    const ImVec2 corner = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
    area = {.left = corner.x,
            .top = corner.y,
            .right = corner.x + size.x,
            .bottom = corner.y + size.y,
            .title = ImGui::GetFrameHeight(),
            .narrow = area.narrow};
    ImGui::End();
    if (model.place != PanelPlace::over)
        ImGui::PopStyleColor();
    return commands;
}

} // namespace isochron::app
