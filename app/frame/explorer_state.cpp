// The settings of a session, and what they ask of the data.
#include "app/frame/explorer_state.h"

#include "index/export/surface_writer.h"
#include "index/volume/step_gaps.h"
#include "interaction/command_fields.h"
#include "interaction/navigation/key_frames.h"
#include "interaction/navigation/navigation.h"
#include "interaction/recording/commands_json.h"
#include "render/passes/color_map.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <concepts>
#include <numeric>
#include <span>
#include <string_view>

namespace isochron::app {
namespace {

using interaction::Field;

static_assert(interaction::kMostIsosurfaces == index::kMostSurfaces,
              "what commands may ask for is what is searched and drawn");

// Whether a value is valid: numbers are finite and within their field's limits.

template <class T>
bool holds(const Field& field, const T& value) {
    if constexpr (std::integral<T> || std::floating_point<T>) {
        const auto number = static_cast<double>(value);
        return std::isfinite(number) && number >= field.low && number <= field.high;
    } else {
        return true;
    }
}
bool holds(const Field& field, const std::string& text) {
    return text.size() <= std::max(field.most, interaction::kLongestText);
}
bool holds(const Field&, const glm::dvec3& place) {
    return std::isfinite(place.x) && std::isfinite(place.y) && std::isfinite(place.z);
}
template <class T>
bool holds(const Field& field, const std::vector<T>& list) {
    return list.size() >= field.least && list.size() <= field.most &&
           std::ranges::all_of(list, [&](const T& one) { return holds(field, one); });
}
bool holds(const Field& field, const std::vector<interaction::Isosurface>& surfaces) {
    return surfaces.size() >= field.least && surfaces.size() <= field.most &&
           std::ranges::all_of(surfaces, [](const interaction::Isosurface& surface) {
               return std::isfinite(surface.isovalue) && holds(Field{"", 0, 1}, surface.opacity) &&
                      surface.array.size() <= interaction::kLongestArrayName;
           });
}
bool are_percentiles(const std::array<double, 2>& ends) {
    return 0 <= ends[0] && ends[0] < ends[1] && ends[1] <= 100;
}
bool holds(const Field&, const interaction::Coloring& coloring) {
    const auto& colors = coloring.colors;
    return coloring.bands <= interaction::kMostBands &&
           colors.size() <= interaction::kMostMapColors &&
           (!coloring.percentiles || are_percentiles(*coloring.percentiles)) &&
           (!colors.empty() || render::color_map_from_name(coloring.map));
}
bool holds(const Field&, const interaction::Look& look) {
    return holds(Field{"", 0, 1}, look.occlusion);
}
bool holds(const Field&, const interaction::PlaybackState& playback) {
    return holds(Field{"", interaction::kSlowest, interaction::kFastest}, playback.speed) &&
           holds(Field{"", 1, interaction::kMostSkipped}, playback.every) &&
           holds(Field{"", interaction::kSlowestRate, interaction::kFastestRate}, playback.rate);
}
bool holds(const Field& field, const interaction::StepRange& range) {
    return range.first.value_or(0) <= field.high && range.last.value_or(0) <= field.high &&
           (!range.last || range.first.value_or(0) <= *range.last);
}
bool holds(const Field& field, const index::Instant& instant) {
    return holds(field, instant.step) && instant.fraction <= interaction::kMostFraction;
}
bool holds(const Field& field, const std::vector<interaction::Bookmark>& bookmarks) {
    return bookmarks.size() <= field.most &&
           std::ranges::all_of(bookmarks, [&](const interaction::Bookmark& bookmark) {
               return holds(field, bookmark.instant);
           });
}
bool holds(const Field&, const interaction::WrittenPictures& pictures) {
    return index::surface_format(pictures.surfaces.format) != nullptr;
}
bool holds(const Field&, const interaction::ExportWork& work) {
    return work.percent <= 100;
}
bool holds(const Field&, const interaction::Similarity& similarity) {
    return interaction::is_valid(similarity);
}
bool holds(const Field&, const interaction::RoomPanel& panel) {
    return is_finite(panel.pose);
}
/// A plane with a `point` and a unit `normal`.
bool is_plane(const Field& field, const auto& plane) {
    constexpr double kOff = 1e-6; ///< tolerance of a unit vector's length
    return holds(field, plane.point) && std::abs(glm::length(plane.normal) - 1) < kOff;
}
bool holds(const Field& field, const interaction::ClipPlane& clip) {
    return is_plane(field, clip);
}
bool holds(const Field& field, const interaction::ClipBox& box) {
    return holds(field, box.low) && holds(field, box.high) &&
           (!box.shown || glm::all(glm::lessThan(box.low, box.high)));
}
bool holds(const Field& field, const interaction::Slices& slices) {
    return slices.planes.size() <= interaction::kMostSlices &&
           slices.picked < interaction::kMostSlices && holds(field, slices.coloring) &&
           std::ranges::all_of(slices.planes, [&](const auto& p) { return is_plane(field, p); });
}
bool holds(const Field& field, const interaction::Mark& mark) {
    return !mark.point || holds(field, mark.point->instant);
}
bool holds(const Field& field, const std::vector<interaction::NamedMark>& marks) {
    return marks.size() <= field.most && std::ranges::all_of(marks, [&](const auto& mark) {
               return holds(field, mark.point.position) && holds(field, mark.point.instant) &&
                      std::isfinite(mark.point.value);
           });
}

/// A record that no rule above is for: each of its fields holds.
template <class T>
    requires requires(const T& record) {
        interaction::each_field([](const Field&, const auto&) {}, record);
    }
bool holds(const Field&, const T& record) {
    bool all = true;
    const auto check = [&](const Field& field, const auto& member) {
        all = all && holds(field, member);
    };
    interaction::each_field(check, record);
    return all;
}

bool holds(const Field& field, const std::vector<interaction::KeyFrame>& keys) {
    double rests = -interaction::kShortestMove; // until then the film rests at the key before
    return keys.size() <= field.most &&
           std::ranges::all_of(keys, [&](const interaction::KeyFrame& key) {
               const bool later = key.time >= rests + interaction::kShortestMove;
               rests = key.time + key.hold;
               bool all = later && rests <= interaction::kLongestFilm &&
                          (!key.step || holds(field, *key.step));
               const auto check = [&]<class T>(const Field& inner, const T& member) {
                   if constexpr (requires { member.has_value(); })
                       all = all && (!member || holds(inner, *member));
                   else
                       all = all && holds(inner, member);
               };
               interaction::each_field(check, key);
               return all;
           });
}

// @return false when the value is refused and `kept` unchanged

template <class T>
bool take(const Field& field, const T& given, T& kept) {
    const bool taken = holds(field, given);
    if (taken)
        kept = given;
    return taken;
}

/// The text is a name: a stereo mode with several names is kept by the first of them. Whether the
/// data have an array is known elsewhere.
bool take(const Field& field, const std::string& given, std::string& kept) {
    if (std::string_view(field.key) != "stereo") {
        kept = given;
        return true;
    }
    const auto mode = stereo::stereo_mode_from_name(given);
    if (mode)
        kept = stereo::name_of(*mode);
    return mode.has_value();
}

/// Sets what the commands hold. @param refused is called with each field whose value is invalid
template <class Refused>
void apply_to(ExplorerState& state, const interaction::Commands& commands, std::size_t held,
              const Refused& refused) {
    interaction::each_setting(
        [&](Field field, const auto& given, auto& kept) {
            const void* member = &kept;
            if (member == &state.picked)
                field.high = static_cast<double>(state.isosurfaces.size()) - 1;
            else if (member == &state.instant || member == &state.mark ||
                     member == &state.play_range || member == &state.bookmarks ||
                     member == &state.keys || member == &state.marks)
                field.high = static_cast<double>(state.known_steps(held)) - 1;
            else if (member == &state.steps)
                field.high = static_cast<double>(held);
            else if (member == &state.story)
                field.high = static_cast<double>(state.keys.size());
            if (given && !take(field, *given, kept))
                refused(field);
            state.picked =
                std::min(state.picked, static_cast<std::uint32_t>(state.isosurfaces.size() - 1));
            if (state.story > state.keys.size())
                state.story = 0;
        },
        commands, state);
    const Field fraction{"fraction", 0, interaction::kMostFraction};
    if (commands.fraction && !take(fraction, *commands.fraction, state.instant.fraction))
        refused(fraction);
    if (commands.isovalue &&
        !take({"isovalue"}, *commands.isovalue, state.isosurfaces[state.picked].isovalue))
        refused(Field{"isovalue"});
}

} // namespace

bool ExplorerState::apply(const interaction::Commands& commands, std::size_t held) {
    bool all_taken = true;
    apply_to(*this, commands, held, [&](const Field&) { all_taken = false; });
    return all_taken;
}

std::vector<std::string> ExplorerState::refusals(const interaction::Commands& commands,
                                                 std::size_t held) const {
    constexpr std::size_t kLongest = 120;
    const nlohmann::json all = interaction::commands_json(commands);
    std::vector<std::string> lines;
    ExplorerState trial = *this;
    apply_to(trial, commands, held, [&](const Field& field) {
        const auto value = all.find(field.key);
        std::string line =
            fmt::format("{} is {}", field.key,
                        value == all.end() ? "not there" : value->dump().substr(0, kLongest));
        if (std::string_view(field.key) == "clip" && commands.clip)
            line += fmt::format(", whose normal has a length of {:.6g}, expected 1",
                                glm::length(commands.clip->normal));
        else if (field.high < interaction::kAnyNumber && field.low > -interaction::kAnyNumber)
            line += fmt::format(", expected {:g} to {:g}", field.low, field.high);
        else if (field.high < interaction::kAnyNumber)
            line += fmt::format(", expected at most {:g}", field.high);
        lines.push_back(std::move(line));
    });
    return lines;
}

bool ExplorerState::resume(const interaction::Commands& kept, std::size_t held) {
    const bool whole = kept.room_from_physical.has_value(); // else a user wrote it
    if (whole && !kept.look)
        look = {.occlusion = 0.0f};
    if (whole && !kept.keys)
        keys.clear();
    if (whole && !kept.story)
        story = 0;
    return apply(kept, held);
}

std::size_t array_of_surface(const ExplorerState& state, std::size_t surface,
                             const index::IndexFile& file) {
    const std::string& own = state.isosurfaces[surface].array;
    const auto named = own.empty() ? std::nullopt : file.array_called(own);
    return named ? *named : file.array_called(state.array).value_or(0);
}

index::PieceFilter filter_of(const interaction::ShownPieces& pieces) {
    index::PieceFilter filter{.only = {}, .hidden = {}, .dust = pieces.dust};
    for (const interaction::PlacedPiece& each : pieces.only)
        filter.only.push_back({each.surface, each.place});
    for (const interaction::PlacedPiece& each : pieces.hidden)
        filter.hidden.push_back({each.surface, each.place});
    return filter;
}

index::SurfacesQuery ExplorerState::surfaces() const {
    index::SurfacesQuery query{shown_instant(), {}};
    switch (coloring.by) {
    case interaction::ColorBy::surface: break;
    case interaction::ColorBy::value: query.coloring = index::CellColoring::value; break;
    case interaction::ColorBy::first_crossing:
        query.coloring = blends() ? index::CellColoring::first_blended_crossing
                                  : index::CellColoring::first_crossing;
        break;
    }
    for (const interaction::Isosurface& surface : isosurfaces)
        query.isovalues.push_back(surface.of_shown_array() ? surface.isovalue : kNoSurface);
    query.pieces = filter_of(pieces);
    for (auto* const list : {&query.pieces.only, &query.pieces.hidden})
        std::erase_if(*list, [&](const index::PieceAt& piece) {
            return piece.surface < isosurfaces.size() &&
                   !isosurfaces[piece.surface].of_shown_array();
        });
    return query;
}

interaction::Commands ExplorerState::as_commands() const {
    interaction::Commands all;
    interaction::each_setting([](const Field&, auto& command, const auto& kept) { command = kept; },
                              all, *this);
    all.isovalue = isovalue();
    return all;
}

interaction::Commands ExplorerState::commands_to(const ExplorerState& target) const {
    return interaction::changes(*this, target, true);
}

interaction::Commands ExplorerState::way_to_start(const ExplorerState& start) const {
    interaction::Commands way = commands_to(start);
    way.quality.reset();
    way.stereo.reset();
    way.views.reset();
    way.keys.reset();
    way.tools.reset();
    way.steps.reset();
    way.follow.reset();
    way.models.reset();
    return way;
}

interaction::StepTimes known_times(const index::SeriesInfo& info, std::size_t steps) {
    const auto known = std::span(info.times).first(steps == 0 ? info.steps() : steps);
    return {{known.begin(), known.end()}, interaction::StepGaps(index::gaps_of(info, steps))};
}

double quantile(const index::IndexStats& stats, double share) {
    const auto& bins = stats.histogram;
    const auto total = std::accumulate(bins.begin(), bins.end(), std::uint64_t{0});
    std::uint64_t below = 0;
    for (std::size_t bin = 0; bin < bins.size(); ++bin) {
        below += bins[bin];
        if (static_cast<double>(below) >= share * static_cast<double>(total))
            return std::lerp(stats.low, stats.high,
                             (static_cast<double>(bin) + 0.5) / static_cast<double>(bins.size()));
    }
    return std::midpoint(stats.low, stats.high);
}

} // namespace isochron::app
