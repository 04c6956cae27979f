// The values that settings have: records and words of their own.
#pragma once

#include "index/volume/instant.h"
#include "interaction/enum_names.h"
#include "interaction/pose.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::interaction {

enum class QualityMode : std::uint8_t { automatic, fast, quality, paper };
template <>
inline constexpr std::array<std::string_view, 4> kNames<QualityMode>{"auto", "fast", "quality",
                                                                     "paper"};

inline constexpr double kSlowest = 1.0 / 64.0, kFastest = 64.0; ///< playback speeds
inline constexpr float kWidestEyes = 0.1f;                      ///< [m]

/// What the speed of playback counts.
enum class SpeedUnit : std::uint8_t {
    series, ///< `speed`: how much faster than 10 s for the whole series
    steps,  ///< `rate`: shown steps a second, each for the same time
    time    ///< `rate`: units of the data's time a second
};
template <>
inline constexpr std::array<std::string_view, 3> kNames<SpeedUnit>{"series", "steps", "time"};

inline constexpr double kSlowestRate = 1e-30, kFastestRate = 1e30;
inline constexpr std::uint32_t kMostSkipped = 1000; ///< most steps from one shown step to the next

/// How time plays. Steps last as long as they do in the data, except where `unit` is `steps`.
struct PlaybackState {
    bool playing = false;
    bool reverse = false;
    bool loop = true;        ///< goes on at the other end; without it, playing stops at the end
    double speed = 1.0;      ///< kSlowest to kFastest; counts where `unit` is `series`
    bool ping_pong = false;  ///< turns back at both ends, whether it loops or not
    std::uint32_t every = 1; ///< only every so many steps are shown, 1 to kMostSkipped
    SpeedUnit unit = SpeedUnit::series;
    double rate = 10.0; ///< kSlowestRate to kFastestRate; counts where `unit` is not `series`
    bool operator==(const PlaybackState&) const = default;
};

/// What is shown between two steps.
enum class BetweenSteps : std::uint8_t {
    hold, ///< the step before
    blend ///< the surface of the linear blend of both
};
template <>
inline constexpr std::array<std::string_view, 2> kNames<BetweenSteps>{"hold", "blend"};

using index::Instant; ///< the instants that are shown are those that queries ask for
inline constexpr std::uint32_t kMostFraction = Instant::kFractions - 1;

/// The steps that playing keeps to, counted from 0. A series that grows has new steps at its end:
/// a range without `last` has them, too.
struct StepRange {
    std::optional<std::uint32_t> first; ///< none: the first step of the series
    std::optional<std::uint32_t> last;  ///< itself included; none: the last step of the series
    bool operator==(const StepRange&) const = default;
};

/// A time to come back to.
struct Bookmark {
    std::string name;
    Instant instant;
    bool operator==(const Bookmark&) const = default;
};
inline constexpr std::size_t kMostBookmarks = 256;

/// A place in the data to come back to.
struct Viewpoint {
    std::string name;
    Similarity room_from_physical;
    bool operator==(const Viewpoint&) const = default;
};
inline constexpr std::size_t kMostViews = 64;

inline constexpr std::size_t kMostIsosurfaces = 8;

/// One of the surfaces that are shown together.
struct Isosurface {
    double isovalue = 0;
    glm::vec3 color{0.94f, 0.86f, 0.70f}; ///< sRGB, 0 to 1
    float opacity = 1.0f;                 ///< 0 to 1
    /// Name of the array that it is a surface of; empty: the array that the session shows.
    std::string array = {};
    bool operator==(const Isosurface&) const = default;

    bool of_shown_array() const { return array.empty(); }
};
/// One surface: what a list of them begins with.
struct OneSurface {
    operator std::vector<Isosurface>() const { return {Isosurface{}}; }
};

/// Whether one of the surfaces of the shown array lets light through, or whether one is opaque.
inline bool any_is(std::span<const Isosurface> surfaces, bool translucent) {
    return std::ranges::any_of(surfaces, [=](const Isosurface& surface) {
        return surface.of_shown_array() && (surface.opacity < 1.0f) == translucent;
    });
}
/// A bit for each surface that is seen at all.
inline std::uint32_t visible(std::span<const Isosurface> surfaces) {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < surfaces.size(); ++i)
        bits |= std::uint32_t{surfaces[i].opacity > 0} << i;
    return bits;
}

/// What the colors on the surfaces show.
enum class ColorBy : std::uint8_t {
    surface,       ///< which surface it is
    value,         ///< an array to color by
    first_crossing ///< when a surface of this isovalue first crossed the place
};
template <>
inline constexpr std::array<std::string_view, 3> kNames<ColorBy>{"surface", "value",
                                                                 "first_crossing"};

inline constexpr std::uint32_t kMostBands = 64;
inline constexpr std::size_t kMostMapColors = 256;

struct Coloring {
    ColorBy by = ColorBy::surface;
    std::string map = "viridis"; ///< a color map's name
    /// Values at the ends of the map, ascending; empty: the range of the series, or `percentiles`.
    std::optional<std::array<double, 2>> range = {};
    bool reversed = false;
    std::uint32_t bands =
        0; ///< number of equal parts with one color each; 0: colors change smoothly
    bool logarithmic = false; ///< equal ratios of values, all above 0, are equally far on the map
    /// Colors of a map that came with a configuration, at equal distances: sRGB, 0xRRGGBB; none:
    /// the program knows the map by its name.
    std::vector<std::uint32_t> colors = {};
    /// If `range` is empty: the map goes from one of these percentiles of the values on the shown
    /// surfaces to the other, 0 to 100, ascending. Empty: the range of the series.
    std::optional<std::array<double, 2>> percentiles = {};
    /// Name of the array of `value`; empty: the one that the index carries for colors, or else its
    /// first that is not the surfaces'.
    std::string array = {};
    bool operator==(const Coloring&) const = default;
};

/// What is behind the data.
enum class Background : std::uint8_t {
    dark,     ///< the configuration's color
    light,    ///< nearly white, as paper
    gradient, ///< from a dark floor to a lighter sky, which stands still in the room
    gray,     ///< lifted so far that surfaces of dark colors are seen against it
    white     ///< #ffffff, as the paper of a journal
};
template <>
inline constexpr std::array<std::string_view, 5> kNames<Background>{"dark", "light", "gradient",
                                                                    "gray", "white"};

/// How surfaces shine.
enum class Material : std::uint8_t {
    satin,  ///< as the configuration lights it
    matte,  ///< no highlights
    glossy, ///< small and bright ones
    metal   ///< the surface mirrors more than it scatters
};
template <>
inline constexpr std::array<std::string_view, 4> kNames<Material>{"satin", "matte", "glossy",
                                                                  "metal"};

/// How the picture is lit.
struct Look {
    Background background = Background::dark;
    Material material = Material::satin;
    float occlusion = 0.6f; ///< how much darker the surface is where it is surrounded by itself
    /// Where the key light comes from in the room: the angle to the right of the way from the data
    /// to the viewer, and the height above the floor, degrees. Empty: as the program has it.
    std::optional<std::array<double, 2>> light = {};
    /// A window shows a dark background a little lighter while colors carry values, so that the dark
    /// end of their map is seen. Pictures that are written, and replays, never do.
    bool lifts = true;
    bool operator==(const Look&) const = default;
};

/// Which steps are exported.
enum class ExportedSteps : std::uint8_t {
    shown, ///< the instant that is shown
    range  ///< all steps of the range that plays
};
template <>
inline constexpr std::array<std::string_view, 2> kNames<ExportedSteps>{"shown", "range"};

/// How surfaces are exported as files for other programs.
struct SurfaceExport {
    std::string format = "ply"; ///< by its name (index/export/surface_writer.h)
    ExportedSteps steps = ExportedSteps::shown;
    bool clipped = true; ///< without what a shown clip plane cuts away
    bool operator==(const SurfaceExport&) const = default;
};

/// What is behind the data in pictures that are written.
enum class WrittenBackground : std::uint8_t {
    shown,      ///< what the window shows
    white,      ///< #ffffff, with dark words and lines
    transparent ///< nothing, with dark words and lines; white in movies and files without opacity
};
template <>
inline constexpr std::array<std::string_view, 3> kNames<WrittenBackground>{"shown", "white",
                                                                           "transparent"};

/// What a picture or movie that is written shows beside the data, and how it is written.
struct WrittenPictures {
    bool legend = true;
    bool scale_bar = false;              ///< and the data's axes, where the window shows them
    bool box = true;                     ///< the data's box, where the window shows it
    bool marks = true;                   ///< mark, ruler and the outline of the clip plane
    std::uint32_t width = 0, height = 0; ///< [pixel], 0: as it is seen
    double rate = 30.0;      ///< pictures a second of a movie, kSlowestMovie to kFastestMovie
    std::string folder = {}; ///< empty: the folder that the program was started in
    SurfaceExport surfaces;  ///< how surfaces are exported to the same folder
    WrittenBackground background = WrittenBackground::shown;
    bool caption = false; ///< array, isovalues and time
    double scale = 1.0;   ///< factor of width and height, 1 to kLargestScale; words grow with it
    double dpi = 0.0;     ///< pixels an inch that a picture's file says, to kMostDpi; 0: nothing
    bool operator==(const WrittenPictures&) const = default;
};
inline constexpr std::uint32_t kLargestPicture = 16384; ///< [pixel] along each side
inline constexpr double kLargestScale = 8.0, kMostDpi = 10000.0;
inline constexpr double kSlowestMovie = 1.0, kFastestMovie = 240.0;

/// The export that goes on in the background, or is asked for.
struct ExportWork {
    bool goes_on = false;      ///< setting it begins an export, clearing it cancels the export
    std::uint32_t percent = 0; ///< how much of it is written, 0 to 100
    bool operator==(const ExportWork&) const = default;
};

/// The panel that stands in the room.
struct RoomPanel {
    bool shown = false;
    Pose pose; ///< pose of its middle: +X to its right, +Y up, +Z towards the reader
    bool operator==(const RoomPanel&) const = default;
};

/// A place in the data that the user picked, and the value there.
struct MarkedPoint {
    glm::dvec3 position{0.0}; ///< physical space
    Instant instant;          ///< shown when it was picked
    double value = 0;         ///< value of the data there
    /// Array whose value it is, and its unit; empty: that of the surfaces.
    std::string array = {}, unit = {};
    bool shown = true; ///< its cross and its words are drawn
    bool operator==(const MarkedPoint&) const = default;
};
/// The one place that is marked, or none.
struct Mark {
    std::optional<MarkedPoint> point;
    bool operator==(const Mark&) const = default;
};

/// A mark that was kept.
struct NamedMark {
    std::string name;
    MarkedPoint point;
    bool operator==(const NamedMark&) const = default;
};
inline constexpr std::size_t kMostMarks = 64;

/// The tools: what a hand's button does.
enum class ToolKind : std::uint8_t { grab, pick, clip, ruler, slice };
template <>
inline constexpr std::array<std::string_view, 5> kNames<ToolKind>{"grab", "pick", "clip", "ruler",
                                                                  "slice"};

/// The tool that each hand holds.
struct Tools {
    ToolKind wand = ToolKind::grab, other = ToolKind::grab;
    ToolKind mouse = ToolKind::pick;
    bool operator==(const Tools&) const = default;
};

/// A plane that cuts the surfaces, in physical space.
struct ClipPlane {
    bool shown = false;
    glm::dvec3 point{0.0};            ///< on it
    glm::dvec3 normal{0.0, 0.0, 1.0}; ///< unit; points to the side that is cut away
    bool operator==(const ClipPlane&) const = default;

    /// Distance of a place from the plane, positive on the side that is cut away.
    double beyond(const glm::dvec3& at) const { return glm::dot(at - point, normal); }
};

/// A box that cuts the surfaces: what is outside it is cut away.
struct ClipBox {
    bool shown = false;
    glm::dvec3 low{0.0}, high{0.0}; ///< corners, as indices of vertices along the axes of the grid
    bool operator==(const ClipBox&) const = default;
};

inline constexpr std::size_t kMostSlices = 3;
/// A plane through the data, in physical space.
struct Plane {
    glm::dvec3 point{0.0};            ///< on it
    glm::dvec3 normal{0.0, 0.0, 1.0}; ///< unit
    bool shown = true;                ///< a slice that is not keeps its place
    bool operator==(const Plane&) const = default;
};
/// The slices that are shown together: planes through one array.
struct Slices {
    std::vector<Plane> planes;         ///< at most kMostSlices
    std::uint32_t picked = 0;          ///< the plane that is moved, counted from 0
    Coloring coloring{ColorBy::value}; ///< `array` empty: that of the surfaces; `by` is ignored
    bool isolines = true;              ///< the isovalues of the surfaces are drawn as lines
    bool alone = false;                ///< surfaces are hidden while there are slices
    bool operator==(const Slices&) const = default;

    bool shown() const { return !planes.empty(); }
    /// Whether one of them is seen.
    bool seen() const { return std::ranges::any_of(planes, &Plane::shown); }
    bool hides_surfaces() const { return alone && seen(); }
};

inline constexpr std::size_t kMostPlacedPieces = 64;
/// A connected piece of a surface: whatever the step and the isovalue are, the one that comes nearest
/// to a place.
struct PlacedPiece {
    std::uint32_t surface = 0; ///< counted from 0
    glm::dvec3 place{0.0};     ///< physical space
    bool operator==(const PlacedPiece&) const = default;
};
/// Which pieces of the surfaces are shown; without any of it, all.
struct ShownPieces {
    std::vector<PlacedPiece> only;   ///< where a surface has one here, its others are hidden
    std::vector<PlacedPiece> hidden; ///< both lists: at most kMostPlacedPieces
    std::uint32_t dust = 0;          ///< pieces of fewer active cells are hidden
    bool operator==(const ShownPieces&) const = default;

    bool all() const { return only.empty() && hidden.empty() && dust == 0; }
};

inline constexpr std::uint32_t kMostGhosts = 4;        ///< in each direction of time
inline constexpr std::uint32_t kWidestGhosts = 100000; ///< [step] from one to the next
/// Surfaces of earlier and later steps, translucent, beside those that are shown.
struct Ghosts {
    std::uint32_t earlier = 0, later = 0; ///< how many, at most kMostGhosts
    std::uint32_t every = 1;              ///< steps from one to the next, 1 to kWidestGhosts
    float opacity = 0.25f;                ///< 0 to 1
    bool operator==(const Ghosts&) const = default;

    bool shown() const { return earlier + later > 0 && opacity > 0; }
};

inline constexpr std::size_t kMostModels = 16;
/// Triangles of a file, in the data's coordinates, shown beside the surfaces.
struct Model {
    std::string path;
    bool shown = true;
    glm::vec3 color{0.72f, 0.74f, 0.78f}; ///< sRGB, 0 to 1
    float opacity = 1.0f;                 ///< 0 to 1
    bool lines = false;                   ///< the edges of the triangles are drawn, not their faces
    bool operator==(const Model&) const = default;
};

inline constexpr std::size_t kMostRulerPlaces = 3, kMostRulers = 32;
/// Places between which a distance is measured, or an angle at the second one, in physical space.
struct Ruler {
    std::string name = {};
    std::vector<glm::dvec3> places = {}; ///< fewer than `wanted` until the user has chosen all
    bool angle = false;                  ///< measures an angle, not a distance
    bool shown = true;
    bool operator==(const Ruler&) const = default;

    std::size_t wanted() const { return angle ? 3 : 2; }
    bool complete() const { return places.size() >= wanted(); }
};
/// All rulers.
struct Rulers {
    std::vector<Ruler> list = {}; ///< at most kMostRulers
    std::uint32_t picked = 0; ///< the one whose profile is plotted and that Delete removes, from 0
    bool angle = false;       ///< the next one measures an angle
    bool operator==(const Rulers&) const = default;

    /// Null: there is none.
    const Ruler* chosen() const { return picked < list.size() ? &list[picked] : nullptr; }
};

/// What `CurveDrawer::measure` has for the values at the mark, and for those along the picked ruler.
inline constexpr std::string_view kMarkCurve = "mark", kProfileCurve = "profile";
/// The measure whose place is the mark.
inline constexpr std::string_view kDistanceCurve = "distance";

/// The drawer of curves: a number of the shown surfaces over all steps.
struct CurveDrawer {
    bool shown = false;
    std::string measure =
        "area";               ///< a measure's name (index/measure/measures.h), `mark`, `profile`
    bool logarithmic = false; ///< axis of the numbers
    bool operator==(const CurveDrawer&) const = default;
};

/// How isovalue and time go from a key to the next one.
enum class KeyPace : std::uint8_t {
    eased, ///< slow at the ends of a move, and without a jump of their rates between moves
    even   ///< at one rate all the way
};
template <>
inline constexpr std::array<std::string_view, 2> kNames<KeyPace>{"eased", "even"};

inline constexpr std::size_t kMostKeyFrames = 128;
inline constexpr double kLongestFilm = 3600.0;      ///< [s]
inline constexpr double kShortestMove = 1.0 / 1024; ///< [s] from the rest at a key to the next key
inline constexpr std::size_t kLongestStoryText = 2000; ///< [byte] of a key

/// A key frame of a film, which is also a step of the story that its keys tell: what is seen at one
/// of the film's times. A setting that a key does not hold goes from the key before to the key
/// behind, or stays as it is.
struct KeyFrame {
    double time = 0;                        ///< [s] of the film
    double hold = 0;                        ///< [s] that the film rests here
    KeyPace pace = KeyPace::eased;          ///< from here to the next key
    std::optional<Pose> head = {};          ///< viewer's head in the room
    std::optional<std::uint32_t> step = {}; ///< counted from 0
    std::uint32_t fraction = 0;             ///< way to the next step, see Instant
    std::optional<Similarity> room_from_physical = {};
    std::optional<std::string> array = {};
    std::optional<std::vector<Isosurface>> isosurfaces = {};
    std::optional<std::uint32_t> picked = {};
    std::optional<double> isovalue = {}; ///< the picked surface's
    std::optional<Coloring> coloring = {};
    std::optional<Look> look = {};
    std::optional<bool> bounding_box = {}, grid = {}, orthographic = {};
    std::optional<BetweenSteps> between = {};
    std::optional<Mark> mark = {};
    std::optional<ClipPlane> clip = {};
    std::optional<Rulers> rulers = {};
    std::optional<Slices> slices = {};
    std::optional<ClipBox> clip_box = {};
    std::optional<ShownPieces> pieces = {};
    std::optional<Ghosts> ghosts = {};
    std::optional<std::vector<Model>> models = {};
    std::string name = {};                ///< empty: its number
    std::string text = {};                ///< what the story says here
    std::optional<glm::dvec3> place = {}; ///< what the text is about, physical space
    bool operator==(const KeyFrame&) const = default;
};

} // namespace isochron::interaction
