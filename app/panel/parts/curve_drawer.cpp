// The drawer of curves: numbers of the shown surfaces over all steps.
#include "app/panel/parts/curve_drawer.h"

#include "app/panel/panel_words.h"
#include "app/panel/parts/curve_plot.h"
#include "app/panel/parts/histogram.h"
#include "app/panel/parts/icons.h"
#include "app/panel/parts/rows.h"
#include "app/panel/parts/theme.h"
#include "app/panel/parts/time_track.h"
#include "app/text.h"
#include "index/file/color_source.h"
#include "index/measure/measures.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace isochron::app {
namespace {

using interaction::Commands;
using interaction::CurveDrawer;

constexpr float kWithTable = 560.0f; ///< width of a drawer that has room for the table

/// A number that can be plotted.
struct Choice {
    std::string name;      ///< as in CurveDrawer
    std::size_t number;    ///< its place in the curves' numbers
    std::string unit, tip; ///< its unit, and what it means
};

/// A surface that has a curve.
struct Drawn {
    const StepCurve* curve;
    ImU32 color;
    std::string words; ///< its isovalue
    bool picked;
};

/// What the drawer shows in this frame.
struct Shown {
    std::vector<Choice> choices;
    std::size_t chosen = 0;
    std::vector<Drawn> surfaces;

    const Choice& choice() const { return choices[chosen]; }
    bool is_mark() const { return choice().name == kMarkCurve; }
    bool is_profile() const { return choice().name == kProfileCurve; }
    /// One of the surfaces' measures.
    bool is_measure() const { return !is_mark() && !is_profile(); }
};

std::vector<Choice> choices_of(const PanelModel& model) {
    std::vector<Choice> choices;
    const auto first = std::ranges::find_if(model.curves.surfaces,
                                            [](const auto& each) { return each != nullptr; });
    std::optional<std::size_t> other;
    std::string other_unit, other_name;
    if (first != model.curves.surfaces.end() && (*first)->subject.on_surface) {
        other = (*first)->subject.on_surface;
        const index::ColorSource source(*(*first)->subject.array, *other);
        other_unit = source.array().value_unit;
        other_name = source.array().array;
    }
    const std::span<const index::Measure> all = index::measures();
    for (std::size_t i = 0; i < all.size(); ++i)
        if (is_measured(all[i], other.has_value(), model.asked.mark.point.has_value()))
            choices.push_back(
                {std::string(all[i].name), i, unit_of(all[i], model.info, other_unit),
                 std::string(all[i].definition) + (all[i].unit == index::MeasureUnit::value
                                                       ? fmt::format(" ({})", other_name)
                                                       : std::string())});
    if (model.curves.mark)
        choices.push_back({std::string(kMarkCurve), 0,
                           model.curves.mark->subject.array->info().value_unit,
                           "value at the mark, and when it crosses the isovalues"});
    const interaction::Ruler* const ruler = model.asked.rulers.chosen();
    if (ruler && ruler->complete())
        choices.push_back({std::string(kProfileCurve), 0, model.info.value_unit,
                           "values along the picked ruler, and where they cross the isovalues"});
    return choices;
}

/// Its isovalue, with its array where that is not the shown one.
std::string words_of(const PanelModel& model, std::size_t surface) {
    const index::SeriesInfo& info = model.info_of(surface);
    return (model.arrays.of(surface) ? info.array + " " : "") +
           with_unit(model.asked.isosurfaces[surface].isovalue, info.value_unit, info.digits);
}

Shown shown_in(const PanelModel& model) {
    Shown shown{.choices = choices_of(model), .surfaces = {}};
    const auto chosen = std::ranges::find(shown.choices, model.asked.curves.measure, &Choice::name);
    const auto usual = std::ranges::find(shown.choices, CurveDrawer{}.measure, &Choice::name);
    shown.chosen = static_cast<std::size_t>((chosen == shown.choices.end() ? usual : chosen) -
                                            shown.choices.begin());
    const auto& isosurfaces = model.asked.isosurfaces;
    for (std::size_t i = 0; i < std::min(isosurfaces.size(), model.curves.surfaces.size()); ++i)
        if (const StepCurvePtr& curve = model.curves.surfaces[i])
            shown.surfaces.push_back({curve.get(), line_color(isosurfaces[i]), words_of(model, i),
                                      model.asked.picked == i});
    return shown;
}

/// Counts have all their digits. @param digits most significant ones of other numbers
std::string number_text(double value, const std::string& unit, int digits = index::kFewestDigits) {
    constexpr double kMostCounted = 1e15;
    if (!std::isfinite(value))
        return "-";
    if (!unit.empty() || value != std::floor(value) || std::abs(value) > kMostCounted)
        return with_unit(value, unit, digits);
    return (value < 0 ? "-" : "") + grouped(static_cast<std::uint64_t>(std::abs(value)));
}

double at_step(const StepCurve& curve, std::size_t number, std::uint32_t step) {
    return step < curve.steps() ? curve.values[number][step] : std::nan("");
}

void choose(const PanelModel& model, const Choice& choice, Commands& commands) {
    CurveDrawer drawer = model.asked.curves;
    drawer.measure = choice.name;
    commands.curves = drawer;
}

/// What `isochron measure --crop` has for the box.
std::string box_words(const index::VertexBox& box) {
    return fmt::format("in the box: {}:{},{}:{},{}:{}", box.first[0], box.last[0], box.first[1],
                       box.last[1], box.first[2], box.last[2]);
}

/// `ruler 2, 12.5 m, t 2.9 s`
std::string profile_words(const PanelModel& model) {
    const interaction::Ruler* const ruler = model.asked.rulers.chosen();
    if (!model.curves.profile)
        return "reading ...";
    const index::Profile& profile = *model.curves.profile;
    if (profile.values.empty())
        return "a ruler of no length";
    return fmt::format("ruler {}, {}, {}", ruler ? ruler->name : std::string(),
                       with_unit(profile.distances.back(), model.info.length_unit),
                       time_of(model, profile.query.instant));
}

/// How far the curves are, or why they are not whole.
void state_of(const PanelModel& model, const Shown& shown, float width) {
    std::size_t steps = 0, left = 0;
    const auto count = [&](const StepCurve& curve) {
        steps = curve.steps();
        left = std::max(left, curve.left);
    };
    if (shown.is_mark())
        count(*model.curves.mark);
    else if (shown.is_measure())
        for (const Drawn& each : shown.surfaces)
            count(*each.curve);
    if (width <= 0)
        return;
    ImGui::AlignTextToFramePadding();
    if (!model.curves.failure.empty())
        fitted_text(model.curves.failure, width, color_of(Ink::warning));
    else if (left > 0)
        fitted_text(fmt::format("{} of {} steps", steps - left, steps), width, color_of(Ink::dim));
    else if (shown.is_profile())
        fitted_text(profile_words(model), width, color_of(Ink::dim));
    else if (shown.surfaces.empty() && !shown.is_mark())
        fitted_text(model.asked.clip_box.shown ? "no whole cell in the box" : "no surface is shown",
                    width, color_of(Ink::dim));
    else if (!shown.is_mark() && shown.surfaces.front().curve->subject.box)
        fitted_text(box_words(*shown.surfaces.front().curve->subject.box), width,
                    color_of(Ink::dim));
    else
        text("");
}

void header(const PanelModel& model, const Shown& shown, Commands& commands) {
    constexpr float kChoice = 190.0f;
    std::vector<std::string> words, notes;
    const std::uint32_t now = model.asked.shown_instant().step;
    for (const Choice& choice : shown.choices) {
        words.push_back(words_of_measure(choice.name));
        const StepCurve* curve = choice.name == kMarkCurve ? model.curves.mark.get() : nullptr;
        for (const Drawn& each : shown.surfaces)
            if (!curve || (each.picked && choice.name != kMarkCurve))
                curve = each.curve;
        if (choice.name == kProfileCurve)
            curve = nullptr;
        notes.push_back(curve ? number_text(at_step(*curve, choice.number, now), choice.unit)
                              : choice.unit);
    }
    const float whole = ImGui::GetContentRegionAvail().x;
    ImGui::SetNextItemWidth(std::min(kChoice, whole / 2));
    if (const auto chosen = choice_field("##measure", words[shown.chosen], words,
                                         shown.choice().tip.c_str(), notes))
        choose(model, shown.choices[*chosen], commands);
    ImGui::SameLine();
    const bool logarithmic = model.asked.curves.logarithmic;
    if (ImGui::Button(logarithmic ? "log" : "lin", {36.0f, 0.0f})) {
        commands.curves = model.asked.curves;
        commands.curves->logarithmic = !logarithmic;
    }
    tip("axis of the numbers: logarithmic or linear");
    const bool saves = model.curves.save && model.place != PanelPlace::in_room;
    const float button = ImGui::GetFrameHeight(), gap = ImGui::GetStyle().ItemSpacing.x;
    const float buttons = button + (saves ? button + gap : 0);
    ImGui::SameLine();
    const float end = ImGui::GetWindowContentRegionMax().x;
    state_of(model, shown, end - buttons - gap - ImGui::GetCursorPosX());
    ImGui::SameLine(end - buttons);
    if (saves) {
        if (icon_button("save curves", Icon::send,
                        shown.is_profile() ? "save the values along the ruler as a table (CSV)"
                                           : "save all measures of all steps as a table (CSV)",
                        false, button))
            model.curves.save();
        ImGui::SameLine();
    }
    if (icon_button("close curves", Icon::close, "close the curves (Ctrl + D)", false, button)) {
        commands.curves = model.asked.curves;
        commands.curves->shown = false;
    }
}

void swatch(ImU32 color) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float side = ImGui::GetFontSize() - 4.0f;
    ImGui::GetWindowDrawList()->AddRectFilled(
        {corner.x, corner.y + 2.0f}, {corner.x + side, corner.y + 2.0f + side}, color, 2.0f);
    ImGui::Dummy({side, ImGui::GetFontSize()});
    ImGui::SameLine(0.0f, 5.0f);
}

/// What the pointed step has.
void tip_of_step(const PanelModel& model, const Shown& shown, std::uint32_t step) {
    ImGui::BeginTooltip();
    text(fmt::format("step {}: {}", step + 1, time_of(model, index::Instant(step))));
    if (shown.is_mark()) {
        text(number_text(at_step(*model.curves.mark, 0, step), shown.choice().unit));
    } else {
        for (const Drawn& each : shown.surfaces) {
            swatch(each.color);
            text(fmt::format("{}{}", shown.surfaces.size() > 1 ? each.words + ":  " : std::string(),
                             number_text(at_step(*each.curve, shown.choice().number, step),
                                         shown.choice().unit)));
        }
    }
    ImGui::EndTooltip();
}

void go_to(const PanelModel& model, index::Instant at, Commands& commands) {
    if (at == model.asked.shown_instant())
        return;
    show(at, commands);
    if (model.asked.playback.playing) {
        commands.playback = model.asked.playback;
        commands.playback->playing = false;
    }
}

void plot(const PanelModel& model, const Shown& shown, const ImVec2& size, Commands& commands) {
    const std::size_t steps = last_step(model) + 1;
    PlottedCurves curves{.times = std::span(model.info.times).first(steps),
                         .time_unit = model.info.time_unit,
                         .unit = shown.choice().unit,
                         .lines = {},
                         .levels = {},
                         .logarithmic = model.asked.curves.logarithmic,
                         .now = model.asked.shown_instant()};
    const auto values = [&](const StepCurve& curve) {
        const auto& all = curve.values[shown.choice().number];
        return std::span(all).first(std::min(all.size(), steps));
    };
    if (shown.is_mark()) {
        curves.lines.push_back({values(*model.curves.mark), packed(Ink::text)});
        for (const Drawn& each : shown.surfaces)
            if (each.curve->subject.array == model.curves.mark->subject.array)
                curves.levels.push_back({each.curve->subject.isovalue, each.color});
    } else {
        for (const Drawn& each : shown.surfaces)
            curves.lines.push_back({values(*each.curve), each.color, each.picked});
    }
    const PlotUse use = curve_plot(curves, size);
    if (!use.pointed)
        return;
    tip_of_step(model, shown, *use.pointed);
    if (use.pressed)
        go_to(model, index::Instant(*use.pointed), commands);
}

/// The values along the ruler; a press marks the place.
void profile_plot(const PanelModel& model, const Shown& shown, const ImVec2& size,
                  Commands& commands) {
    const index::Profile& profile = *model.curves.profile;
    PlottedCurves curves{.times = profile.distances,
                         .time_unit = model.info.length_unit,
                         .unit = shown.choice().unit,
                         .lines = {{profile.values, packed(Ink::text)}},
                         .levels = {},
                         .logarithmic = model.asked.curves.logarithmic};
    for (const interaction::Isosurface& each : model.asked.isosurfaces)
        if (each.opacity > 0)
            curves.levels.push_back({each.isovalue, line_color(each)});
    ImGui::PushID("profile"); // its zoom is its own
    const PlotUse use = curve_plot(curves, size);
    ImGui::PopID();
    if (!use.pointed)
        return;
    const double value = profile.values[*use.pointed];
    ImGui::BeginTooltip();
    text(with_unit(profile.distances[*use.pointed], model.info.length_unit));
    text(number_text(value, shown.choice().unit));
    ImGui::EndTooltip();
    const interaction::MarkedPoint point{
        .position = profile.at[*use.pointed], .instant = profile.query.instant, .value = value};
    if (use.pressed && std::isfinite(value) && model.asked.mark.point != point)
        commands.mark = interaction::Mark{point};
}

/// Where the values along the ruler cross the isovalues.
void profile_crossings(const PanelModel& model, const ImVec2& size) {
    const index::Profile& profile = *model.curves.profile;
    ImGui::BeginChild("crossings", size);
    for (const interaction::Isosurface& each : model.asked.isosurfaces) {
        if (each.opacity <= 0)
            continue;
        const std::string words =
            with_unit(each.isovalue, model.info.value_unit, model.info.digits);
        const std::vector<Crossing> all = crossings_of(profile.values, each.isovalue);
        swatch(line_color(each));
        fitted_text((all.empty() ? "never crosses " : "crosses ") + words,
                    ImGui::GetContentRegionAvail().x, color_of(Ink::text));
        for (const Crossing& at : all) {
            const double step = profile.distances[1] - profile.distances[0];
            text(fmt::format(
                "   at {} {}",
                with_unit(profile.distances[at.step] + at.share * step, model.info.length_unit),
                at.rises ? "rising" : "falling"));
        }
    }
    ImGui::EndChild();
}

/// The number in the most digits for which there is room, three at least, so that it is not cut.
std::string number_within(float width, double value, const std::string& unit) {
    constexpr int kFewest = 3;
    int digits = index::kFewestDigits;
    std::string words = number_text(value, unit);
    while (--digits >= kFewest && ImGui::CalcTextSize(words.c_str()).x > width)
        words = number_text(value, unit, digits);
    return words;
}

/// Whether hidden pieces leave the volume of the first surface undefined, so that it is to be said why.
bool unknown_volume(const Shown& shown, const Choice& choice, std::uint32_t step) {
    if (!choice.name.starts_with("volume") || shown.surfaces.empty())
        return false;
    const StepCurve& curve = *shown.surfaces.front().curve;
    return step < curve.steps() && curve.known[step] && !curve.subject.kept.keeps_all() &&
           !curve.subject.clip && std::isnan(at_step(curve, choice.number, step));
}

/// The numbers of the present step: a line for each measure, a column for each surface.
void table(const PanelModel& model, const Shown& shown, const ImVec2& size, Commands& commands) {
    constexpr float kName = 104.0f;
    const auto columns = std::min<std::size_t>(shown.surfaces.size(), 4);
    if (!ImGui::BeginTable("now", static_cast<int>(columns) + 1,
                           ImGuiTableFlags_ScrollY | ImGuiTableFlags_NoSavedSettings |
                               ImGuiTableFlags_NoPadOuterX,
                           size))
        return;
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, kName);
    for (std::size_t i = 0; i < columns; ++i)
        ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    const std::uint32_t now = model.asked.shown_instant().step;
    fitted_text(fmt::format("step {}", now + 1), kName, color_of(Ink::dim));
    for (std::size_t i = 0; i < columns; ++i) {
        ImGui::TableNextColumn();
        swatch(shown.surfaces[i].color);
        fitted_text(shown.surfaces[i].words, ImGui::GetContentRegionAvail().x, color_of(Ink::dim));
    }
    for (std::size_t k = 0; k < shown.choices.size(); ++k) {
        const Choice& choice = shown.choices[k];
        ImGui::PushID(static_cast<int>(k));
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        if (table_line(k == shown.chosen) != LinePress::none && k != shown.chosen)
            choose(model, choice, commands);
        tip(unknown_volume(shown, choice, now) ? "not known: a piece that is hidden, and one that "
                                                 "is shown, end at the data's border"
                                               : choice.tip.c_str());
        ImGui::SameLine(0.0f, 0.0f);
        text(words_of_measure(choice.name));
        const bool of_mark = choice.name == kMarkCurve;
        if (choice.name == kProfileCurve) {
            ImGui::PopID();
            continue;
        }
        for (std::size_t i = 0; i < columns; ++i) {
            ImGui::TableNextColumn();
            if (of_mark && i > 0)
                continue;
            const StepCurve& curve = of_mark ? *model.curves.mark : *shown.surfaces[i].curve;
            const float width = ImGui::GetContentRegionAvail().x;
            fitted_text(number_within(width, at_step(curve, choice.number, now), choice.unit),
                        width, color_of(k == shown.chosen ? Ink::text : Ink::dim));
        }
        ImGui::PopID();
    }
    ImGui::EndTable();
}

/// When the value at the mark crosses the isovalues; a press goes there.
void crossings(const PanelModel& model, const Shown& shown, const ImVec2& size,
               Commands& commands) {
    ImGui::BeginChild("crossings", size);
    const StepCurve& mark = *model.curves.mark;
    const auto steps =
        std::span(mark.values[0])
            .first(std::min<std::size_t>(mark.steps(), std::size_t{last_step(model)} + 1));
    int id = 0;
    for (const Drawn& each : shown.surfaces) {
        if (each.curve->subject.array != mark.subject.array)
            continue;
        swatch(each.color);
        const std::vector<Crossing> all = crossings_of(steps, each.curve->subject.isovalue);
        fitted_text(all.empty() ? "never crosses " + each.words : "crosses " + each.words,
                    ImGui::GetContentRegionAvail().x, color_of(Ink::text));
        for (const Crossing& at : all) {
            const index::Instant instant{
                at.step, std::min(static_cast<std::uint32_t>(at.share * index::Instant::kFractions),
                                  interaction::kMostFraction)};
            ImGui::PushID(id++);
            if (ImGui::Selectable(fmt::format("   {} {}", time_of(model, instant),
                                              at.rises ? "rising" : "falling")
                                      .c_str()))
                go_to(model, model.asked.blends() ? instant : index::Instant(at.step), commands);
            ImGui::PopID();
        }
    }
    ImGui::EndChild();
}

} // namespace

std::string words_of_measure(std::string_view name) {
    if (name == kMarkCurve)
        return "value at the mark";
    if (name == kProfileCurve)
        return "values along the ruler";
    if (name == kDistanceCurve)
        return "mark to surface";
    std::string words(name);
    std::ranges::replace(words, '-', ' ');
    return words;
}

void curve_drawer(const PanelModel& model, Commands& commands) {
    const Shown shown = shown_in(model);
    header(model, shown, commands);
    const ImVec2 room = ImGui::GetContentRegionAvail();
    constexpr float kLeastHeight = 40.0f, kLeastWidth = 120.0f; // for a plot
    if (room.x < kLeastWidth || room.y < kLeastHeight)
        return;
    const float gap = 12.0f;
    const auto columns = static_cast<float>(std::clamp<std::size_t>(shown.surfaces.size(), 1, 4));
    const float beside =
        room.x >= kWithTable ? std::min(110.0f + 96.0f * columns, 0.45f * room.x) : 0.0f;
    const ImVec2 corner = ImGui::GetCursorPos();
    const ImVec2 size(room.x - (beside > 0 ? beside + gap : 0), room.y);
    const bool plotted = model.curves.profile && !model.curves.profile->values.empty();
    if (shown.is_profile() && !plotted)
        return;
    if (shown.is_profile())
        profile_plot(model, shown, size, commands);
    else
        plot(model, shown, size, commands);
    if (beside == 0)
        return;
    ImGui::SetCursorPos({corner.x + room.x - beside, corner.y});
    if (shown.is_profile())
        profile_crossings(model, {beside, room.y});
    else if (shown.is_mark())
        crossings(model, shown, {beside, room.y}, commands);
    else
        table(model, shown, {beside, room.y}, commands);
}

} // namespace isochron::app
