// Settings: everything that a user can set while exploring, said once.
//
// A new setting is a member of SettingsOf and its line in each_setting; without that line this
// header does not compile. A configuration file says how a setting begins whose line has a key there
// (`configured`). Settings, which sessions keep, SettingChanges, which commands hold, and
// with them merging, JSON, checks, undo, sessions, the comparison of replays and the random
// recordings of the tests follow; docs/FORMATS.md is held against it.
#pragma once

#include "interaction/field.h"
#include "interaction/setting_values.h"

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace isochron::interaction {

/// The first value of a setting, of type T, where `Holds<T>` is a value; nothing where `Holds<T>` is
/// a change. A text comes as characters: clang 19 makes no constant of a std::string of GCC 12's
/// library.
template <template <class> class Holds, class T>
constexpr Holds<T> at_first(const auto& value) {
    if constexpr (std::same_as<Holds<T>, T>)
        return value;
    else
        return {};
}

/// @tparam Holds what is held of a setting whose values are of type T: `Holds<T>`
template <template <class> class Holds>
struct SettingsOf {
    // What is shown.
    Holds<std::string> array{}; ///< array of the surfaces, by name; empty: the index's first
    Holds<std::vector<Isosurface>> isosurfaces = at_first<Holds, std::vector<Isosurface>>(
        OneSurface{});             ///< all of them, 1 to kMostIsosurfaces
    Holds<std::uint32_t> picked{}; ///< the surface whose isovalue is moved, counted from 0
    Holds<Coloring> coloring{};
    Holds<Look> look{};
    Holds<bool> bounding_box = at_first<Holds, bool>(true); ///< the box with its ticks and numbers

    // Time.
    Holds<std::uint32_t> steps{}; ///< number that the session shows; 0: all that the index has
    Holds<Instant> instant{};     ///< that the user asks for; recordings: `step` and `fraction`
    Holds<BetweenSteps> between{};
    Holds<bool> follow{}; ///< show the last step whenever a new one arrives
    Holds<PlaybackState> playback{};
    Holds<StepRange> play_range{};
    Holds<std::vector<Bookmark>> bookmarks{}; ///< all of them, at most kMostBookmarks

    Holds<std::vector<KeyFrame>> keys{}; ///< a film's, by time, at most kMostKeyFrames

    // Where and how it is seen.
    Holds<Similarity> room_from_physical{}; ///< navigation's result
    Holds<std::vector<Viewpoint>> views{};  ///< all saved ones, at most kMostViews
    Holds<QualityMode> quality{};
    Holds<float> eye_separation = at_first<Holds, float>(0.063f);     ///< meters, 0 to kWidestEyes
    Holds<std::string> stereo = at_first<Holds, std::string>("mono"); ///< a stereo mode's name
    Holds<bool> orthographic{}; ///< desktop screens show the data in parallel projection
    Holds<bool> grid{};         ///< floor grid shown

    // Panels and tools.
    Holds<bool> panel = at_first<Holds, bool>(true); ///< the operator's panel is shown
    Holds<RoomPanel> room_panel{};
    Holds<Mark> mark{};
    Holds<Tools> tools{};
    Holds<ClipPlane> clip{};
    Holds<Rulers> rulers{};
    Holds<WrittenPictures> pictures{};
    Holds<ExportWork> exporting{};
    Holds<bool> leaving{}; ///< the program asks the user whether to quit
    Holds<CurveDrawer> curves{};

    // What is shown beside the surfaces.
    Holds<Slices> slices{};
    Holds<ClipBox> clip_box{};
    Holds<std::vector<NamedMark>> marks{}; ///< all that were kept, at most kMostMarks
    Holds<ShownPieces> pieces{};
    Holds<Ghosts> ghosts{};
    Holds<std::vector<Model>> models{}; ///< at most kMostModels
    Holds<std::uint32_t> story{};       ///< the key that is told, counted from 1; 0: none

    bool operator==(const SettingsOf&) const = default;
};

/// Calls `visit(field, members...)` for every setting, with the members of all the records: a
/// setting that limits another one comes before it.
template <class Visit, class... Records>
constexpr void each_setting(Visit&& visit, Records&... r) {
    visit(Field{.key = "array", .most = kLongestArrayName}, r.array...);
    visit(Field{.key = "isosurfaces", .least = 1, .most = kMostIsosurfaces, .dragged = true},
          r.isosurfaces...);
    visit(Field{"picked", 0, kMostIsosurfaces - 1}, r.picked...);
    visit(Field{.key = "coloring", .dragged = true, .configured = "coloring"}, r.coloring...);
    visit(Field{.key = "look", .dragged = true, .configured = "look"}, r.look...);
    visit(Field{.key = "bounding_box", .old_key = "axes", .configured = "rendering.bounding_box"},
          r.bounding_box...);
    visit(Field{.key = "steps", .low = 0, .undone = false}, r.steps...);
    visit(Field{.key = "step", .dragged = true}, r.instant...);
    visit(Field{"between"}, r.between...);
    visit(Field{.key = "follow"}, r.follow...);
    visit(Field{"playback"}, r.playback...);
    visit(Field{.key = "play_range", .dragged = true}, r.play_range...);
    visit(Field{.key = "bookmarks", .most = kMostBookmarks}, r.bookmarks...);
    visit(Field{.key = "keys", .most = kMostKeyFrames}, r.keys...);
    visit(Field{.key = "room_from_physical", .dragged = true}, r.room_from_physical...);
    visit(Field{.key = "quality", .configured = "quality.mode"}, r.quality...);
    visit(Field{.key = "eye_separation", .low = 0, .high = kWidestEyes, .dragged = true},
          r.eye_separation...);
    visit(Field{"stereo"}, r.stereo...);
    visit(Field{.key = "panel", .undone = false}, r.panel...);
    visit(Field{.key = "grid", .configured = "comfort.grid"}, r.grid...);
    visit(Field{.key = "views", .most = kMostViews}, r.views...);
    visit(Field{.key = "room_panel", .undone = false}, r.room_panel...);
    visit(Field{"mark"}, r.mark...);
    visit(Field{"tools"}, r.tools...);
    visit(Field{.key = "clip", .dragged = true}, r.clip...);
    visit(Field{.key = "rulers", .old_key = "ruler"}, r.rulers...);
    visit(Field{"orthographic"}, r.orthographic...);
    visit(Field{.key = "pictures", .dragged = true}, r.pictures...);
    visit(Field{.key = "exporting", .undone = false}, r.exporting...);
    visit(Field{.key = "leaving", .undone = false}, r.leaving...);
    visit(Field{.key = "slices", .dragged = true}, r.slices...);
    visit(Field{.key = "clip_box", .dragged = true}, r.clip_box...);
    visit(Field{.key = "marks", .most = kMostMarks}, r.marks...);
    visit(Field{.key = "curves", .undone = false}, r.curves...);
    visit(Field{.key = "pieces", .dragged = true}, r.pieces...);
    visit(Field{.key = "ghosts", .dragged = true}, r.ghosts...);
    visit(Field{.key = "models", .most = kMostModels, .dragged = true}, r.models...);
    visit(Field{.key = "story", .low = 0, .high = kMostKeyFrames, .undone = false}, r.story...);
}

template <class T>
using SettingValue = T;

/// What a session keeps.
struct Settings : SettingsOf<SettingValue> {
    double isovalue() const { return isosurfaces[picked].isovalue; }
    void set_isovalue(double isovalue) { isosurfaces[picked].isovalue = isovalue; }
    /// The instant that is shown: a step where steps are not blended, and the last step holds.
    Instant shown_instant() const {
        const Instant shown = blends() ? instant : Instant(instant.step);
        return steps == 0 ? shown : shown.within(steps);
    }
    /// Whether steps are blended; pictures as in the paper never are.
    bool blends() const { return between == BetweenSteps::blend && quality != QualityMode::paper; }
    bool operator==(const Settings&) const = default;
};

/// What commands change: each setting's new value, or none.
using SettingChanges = SettingsOf<std::optional>;

/// A byte for each setting, to count them.
template <class T>
struct SettingCounted {
    char byte = 0;
};
consteval std::size_t number_of_listed_settings() {
    SettingsOf<SettingCounted> all;
    std::size_t number = 0;
    each_setting([&](const Field&, const auto&) { ++number; }, all);
    return number;
}
static_assert(number_of_listed_settings() == sizeof(SettingsOf<SettingCounted>),
              "each_setting lists every member of SettingsOf once");

} // namespace isochron::interaction
