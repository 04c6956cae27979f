// The list of all fields of commands: their keys in recordings and the values they may have.
//
// A new field is a member of Commands and one line here. Merging, JSON, the check for finite
// numbers, the comparison of replays, ExplorerState::apply and the random recordings of the tests
// follow from that line; docs/FORMATS.md is held against it.
//
//     each_field([](const Field& field, auto& into, const auto& later) { use(field, into, later); },
//                commands, others);
#pragma once

#include "interaction/commands.h"

#include <concepts>
#include <cstddef>
#include <limits>
#include <type_traits>

namespace isochron::interaction {

inline constexpr double kAnyNumber = std::numeric_limits<double>::max();
inline constexpr std::size_t kLongestText = 256;       ///< [byte]
inline constexpr std::size_t kLongestArrayName = 4096; ///< [byte] of an array
inline constexpr std::size_t kMostEvents = 64;         ///< stamps, or haptic pulses, of one frame

/// The properties of a field, which are the same in every record that has it.
struct Field {
    const char* key;
    double low = -kAnyNumber, high = kAnyNumber; ///< range of a number, or of each number of a list
    std::size_t least = 0, most = kLongestText;  ///< items of a list, or bytes of a text
    const char* old_key = nullptr;               ///< the key in recordings of older versions
    bool undone = true;                          ///< changes of the setting can be undone
    bool may_lack = false; ///< older recordings may lack it: then it has its default
    bool dragged = false;  ///< changes in quick succession are undone as one
};

template <class T, class Record>
concept Of = std::same_as<std::remove_const_t<T>, Record>;

template <class Visit, Of<PlaybackState>... Records>
void each_field(Visit&& visit, Records&... r) {
    visit(Field{"playing"}, r.playing...);
    visit(Field{"reverse"}, r.reverse...);
    visit(Field{"loop"}, r.loop...);
    visit(Field{"speed", kSlowest, kFastest}, r.speed...);
}

template <class Visit, Of<Viewpoint>... Records>
void each_field(Visit&& visit, Records&... r) {
    visit(Field{"name"}, r.name...);
    visit(Field{"room_from_physical"}, r.room_from_physical...);
}

template <class Visit, Of<Isosurface>... Records>
void each_field(Visit&& visit, Records&... r) {
    visit(Field{"isovalue"}, r.isovalue...);
    visit(Field{"color", 0, 1}, r.color...);
    visit(Field{"opacity", 0, 1}, r.opacity...);
}

template <class Visit, Of<Coloring>... Records>
void each_field(Visit&& visit, Records&... r) {
    visit(Field{"by"}, r.by...);
    visit(Field{.key = "array", .most = kLongestArrayName, .may_lack = true}, r.array...);
    visit(Field{"map"}, r.map...);
    visit(Field{"range"}, r.range...);
    visit(Field{.key = "reversed", .may_lack = true}, r.reversed...);
    visit(Field{.key = "bands", .low = 0, .high = kMostBands, .may_lack = true}, r.bands...);
    visit(Field{.key = "logarithmic", .may_lack = true}, r.logarithmic...);
    visit(
        Field{
            .key = "colors", .low = 0, .high = 0xffffff, .most = kMostMapColors, .may_lack = true},
        r.colors...);
    visit(Field{.key = "percentiles", .low = 0, .high = 100, .may_lack = true}, r.percentiles...);
}

template <class Visit, Of<Look>... Records>
void each_field(Visit&& visit, Records&... r) {
    visit(Field{"background"}, r.background...);
    visit(Field{"material"}, r.material...);
    visit(Field{"occlusion", 0, 1}, r.occlusion...);
}

template <class Visit, Of<RoomPanel>... Records>
void each_field(Visit&& visit, Records&... r) {
    visit(Field{"shown"}, r.shown...);
    visit(Field{"pose"}, r.pose...);
}

template <class Visit, Of<MarkedPoint>... Records>
void each_field(Visit&& visit, Records&... r) {
    visit(Field{"position"}, r.position...);
    visit(Field{"step"}, r.step...);
    visit(Field{"value"}, r.value...);
}

template <class Visit, Of<HapticPulse>... Records>
void each_field(Visit&& visit, Records&... r) {
    visit(Field{"hand"}, r.hand...);
    visit(Field{"seconds", 0, kLongestPulse}, r.seconds...);
    visit(Field{"amplitude", 0, 1}, r.amplitude...);
}

template <class Visit, Of<Tools>... Records>
void each_field(Visit&& visit, Records&... r) {
    visit(Field{"wand"}, r.wand...);
    visit(Field{"other"}, r.other...);
    visit(Field{"mouse"}, r.mouse...);
}

template <class Visit, Of<ClipPlane>... Records>
void each_field(Visit&& visit, Records&... r) {
    visit(Field{"shown"}, r.shown...);
    visit(Field{"point"}, r.point...);
    visit(Field{"normal"}, r.normal...);
}

template <class Visit, Of<Ruler>... Records>
void each_field(Visit&& visit, Records&... r) {
    visit(Field{.key = "places", .most = kMostRulerPlaces}, r.places...);
}

/// The settings: what a session keeps and commands change. Commands and the records that keep
/// settings have members of the same names.
template <class Visit, class... Records>
void each_setting(Visit&& visit, Records&... r) {
    visit(Field{.key = "array", .most = kLongestArrayName}, r.array...);
    visit(Field{.key = "isosurfaces", .least = 1, .most = kMostIsosurfaces, .dragged = true},
          r.isosurfaces...);
    visit(Field{"picked", 0, kMostIsosurfaces - 1}, r.picked...);
    visit(Field{.key = "coloring", .dragged = true}, r.coloring...);
    visit(Field{.key = "look", .dragged = true}, r.look...);
    visit(Field{.key = "bounding_box", .old_key = "axes"}, r.bounding_box...);
    visit(Field{.key = "steps", .low = 0, .undone = false}, r.steps...);
    visit(Field{.key = "step", .dragged = true}, r.step...);
    visit(Field{.key = "follow"}, r.follow...);
    visit(Field{"playback"}, r.playback...);
    visit(Field{.key = "room_from_physical", .dragged = true}, r.room_from_physical...);
    visit(Field{"quality"}, r.quality...);
    visit(Field{.key = "eye_separation", .low = 0, .high = kWidestEyes, .dragged = true},
          r.eye_separation...);
    visit(Field{"stereo"}, r.stereo...);
    visit(Field{.key = "panel", .undone = false}, r.panel...);
    visit(Field{"grid"}, r.grid...);
    visit(Field{.key = "views", .most = kMostViews}, r.views...);
    visit(Field{.key = "room_panel", .undone = false}, r.room_panel...);
    visit(Field{"mark"}, r.mark...);
    visit(Field{"tools"}, r.tools...);
    visit(Field{.key = "clip", .dragged = true}, r.clip...);
    visit(Field{"ruler"}, r.ruler...);
    visit(Field{"orthographic"}, r.orthographic...);
    visit(Field{.key = "leaving", .undone = false}, r.leaving...);
}

/// The settings, the isovalue of the picked surface, and the commands that happen once.
template <class Visit, Of<Commands>... Records>
void each_field(Visit&& visit, Records&... r) {
    each_setting(visit, r...);
    visit(Field{"isovalue"}, r.isovalue...);
    visit(Field{"screenshot"}, r.screenshot...);
    visit(Field{"quit"}, r.quit...);
    visit(Field{"undo"}, r.undo...);
    visit(Field{"redo"}, r.redo...);
    visit(Field{.key = "stamps", .most = kMostEvents}, r.stamps...);
    visit(Field{.key = "haptics", .most = kMostEvents}, r.haptics...);
}

} // namespace isochron::interaction
