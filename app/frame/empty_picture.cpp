// Why a picture shows no surface.
#include "app/frame/empty_picture.h"

#include "app/config/config.h"
#include "app/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>

namespace isochron::app {
namespace {

using interaction::Commands;
using interaction::Isosurface;

bool is_visible(const Isosurface& surface) {
    return surface.opacity > 0;
}

/// The surface that a way out is about: the picked one if it is visible, else the first visible one.
std::uint32_t spoken_of(const interaction::Settings& settings) {
    const auto& surfaces = settings.isosurfaces;
    if (is_visible(surfaces[settings.picked]))
        return settings.picked;
    return static_cast<std::uint32_t>(std::ranges::find_if(surfaces, is_visible) -
                                      surfaces.begin());
}

/// The number of active cells of all surfaces that are not hidden.
std::uint64_t visible_cells(const PictureFacts& facts) {
    std::uint64_t cells = 0;
    for (std::size_t i = 0; i < facts.settings.isosurfaces.size() && i < facts.cells.size(); ++i)
        if (is_visible(facts.settings.isosurfaces[i]))
            cells += facts.cells[i];
    return cells;
}

/// Whether all that is known of the step is of the step itself, and not of the one before a blend.
bool is_of_the_instant(const PictureFacts& facts) {
    return facts.step && !facts.settings.shown_instant().between();
}

EmptyBecause why_no_cells(const PictureFacts& facts, double isovalue) {
    using enum EmptyBecause;
    if (!(isovalue >= facts.low && isovalue <= facts.high))
        return outside;
    if (!is_of_the_instant(facts))
        return no_cells;
    if (!facts.step->has_values())
        return no_values_in_step;
    if (facts.step->is_constant() && facts.step->whole)
        return constant_in_step;
    return isovalue < facts.step->low || isovalue > facts.step->high ? outside : no_cells;
}

std::optional<EmptyBecause> reason(const PictureFacts& facts) {
    using enum EmptyBecause;
    if (!facts.has_values)
        return no_values;
    if (facts.low == facts.high)
        return constant;
    if (std::ranges::none_of(facts.settings.isosurfaces, is_visible))
        return hidden;
    if (visible_cells(facts) == 0 && facts.pieces_hidden)
        return pieces_hidden;
    if (visible_cells(facts) == 0)
        return why_no_cells(facts, facts.settings.isosurfaces[spoken_of(facts.settings)].isovalue);
    switch (facts.sight) {
    case Sight::behind: return behind;
    case Sight::out_of_view: return out_of_view;
    case Sight::too_small: return too_small;
    case Sight::in_view:
    case Sight::surface_aside: break;
    }
    if (facts.cut_away)
        return cut_away;
    return facts.sight == Sight::surface_aside ? std::optional(surface_aside) : std::nullopt;
}

std::string range_words(double low, double high, bool about) {
    return (about ? "about " : "") + range_text(low, high);
}

void offer(EmptyPicture& empty, std::string way, Commands commands) {
    empty.way = std::move(way);
    empty.commands = std::move(commands);
}

void offer_other_array(EmptyPicture& empty, const PictureFacts& facts) {
    if (!facts.other_array.empty())
        offer(empty, "Show " + facts.other_array, facts.to_other_array);
}

void offer_other_step(EmptyPicture& empty, const PictureFacts& facts) {
    if (!facts.step || !facts.step->other_step)
        return offer_other_array(empty, facts);
    Commands commands;
    commands.instant.emplace(*facts.step->other_step);
    commands.playback = facts.settings.playback;
    commands.playback->playing = false;
    offer(empty, fmt::format("Go to step {}", *facts.step->other_step + 1), std::move(commands));
}

/// An isovalue at which this instant has a surface or, where nothing is known of the instant, at which
/// the series has values.
std::optional<double> isovalue_with_surface(const PictureFacts& facts) {
    return facts.step ? surface_in(*facts.step, kFirstQuantile) : std::nullopt;
}

void offer_isovalue(EmptyPicture& empty, const PictureFacts& facts) {
    const auto isovalue = isovalue_with_surface(facts);
    if (!isovalue)
        return offer_other_step(empty, facts);
    Commands commands;
    const std::uint32_t surface = spoken_of(facts.settings);
    if (surface != facts.settings.picked)
        commands.picked = surface;
    commands.isovalue = *isovalue;
    offer(empty, "Go to " + human_number(*isovalue), std::move(commands));
}

/// `No surface at 500`, or at the isovalues of several surfaces.
std::string at_isovalues(const PictureFacts& facts) {
    std::string words;
    for (const Isosurface& surface : facts.settings.isosurfaces)
        if (is_visible(surface))
            words += (words.empty() ? "No surface at " : " or ") +
                     with_unit(surface.isovalue, {}, index::telling_digits(facts.low, facts.high));
    return words;
}

void say_values(EmptyPicture& empty, const PictureFacts& facts) {
    const bool known = is_of_the_instant(facts) && facts.step->has_values();
    const std::string range =
        known ? range_words(facts.step->low, facts.step->high, !facts.step->whole)
              : range_words(facts.low, facts.high, false);
    empty.sentence = at_isovalues(facts) + ": values are " + range + with_space(facts.unit) +
                     (known ? "." : " at all steps.");
    offer_isovalue(empty, facts);
}

Commands with_opacity(const interaction::Settings& settings) {
    Commands commands;
    commands.isosurfaces = settings.isosurfaces;
    (*commands.isosurfaces)[settings.picked].opacity = 1.0f;
    return commands;
}

} // namespace

std::string nothing_to_show(const std::string& array, bool has_values, double value,
                            const std::string& unit) {
    return has_values ? fmt::format("{} is {} everywhere", array, with_unit(value, unit))
                      : array + " has no values";
}

const char* short_words(EmptyBecause why) {
    constexpr std::array<const char*, kEmptyBecause> kWords{
        "no values",   "no surface",  "hidden",     "hidden",   "no values",
        "no surface",  "no surface",  "no surface", "cut away", "out of view",
        "out of view", "out of view", "out of view"};
    return kWords[static_cast<std::size_t>(why)];
}

std::optional<EmptyPicture> why_empty(const PictureFacts& facts) {
    using enum EmptyBecause;
    const auto why = reason(facts);
    if (!why)
        return std::nullopt;
    EmptyPicture empty{.why = *why, .sentence = {}, .way = {}, .commands = {}};
    const std::uint32_t step = facts.settings.shown_instant().step + 1;
    const auto show_all = [&](const char* sentence) {
        empty.sentence = sentence;
        Commands commands;
        commands.room_from_physical = facts.all_in_view;
        offer(empty, "Show all", std::move(commands));
    };
    switch (*why) {
    case no_values:
        empty.sentence = nothing_to_show(facts.array, false, 0, "") + ", so it has no surface.";
        offer_other_array(empty, facts);
        break;
    case constant:
        empty.sentence =
            nothing_to_show(facts.array, true, facts.low, facts.unit) + ", so it has no surface.";
        offer_other_array(empty, facts);
        break;
    case hidden:
        empty.sentence = facts.settings.isosurfaces.size() > 1
                             ? "All surfaces are hidden: their opacity is 0 %."
                             : "The surface is hidden: its opacity is 0 %.";
        offer(empty, "Show it", with_opacity(facts.settings));
        break;
    case pieces_hidden: {
        empty.sentence = "All pieces of the surface are hidden.";
        Commands commands;
        commands.pieces = interaction::ShownPieces{};
        offer(empty, "Show all pieces", std::move(commands));
        break;
    }
    case no_values_in_step:
        empty.sentence = fmt::format("{} has no values in step {}.", facts.array, step);
        offer_other_step(empty, facts);
        break;
    case constant_in_step:
        empty.sentence =
            fmt::format("{} in step {}, so it has no surface.",
                        nothing_to_show(facts.array, true, facts.step->low, facts.unit), step);
        offer_other_step(empty, facts);
        break;
    case outside:
    case no_cells: say_values(empty, facts); break;
    case cut_away: {
        Commands commands;
        if (facts.settings.clip_box.shown) {
            empty.sentence = "The clip box cuts everything away.";
            commands.clip_box = interaction::ClipBox{};
            offer(empty, "Remove the box", std::move(commands));
            break;
        }
        empty.sentence = "The clip plane cuts everything away.";
        commands.clip = facts.settings.clip;
        commands.clip->normal = -commands.clip->normal;
        offer(empty, "Show the other side", std::move(commands));
        break;
    }
    case behind: show_all("The data are behind you."); break;
    case out_of_view: show_all("The data are outside the view."); break;
    case surface_aside: show_all("The surface is outside the view."); break;
    case too_small: show_all("The data are too far away to be seen."); break;
    }
    return empty;
}

} // namespace isochron::app
