// The list of all fields of commands: their keys in recordings and the values they may have.
//
// Settings and their list are in settings.h. A further field of commands is a member of Commands and
// one line here. Merging, JSON, the check for finite numbers, the comparison of replays and the
// random recordings of the tests follow from that line; docs/FORMATS.md is held against it.
//
//     each_field([](const Field& field, auto& into, const auto& later) { use(field, into, later); },
//                commands, others);
#pragma once

#include "interaction/commands.h"
#include "interaction/field.h"

#include <concepts>
#include <type_traits>

namespace isochron::interaction {

template <class T, class Record>
concept Of = std::same_as<std::remove_const_t<T>, Record>;

template <class Visit, Of<PlaybackState>... Records>
void each_field(Visit&& visit, Records&... r) {
    visit(Field{"playing"}, r.playing...);
    visit(Field{"reverse"}, r.reverse...);
    visit(Field{"loop"}, r.loop...);
    visit(Field{"speed", kSlowest, kFastest}, r.speed...);
    visit(Field{.key = "ping_pong", .may_lack = true}, r.ping_pong...);
    visit(Field{.key = "every", .low = 1, .high = kMostSkipped, .may_lack = true}, r.every...);
    visit(Field{.key = "unit", .may_lack = true}, r.unit...);
    visit(Field{.key = "rate", .low = kSlowestRate, .high = kFastestRate, .may_lack = true},
          r.rate...);
}

template <class Visit, Of<StepRange>... Records>
void each_field(Visit&& visit, Records&... r) {
    visit(Field{"first"}, r.first...);
    visit(Field{"last"}, r.last...);
}

template <class Visit, Of<Bookmark>... Records>
void each_field(Visit&& visit, Records&... r) {
    visit(Field{"name"}, r.name...);
    visit(Field{"step"}, r.instant.step...);
    visit(Field{.key = "fraction", .low = 0, .high = kMostFraction, .may_lack = true},
          r.instant.fraction...);
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
    visit(Field{.key = "array", .most = kLongestArrayName, .may_lack = true}, r.array...);
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
    visit(Field{.key = "colors",
                .low = 0,
                .high = 0xffffff,
                .most = kMostMapColors,
                .may_lack = true,
                .in_files = false},
          r.colors...);
    visit(Field{.key = "percentiles", .low = 0, .high = 100, .may_lack = true}, r.percentiles...);
}

template <class Visit, Of<Look>... Records>
void each_field(Visit&& visit, Records&... r) {
    visit(Field{"background"}, r.background...);
    visit(Field{"material"}, r.material...);
    visit(Field{"occlusion", 0, 1}, r.occlusion...);
    visit(Field{.key = "light", .low = -180, .high = 180, .may_lack = true, .any_order = true},
          r.light...);
    visit(Field{.key = "lifts", .may_lack = true}, r.lifts...);
}

template <class Visit, Of<SurfaceExport>... Records>
void each_field(Visit&& visit, Records&... r) {
    visit(Field{"format"}, r.format...);
    visit(Field{"steps"}, r.steps...);
    visit(Field{"clipped"}, r.clipped...);
}

template <class Visit, Of<WrittenPictures>... Records>
void each_field(Visit&& visit, Records&... r) {
    visit(Field{"legend"}, r.legend...);
    visit(Field{"scale_bar"}, r.scale_bar...);
    visit(Field{"box"}, r.box...);
    visit(Field{"marks"}, r.marks...);
    visit(Field{.key = "width", .low = 0, .high = kLargestPicture}, r.width...);
    visit(Field{.key = "height", .low = 0, .high = kLargestPicture}, r.height...);
    visit(Field{.key = "rate", .low = kSlowestMovie, .high = kFastestMovie}, r.rate...);
    visit(Field{.key = "folder", .most = kLongestArrayName}, r.folder...);
    visit(Field{.key = "surfaces", .may_lack = true}, r.surfaces...);
    visit(Field{.key = "background", .may_lack = true}, r.background...);
    visit(Field{.key = "caption", .may_lack = true}, r.caption...);
    visit(Field{.key = "scale", .low = 1, .high = kLargestScale, .may_lack = true}, r.scale...);
    visit(Field{.key = "dpi", .low = 0, .high = kMostDpi, .may_lack = true}, r.dpi...);
}

template <class Visit, Of<ExportWork>... Records>
void each_field(Visit&& visit, Records&... r) {
    visit(Field{"goes_on"}, r.goes_on...);
    visit(Field{.key = "percent", .low = 0, .high = 100}, r.percent...);
}

template <class Visit, Of<RoomPanel>... Records>
void each_field(Visit&& visit, Records&... r) {
    visit(Field{"shown"}, r.shown...);
    visit(Field{"pose"}, r.pose...);
}

template <class Visit, Of<MarkedPoint>... Records>
void each_field(Visit&& visit, Records&... r) {
    visit(Field{"position"}, r.position...);
    visit(Field{"step"}, r.instant.step...);
    visit(Field{"value"}, r.value...);
    visit(Field{.key = "fraction", .low = 0, .high = kMostFraction, .may_lack = true},
          r.instant.fraction...);
    visit(Field{.key = "array", .most = kLongestArrayName, .may_lack = true}, r.array...);
    visit(Field{.key = "unit", .most = kLongestArrayName, .may_lack = true}, r.unit...);
    visit(Field{.key = "shown", .may_lack = true}, r.shown...);
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

template <class Visit, Of<ClipBox>... Records>
void each_field(Visit&& visit, Records&... r) {
    visit(Field{"shown"}, r.shown...);
    visit(Field{"low"}, r.low...);
    visit(Field{"high"}, r.high...);
}

template <class Visit, Of<Plane>... Records>
void each_field(Visit&& visit, Records&... r) {
    visit(Field{"point"}, r.point...);
    visit(Field{"normal"}, r.normal...);
    visit(Field{.key = "shown", .may_lack = true}, r.shown...);
}

template <class Visit, Of<Slices>... Records>
void each_field(Visit&& visit, Records&... r) {
    visit(Field{.key = "planes", .most = kMostSlices}, r.planes...);
    visit(Field{.key = "picked", .low = 0, .high = kMostSlices - 1, .may_lack = true}, r.picked...);
    visit(Field{.key = "coloring", .may_lack = true}, r.coloring...);
    visit(Field{.key = "isolines", .may_lack = true}, r.isolines...);
    visit(Field{.key = "alone", .may_lack = true}, r.alone...);
}

template <class Visit, Of<NamedMark>... Records>
void each_field(Visit&& visit, Records&... r) {
    visit(Field{"name"}, r.name...);
    each_field(visit, r.point...);
}

template <class Visit, Of<PlacedPiece>... Records>
void each_field(Visit&& visit, Records&... r) {
    visit(Field{"surface", 0, kMostIsosurfaces - 1}, r.surface...);
    visit(Field{"place"}, r.place...);
}

template <class Visit, Of<ShownPieces>... Records>
void each_field(Visit&& visit, Records&... r) {
    visit(Field{.key = "only", .most = kMostPlacedPieces}, r.only...);
    visit(Field{.key = "hidden", .most = kMostPlacedPieces}, r.hidden...);
    visit(Field{"dust"}, r.dust...);
}

template <class Visit, Of<Ghosts>... Records>
void each_field(Visit&& visit, Records&... r) {
    visit(Field{"earlier", 0, kMostGhosts}, r.earlier...);
    visit(Field{"later", 0, kMostGhosts}, r.later...);
    visit(Field{"every", 1, kWidestGhosts}, r.every...);
    visit(Field{"opacity", 0, 1}, r.opacity...);
}

template <class Visit, Of<Model>... Records>
void each_field(Visit&& visit, Records&... r) {
    visit(Field{.key = "path", .most = kLongestArrayName}, r.path...);
    visit(Field{"shown"}, r.shown...);
    visit(Field{"color", 0, 1}, r.color...);
    visit(Field{"opacity", 0, 1}, r.opacity...);
    visit(Field{"lines"}, r.lines...);
}

template <class Visit, Of<Ruler>... Records>
void each_field(Visit&& visit, Records&... r) {
    visit(Field{"name"}, r.name...);
    visit(Field{.key = "places", .most = kMostRulerPlaces}, r.places...);
    visit(Field{"angle"}, r.angle...);
    visit(Field{"shown"}, r.shown...);
}

template <class Visit, Of<Rulers>... Records>
void each_field(Visit&& visit, Records&... r) {
    visit(Field{.key = "list", .most = kMostRulers}, r.list...);
    visit(Field{.key = "picked", .low = 0, .high = kMostRulers - 1}, r.picked...);
    visit(Field{"angle"}, r.angle...);
}

template <class Visit, Of<CurveDrawer>... Records>
void each_field(Visit&& visit, Records&... r) {
    visit(Field{"shown"}, r.shown...);
    visit(Field{.key = "measure", .most = kLongestArrayName}, r.measure...);
    visit(Field{"logarithmic"}, r.logarithmic...);
}

template <class Visit, Of<KeyFrame>... Records>
void each_field(Visit&& visit, Records&... r) {
    visit(Field{"time", 0, kLongestFilm}, r.time...);
    visit(Field{.key = "hold", .low = 0, .high = kLongestFilm, .may_lack = true}, r.hold...);
    visit(Field{.key = "pace", .may_lack = true}, r.pace...);
    visit(Field{"head"}, r.head...);
    visit(Field{"step"}, r.step...);
    visit(Field{.key = "fraction", .low = 0, .high = kMostFraction, .may_lack = true},
          r.fraction...);
    visit(Field{"room_from_physical"}, r.room_from_physical...);
    visit(Field{.key = "array", .most = kLongestArrayName}, r.array...);
    visit(Field{.key = "isosurfaces", .least = 1, .most = kMostIsosurfaces}, r.isosurfaces...);
    visit(Field{"picked", 0, kMostIsosurfaces - 1}, r.picked...);
    visit(Field{"isovalue"}, r.isovalue...);
    visit(Field{"coloring"}, r.coloring...);
    visit(Field{"look"}, r.look...);
    visit(Field{"bounding_box"}, r.bounding_box...);
    visit(Field{"grid"}, r.grid...);
    visit(Field{"orthographic"}, r.orthographic...);
    visit(Field{"between"}, r.between...);
    visit(Field{"mark"}, r.mark...);
    visit(Field{"clip"}, r.clip...);
    visit(Field{.key = "rulers", .old_key = "ruler"}, r.rulers...);
    visit(Field{"slices"}, r.slices...);
    visit(Field{"clip_box"}, r.clip_box...);
    visit(Field{"pieces"}, r.pieces...);
    visit(Field{"ghosts"}, r.ghosts...);
    visit(Field{.key = "models", .most = kMostModels}, r.models...);
    visit(Field{.key = "name", .may_lack = true}, r.name...);
    visit(Field{.key = "text", .most = kLongestStoryText, .may_lack = true}, r.text...);
    visit(Field{"place"}, r.place...);
}

/// The settings, the isovalue of the picked surface, and the commands that happen once.
template <class Visit, Of<Commands>... Records>
void each_field(Visit&& visit, Records&... r) {
    each_setting(visit, r...);
    visit(Field{"isovalue"}, r.isovalue...);
    visit(Field{.key = "fraction", .low = 0, .high = kMostFraction}, r.fraction...);
    visit(Field{"screenshot"}, r.screenshot...);
    visit(Field{"copy"}, r.copy...);
    visit(Field{"save"}, r.save...);
    visit(Field{"quit"}, r.quit...);
    visit(Field{"undo"}, r.undo...);
    visit(Field{"redo"}, r.redo...);
    visit(Field{.key = "stamps", .most = kMostEvents}, r.stamps...);
    visit(Field{.key = "haptics", .most = kMostEvents}, r.haptics...);
}

} // namespace isochron::interaction
