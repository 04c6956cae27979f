// `--check-config` on what engineers of laboratories write: each mistake is told with its key, and
// sound rooms of many kinds are silent.
#include "app/config/check/check.h"
#include "app/config/check/usual_values.h"
#include "app/config/check_config.h"
#include "app/config/config_problem.h"

#include <fmt/format.h>
#include <glm/trigonometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <functional>
#include <numbers>
#include <regex>

namespace isochron::app {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

/// What `--check-config` says of a configuration, a line each; a refusal is one line.
std::vector<std::string> said_of(const std::string& text) {
    std::vector<std::string> lines;
    try {
        const Config config = parse_config(text, "lab.toml");
        for (const ConfigProblem& problem : problems_of(config))
            lines.push_back(line_of(problem, config));
    } catch (const ConfigError& error) {
        lines.emplace_back(error.what());
    }
    return lines;
}

using Point = std::array<double, 3>;

struct Wall {
    std::string name;
    Point lower_left, upper_left, upper_right;
    std::string window = "stereo = \"quadbuffer\"\n"; ///< more lines of the window
    std::string screen = "";                          ///< more lines of the screen
    double pixel = 0.0025;                            ///< [m]
    std::string viewer = "";                          ///< who sees it; empty: the only one
};

double distance(const Point& a, const Point& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}
std::string words(const Point& p) {
    return fmt::format("[{:.6f}, {:.6f}, {:.6f}]", p[0], p[1], p[2]);
}

std::string room_of(const Point& viewer, const std::vector<Wall>& walls,
                    const std::string& of_viewer = "eye_separation = 0.063\n") {
    std::string text =
        fmt::format("version = 1\n[viewer]\nposition = {}\n{}", words(viewer), of_viewer);
    for (const Wall& wall : walls)
        text += fmt::format("[[windows]]\nname = \"{}\"\nsize = [{:.0f}, {:.0f}]\n{}"
                            "[[windows.viewports]]\n{}[windows.viewports.projection]\n"
                            "lower_left = {}\nupper_left = {}\nupper_right = {}\n{}",
                            wall.name, distance(wall.upper_left, wall.upper_right) / wall.pixel,
                            distance(wall.lower_left, wall.upper_left) / wall.pixel, wall.window,
                            wall.viewer.empty() ? "" : "viewer = \"" + wall.viewer + "\"\n",
                            words(wall.lower_left), words(wall.upper_left), words(wall.upper_right),
                            wall.screen);
    return text;
}

/// The walls of a room with its middle at the origin, by name.
std::vector<Wall> box(double width, double height, double depth, const std::string& names,
                      double floor = 0, double gap = 0) {
    const double x = width / 2, z = depth / 2, low = floor + gap, top = floor + height;
    const std::vector<Wall> all{{"front", {-x, low, -z}, {-x, top, -z}, {x, top, -z}},
                                {"left", {-x, low, z}, {-x, top, z}, {-x, top, -z}},
                                {"right", {x, low, -z}, {x, top, -z}, {x, top, z}},
                                {"back", {x, low, z}, {x, top, z}, {-x, top, z}},
                                {"floor", {-x, floor, z}, {-x, floor, -z}, {x, floor, -z}},
                                {"ceiling", {-x, top, -z}, {-x, top, z}, {x, top, z}}};
    std::vector<Wall> walls;
    for (const Wall& wall : all)
        if (names.find(wall.name) != names.npos)
            walls.push_back(wall);
    return walls;
}

const std::string kTracker =
    "[dtrack]\nport = 5000\n[[dtrack.devices]]\nname = \"head\"\nbody = 0\n"
    "[[dtrack.devices]]\nname = \"wand\"\nflystick = 0\n";

std::string cave(const std::string& more = "") {
    return room_of({0, 1.7, 0}, box(3, 3, 3, "front left right floor")) + kTracker + more;
}
std::string powerwall(const std::string& more = "") {
    return room_of({0, 1.7, 0}, {{"wall", {-2, 0.4, -2}, {-2, 2.65, -2}, {2, 2.65, -2}}}) + more;
}
std::string hmd() {
    return room_of({0, 1.6, 0},
                   {{"headset", {-1.19, -1.19, -1}, {-1.19, 1.19, -1}, {1.19, 1.19, -1}}});
}

/// With every corner moved.
std::string moved(const std::string& text, const std::function<Point(Point)>& move) {
    static const std::regex corner(R"(((?:lower|upper)_(?:left|right) = )\[(.*), (.*), (.*)\])");
    std::string result;
    auto rest = text.cbegin();
    for (std::sregex_iterator it(text.begin(), text.end(), corner), end; it != end; ++it) {
        const std::smatch& match = *it;
        result += std::string(rest, match[0].first) + match[1].str() +
                  words(move({std::stod(match[2]), std::stod(match[3]), std::stod(match[4])}));
        rest = match[0].second;
    }
    return result + std::string(rest, text.cend());
}
std::function<Point(Point)> times(double factor) {
    return [=](const Point& p) { return Point{factor * p[0], factor * p[1], factor * p[2]}; };
}
Point z_up(const Point& p) {
    return {p[0], -p[2], p[1]};
}

/// With the first of one text replaced.
std::string with(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, text.npos) << from;
    return at == text.npos ? text : text.replace(at, from.size(), to);
}
std::string with_all(std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != text.npos; at += to.size())
        text.replace(at, from.size(), to);
    return text;
}
/// With a wall of the CAVE at other corners, and as many pixels as before.
std::string cave_with(const std::string& name, const Point& lower_left, const Point& upper_left,
                      const Point& upper_right) {
    std::string text = cave();
    for (const Wall& wall : box(3, 3, 3, name)) {
        const auto corners = [](const Point& a, const Point& b, const Point& c) {
            return fmt::format("lower_left = {}\nupper_left = {}\nupper_right = {}\n", words(a),
                               words(b), words(c));
        };
        text = with(text, corners(wall.lower_left, wall.upper_left, wall.upper_right),
                    corners(lower_left, upper_left, upper_right));
    }
    return text;
}
std::string viewer_at(const std::string& place) {
    return with(cave(), words({0, 1.7, 0}), place);
}
std::string eyes(const std::string& lines) {
    return with(cave(), "eye_separation = 0.063", lines);
}
std::string in_window(const std::string& from, const std::string& to) {
    return with(cave(), from, to);
}
std::string of_tracker(const std::string& line) {
    return with(cave(), "port = 5000", "port = 5000\n" + line);
}
std::string of_head(const std::string& line) {
    return with(cave(), "body = 0", "body = 0\n" + line);
}
std::string of_wand(const std::string& line) {
    return cave(line + "\n");
}

struct Mistake {
    std::string key; ///< that the line names
    std::string what;
    std::string text;
};

const std::string kQuad = "stereo = \"quadbuffer\"", kProjection = "windows.viewports.projection";

std::vector<Mistake> mistakes_of_screens() {
    const double foot = 1 / 0.3048, inch = 1 / 0.0254;
    return {
        {kProjection, "a wall seen from behind",
         cave_with("front", {1.5, 0, -1.5}, {1.5, 3, -1.5}, {-1.5, 3, -1.5})},
        {kProjection, "upside down",
         cave_with("front", {-1.5, 3, -1.5}, {-1.5, 0, -1.5}, {1.5, 0, -1.5})},
        {kProjection, "corners begin at the lower right one",
         cave_with("front", {1.5, 0, -1.5}, {-1.5, 0, -1.5}, {-1.5, 3, -1.5})},
        {kProjection, "a wall on its side",
         cave_with("left", {-1.5, 0, -1.5}, {-1.5, 0, 1.5}, {-1.5, 3, 1.5})},
        {kProjection, "one wrong digit",
         cave_with("front", {-1.5, 0, -1.5}, {-1.5, 3, -1.5}, {15, 3, -1.5})},
        {kProjection, "a floor the wrong way round",
         cave_with("floor", {1.5, 0, -1.5}, {1.5, 0, 1.5}, {-1.5, 0, 1.5})},
        {"turned by 90 degrees", "a floor turned by 90 degrees",
         cave_with("floor", {-1.5, 0, -1.5}, {1.5, 0, -1.5}, {1.5, 0, 1.5})},
        {kProjection, "a floor too high",
         cave_with("floor", {-1.5, 1, 1.5}, {-1.5, 1, -1.5}, {1.5, 1, -1.5})},
        {kProjection, "the front wall at 15 m",
         cave_with("front", {-1.5, 0, -15}, {-1.5, 3, -15}, {1.5, 3, -15})},
        {kProjection, "the left wall 20 cm outside",
         cave_with("left", {-1.7, 0, 1.5}, {-1.7, 3, 1.5}, {-1.7, 3, -1.5})},
        {kProjection, "the left wall 40 cm inside",
         cave_with("left", {-1.1, 0, 1.5}, {-1.1, 3, 1.5}, {-1.1, 3, -1.5})},
        {kProjection, "the left wall 30 cm too high",
         cave_with("left", {-1.5, 0.3, 1.5}, {-1.5, 3.3, 1.5}, {-1.5, 3.3, -1.5})},
        {kProjection, "the right wall 30 cm too far back",
         cave_with("right", {1.5, 0, -1.2}, {1.5, 3, -1.2}, {1.5, 3, 1.8})},
        {kProjection, "a side wall apart in a room without a floor",
         room_of({0, 1.7, 0}, {{"a", {-1.5, 0, -1.5}, {-1.5, 3, -1.5}, {1.5, 3, -1.5}},
                               {"b", {-1.7, 0, 1.5}, {-1.7, 3, 1.5}, {-1.7, 3, -1.5}},
                               {"c", {1.5, 0, -1.5}, {1.5, 3, -1.5}, {1.5, 3, 1.5}}})},
        {kProjection, "the left wall 4 cm outside",
         cave_with("left", {-1.54, 0, 1.5}, {-1.54, 3, 1.5}, {-1.54, 3, -1.5})},
        {kProjection, "one wall in feet",
         cave_with("left", {-4.92, 0, 4.92}, {-4.92, 9.84, 4.92}, {-4.92, 9.84, -4.92})},
        {kProjection, "two walls in one place",
         cave_with("left", {-1.5, 0, -1.5}, {-1.5, 3, -1.5}, {1.5, 3, -1.5})},
        {kProjection, "left and right exchanged",
         with(with(with(cave(), "\"left\"", "\"x\""), "\"right\"", "\"left\""), "\"x\"",
              "\"right\"")},
        {kProjection, "floor and front exchanged",
         with(with(with(cave(), "\"floor\"", "\"x\""), "\"front\"", "\"floor\""), "\"x\"",
              "\"front\"")},
        {kProjection, "front and back exchanged",
         with(with(with(room_of({0, 1.7, 0}, box(3, 3, 3, "front left right back floor")),
                        "\"back\"", "\"x\""),
                   "\"front\"", "\"back\""),
              "\"x\"", "\"front\"")},
        {kProjection, "the front wall behind the viewer",
         cave_with("front", {1.5, 0, 1.5}, {1.5, 3, 1.5}, {-1.5, 3, 1.5})},
        {kProjection, "a wall at the side alone",
         moved(powerwall(), [](const Point& p) { return Point{p[2], p[1], -p[0]}; })},
        {kProjection, "millimeters", moved(cave(), times(1000))},
        {kProjection, "centimeters", moved(cave(), times(100))},
        {kProjection, "decimeters", moved(cave(), times(10))},
        {kProjection, "inches", moved(cave(), times(inch))},
        {kProjection, "feet", moved(cave(), times(foot))},
        {kProjection, "a powerwall in feet", moved(powerwall(), times(foot))},
        {kProjection, "left-handed",
         moved(cave(), [](Point p) { return Point{p[0], p[1], -p[2]}; })},
        {kProjection, "y down", moved(cave(), [](Point p) { return Point{p[0], -p[1], p[2]}; })},
        {kProjection, "turned by 90 degrees",
         moved(cave(), [](Point p) { return Point{p[2], p[1], -p[0]}; })},
        {kProjection, "z up in corners", moved(cave(), z_up)},
        {"z points up", "z up", with(moved(cave(), z_up), words({0, 1.7, 0}), words({0, 0, 1.7}))},
        {"z points up", "z up, one wall",
         with(moved(powerwall(), z_up), words({0, 1.7, 0}), words({0, 0, 1.7}))},
        {"carried_by", "a wall carried by the head",
         in_window("lower_left", "carried_by = \"head\"\nlower_left")},
        {"carried_by", "a powerwall carried by the head",
         with(powerwall(), "lower_left", "carried_by = \"head\"\nlower_left")},
        {"carried_by", "a headset's screen in the room", hmd()},
        {"carried_by", "a room whose origin is in its middle",
         moved(powerwall(), [](Point p) { return Point{p[0], p[1] - 1.525, p[2]}; })},
        {"fit_aspect", "a wall that is fitted",
         with(in_window("lower_left", "fit_aspect = true\nlower_left"), "size = [1200, 1200]",
              "size = [1920, 1200]\nfullscreen = true")},
        {kProjection, "oblong pixels", in_window("size = [1200, 1200]", "size = [1920, 1200]")},
        {"windows.size", "sizes in other units than pixels",
         with_all(cave(), "[1200, 1200]", "[120, 120]")},
        {kProjection, "a window without corners", cave("[[windows]]\nname = \"more\"\n")},
        {kProjection, "a screen of no size", moved(powerwall(), times(0.004))},
        {"bezel", "millimeters", in_window("lower_left", "bezel = 20\nlower_left")},
        {"bezel", "20 cm", in_window("lower_left", "bezel = 0.2\nlower_left")},
        {"bezel", "frames wider than the gaps",
         room_of(
             {0, 1.7, 0},
             {{"a", {-2, 0, -2}, {-2, 1, -2}, {0, 1, -2}, kQuad + "\n", "bezel = 0.09\n"},
              {"b", {0.02, 0, -2}, {0.02, 1, -2}, {2.02, 1, -2}, kQuad + "\n", "bezel = 0.09\n"}})},
    };
}

std::vector<Mistake> mistakes_of_windows() {
    const auto window = [](const std::string& lines) {
        return with_all(powerwall(), kQuad, lines);
    };
    const std::string one_eye = "stereo = \"left\"\n", other_eye = "stereo = \"right\"\n";
    const auto pair = [&](const std::string& first, const std::string& second,
                          const std::string& of_first, const std::string& of_second) {
        const Point low{-2, 0.4, -2}, high{-2, 2.65, -2}, right{2, 2.65, -2};
        return room_of({0, 1.7, 0}, {{first, low, high, right, of_first},
                                     {second, low, high, right, of_second}});
    };
    return {
        {"windows.monitor", "a monitor twice",
         with_all(cave(), kQuad, kQuad + "\nfullscreen = true\nmonitor = 1")},
        {"windows.monitor", "a monitor without fullscreen", window(kQuad + "\nmonitor = 1")},
        {"windows.position", "windows over each other",
         with_all(cave(), kQuad, kQuad + "\nposition = [0, 0]")},
        {"windows.position", "the console over a window",
         with(powerwall("[console]\nposition = [9, 9]\n"), kQuad, kQuad + "\nposition = [0, 0]")},
        {"windows.node", "a node without a window", window(kQuad + "\nnode = 2")},
        {"stereo", "one wall inverted", in_window(kQuad, "stereo = \"quadbuffer_inverted\"")},
        {"stereo", "one wall mono", in_window(kQuad, "stereo = \"mono\"")},
        {"stereo", "one wall for other glasses", in_window(kQuad, "stereo = \"anaglyph_dubois\"")},
        {"stereo", "one wall in halves", in_window(kQuad, "stereo = \"side_by_side\"")},
        {"stereo", "one eye alone", window(one_eye)},
        {"stereo", "an eye twice", pair("a", "b", one_eye, one_eye)},
        {"stereo", "eyes exchanged, by name", pair("wall left", "wall right", other_eye, one_eye)},
        {"stereo", "forgotten", with_all(cave(), kQuad + "\n", "")},
        {"stereo", "a slip", in_window(kQuad, "stereo = \"quad\"")},
        {"stereo", "rows of the other eye",
         window("stereo = \"vertical_interlaced\"\nposition = [0, 31]")},
        {"stereo", "columns of the other eye",
         window("stereo = \"horizontal_interlaced\"\nposition = [31, 0]")},
        {"size", "a viewport in pixels",
         in_window("[[windows.viewports]]", "[[windows.viewports]]\nsize = [1200, 1200]")},
        {"size", "a viewport beyond its window",
         in_window("[[windows.viewports]]", "[[windows.viewports]]\nposition = [0.5, 0]")},
        {"windows.viewports: ", "viewports over each other",
         in_window("[[windows.viewports]]", "[[windows.viewports]]\nsize = [0.5, 1]\n"
                                            "[[windows.viewports]]")},
        {"rendering.context", "nothing to be seen",
         with_all(powerwall("[rendering]\ncontext = \"egl\"\n"), kQuad,
                  kQuad + "\nfullscreen = true")},
    };
}

/// Displays of 1 x 0.5625 m beside one another, each with more lines of its window.
std::string row_of(const std::vector<std::string>& windows, double share = 1) {
    std::vector<Wall> walls;
    for (std::size_t i = 0; i < windows.size(); ++i) {
        const double x = -1.5 + double(i) * share;
        walls.push_back({fmt::format("t{}", i),
                         {x, 0.8, -2},
                         {x, 1.3625, -2},
                         {x + 1, 1.3625, -2},
                         kQuad + "\n" + windows[i],
                         "",
                         1.0 / 1920});
    }
    return room_of({0, 1.7, 0}, walls);
}
/// Two displays, one above the other, in one window.
std::string column_of(double position_of_upper, double position_of_lower) {
    const auto viewport = [](double position, double low) {
        return fmt::format("[[windows.viewports]]\nposition = [0, {}]\nsize = [1, 0.5]\n"
                           "[windows.viewports.projection]\nlower_left = [-1, {}, -2]\n"
                           "upper_left = [-1, {}, -2]\nupper_right = [1, {}, -2]\n",
                           position, low, low + 1.125, low + 1.125);
    };
    return "version = 1\n[[windows]]\nsize = [1920, 2160]\n" + viewport(position_of_upper, 1.625) +
           viewport(position_of_lower, 0.5);
}
/// A headset with a window for each eye, whose screens reach farther out on the side of the eye.
std::string two_eyes(const std::string& left, const std::string& right, double outward = 0.2) {
    const auto eye = [](const std::string& name, const std::string& mode, double x) {
        return Wall{name,
                    {x - 1, -1, -1},
                    {x - 1, 1, -1},
                    {x + 1, 1, -1},
                    "stereo = \"" + mode + "\"\n",
                    "carried_by = \"head\"\n"};
    };
    return room_of({0, 1.6, 0}, {eye(left, "left", -outward), eye(right, "right", outward)});
}
/// The four walls, each on a machine of its own.
std::string on_machines(const std::vector<int>& monitors) {
    std::vector<Wall> walls = box(3, 3, 3, "front left right floor");
    for (std::size_t i = 0; i < walls.size(); ++i)
        walls[i].window +=
            fmt::format("fullscreen = true\nnode = {}\nmonitor = {}\n", i + 1, monitors[i]);
    return room_of({0, 1.7, 0}, walls) + kTracker;
}

std::vector<Mistake> mistakes_of_displays() {
    std::vector<Wall> crossing = box(3, 3, 3, "front left right");
    for (auto* corner :
         {&crossing[0].lower_left, &crossing[0].upper_left, &crossing[0].upper_right})
        (*corner)[2] = -0.75;
    const double turn = 3 * std::sin(0.1), along = 3 * std::cos(0.1) - 1.5;
    return {
        {"windows.viewports.position", "counted from the top", column_of(0, 0.5)},
        {"windows.position", "displays in reverse order",
         row_of({"position = [3840, 0]\n", "position = [1920, 0]\n", "position = [0, 0]\n"})},
        {"windows.position", "of a window that covers its monitor",
         with(powerwall(), kQuad, kQuad + "\nfullscreen = true\nposition = [1920, 0]")},
        {"windows.size", "one display with half the pixels",
         with(row_of({"", "", ""}), "[1920, 1080]", "[960, 540]")},
        {kProjection, "a display over most of its neighbor", row_of({"", ""}, 0.2)},
        {kProjection, "a front wall between the side walls", room_of({0, 1.7, 0}, crossing)},
        {kProjection, "a side wall turned by 6 degrees",
         cave_with("left", {-1.5 - turn, 0, along}, {-1.5 - turn, 3, along}, {-1.5, 3, -1.5})},
        {"windows.monitor", "counted through all machines", on_machines({0, 1, 2, 3})},
        {"windows.viewports.name", "one name twice",
         with_all(column_of(0.5, 0), "[[windows.viewports]]",
                  "[[windows.viewports]]\nname = \"half\"")},
        {kProjection, "the screens of a headset exchanged", two_eyes("a", "b", -0.2)},
        {"windows.stereo", "a headset's eyes, by name", two_eyes("eye right", "eye left")},
        {"windows.name", "two windows of one name", with(cave(), "\"right\"", "\"left\"")},
    };
}

std::vector<Mistake> mistakes_of_viewers() {
    std::vector<Mistake> all;
    for (const auto* place :
         {"[0, 17, 0]", "[0, 170, 0]", "[0, 1700, 0]", "[0, 5.6, 0]", "[0, 67, 0]", "[0, 0, 0]",
          "[0, 0, 1.7]", "[0, 0.017, 0]", "[1.7, 0, 0]", "[0, 1.7, -1.45]", "[0, 1.7, 5]"})
        all.push_back({"viewer.position", place, viewer_at(place)});
    for (const auto* separation : {"0.0315", "0.0063", "6.3", "63", "2.5", "0.1", "0.0"})
        all.push_back(
            {"eye_separation", separation, eyes(std::string("eye_separation = ") + separation)});
    const auto two = [](const char* left, const char* right) {
        return eyes(fmt::format("left_eye = {}\nright_eye = {}", left, right));
    };
    const std::vector<Mistake> others{
        {"left_eye", "one place", two("[0.03, 0, 0]", "[0.03, 0, 0]")},
        {"left_eye", "one above the other", two("[0, -0.03, 0]", "[0, 0.03, 0]")},
        {"left_eye", "one behind the other", two("[0, 0, -0.03]", "[0, 0, 0.03]")},
        {"left_eye", "exchanged", two("[0.03, 0, 0]", "[-0.03, 0, 0]")},
        {"left_eye", "one at the origin", two("[0, 0, 0]", "[0.063, 0, 0]")},
        {"left_eye", "centimeters", two("[-3.1, 0, 0]", "[3.1, 0, 0]")},
        {"left_eye", "far from the head", two("[-0.03, 0.3, 0]", "[0.03, 0.3, 0]")},
        {"viewer.position", "walls of 30 cm", moved(cave(), times(0.1))},
        {"viewer.position", "half sizes for sizes", moved(cave(), times(0.5))},
        {"viewer.position", "all in feet",
         with(moved(powerwall(), times(1 / 0.3048)), words({0, 1.7, 0}), "[0, 5.58, 0]")},
        {"viewer.position", "on the floor of a powerwall",
         with(powerwall(), words({0, 1.7, 0}), "[0, 0.017, 0]")},
        {"viewer.position", "origin in the middle, viewer from the floor",
         moved(cave(), [](Point p) { return Point{p[0], p[1] - 1.5, p[2]}; })},
        {"warning: viewers: ", "no viewport for a viewer",
         "[[viewers]]\nname = \"a\"\n[[viewers]]\nname = "
         "\"b\"\n"},
        {"viewers.head", "one head for two",
         "[[viewers]]\nname = \"a\"\n[[viewers]]\nname = "
         "\"b\"\n"},
        {"viewers.head", "a slip", eyes("head = \"haed\"")},
        {"viewers.head", "a hand", eyes("head = \"wand\"")},
        {"rendering.near", "behind the walls", cave("[rendering]\nnear = 5\n")},
        {"rendering.near", "out of reach", cave("[rendering]\nnear = 1\n")},
        {"rendering.near", "most of the way to a monitor",
         room_of({0, 1.2, 0.2},
                 {{"desk", {-0.3, 0.8, -0.4}, {-0.3, 1.1375, -0.4}, {0.3, 1.1375, -0.4}}}) +
             "[rendering]\nnear = 0.4\n"},
        {"rendering.near", "beyond far", cave("[rendering]\nnear = 3\nfar = 2\n")},
        {"rendering.far", "before the walls", cave("[rendering]\nfar = 1\n")},
        {"rendering.far", "before the floor", cave("[rendering]\nfar = 1.6\n")},
        {"rendering.far", "before the data",
         cave("[rendering]\nfar = 3\n[placement]\nsize = 4\ndistance = 10\n")},
        {"near_fade", "beyond reach", cave("[comfort]\nnear_fade = [2, 3]\n")},
        {"near_fade", "decimeters", cave("[comfort]\nnear_fade = [1.5, 3.5]\n")},
        {"near_fade", "centimeters", cave("[comfort]\nnear_fade = [15, 35]\n")},
        {"near_fade", "around the data",
         cave("[comfort]\nnear_fade = [0.4, 0.9]\n[placement]\nheight = 1.6\ndistance = 0.4\nsize "
              "= 0.3\n")},
    };
    all.insert(all.end(), others.begin(), others.end());
    for (const auto* placement :
         {"distance = 40", "distance = 15", "distance = -1.5", "height = 13", "height = -3",
          "size = 0.015", "size = 15", "size = 1500", "height = 130"})
        all.push_back({"placement", placement, cave(fmt::format("[placement]\n{}\n", placement))});
    return all;
}

std::vector<Mistake> mistakes_of_trackers() {
    std::vector<Mistake> all;
    const auto each = [&](const std::string& key, const std::function<std::string(std::string)>& of,
                          const std::vector<std::string>& lines) {
        for (const std::string& line : lines)
            all.push_back({key, line, of(line)});
    };
    each("dtrack.position", of_tracker,
         {"position = [0, 250, 0]", "position = [0, 25, 0]", "position = [0, 900, 0]",
          "position = [0, -2.5, 0]"});
    each("dtrack.scale", of_tracker,
         {"scale = 1000", "scale = 0.001", "scale = 0.01", "scale = 0.3048", "scale = 3.28"});
    each("dtrack.orientation", of_tracker,
         {"orientation = [0, -1.5708, 0]", "orientation = [1.5708, 0.7854, 0]",
          "orientation = [0, 90, 0]", "orientation = [0, 0, 90]", "orientation = [0, -9, 0]",
          "orientation = [0, 180, 0]", "orientation = [-0.7071, 0, 0]",
          "orientation = [0, 0.707, 0.707]"});
    each("dtrack.address", of_tracker,
         {"address = \"224.0.1.5\"", "address = \"192.168.0.255\"", "from = \"192.168.0.10\"",
          "address = \"192.168.0.10\"\nfrom = \"192.168.0.10\"",
          "address = \"192.168.0.20\"\nfrom = \"0.0.0.0\"",
          "address = \"192.168.0.20\"\nfrom = \"192.168.0.255\"",
          "address = \"192.168.0.20\"\nfrom = \"127.0.0.1\""});
    each("port", [](const auto& line) { return with(cave(), "port = 5000", line); },
         {"port = 500", "port = 50105", "port = 3883", "port = 70000"});
    each("osc.scale",
         [](const auto& line) {
             return cave("[osc]\n" + line + "\n[[osc.devices]]\nname = \"wand2\"\n");
         },
         {"scale = 3.28", "scale = 1000", "scale = 0.0001"});
    each("dtrack.devices.offset", of_head, {"offset = [0, 80, -30]", "offset = [0, 0.8, -0.3]"});
    each("dtrack.devices.offset", of_wand, {"offset = [0, 0, -0.9]"});
    each("dtrack.devices.rotation", of_head,
         {"rotation = [0, 1.5708, 0]", "rotation = [0, 90, 0]", "rotation = [0, -90, 0]",
          "rotation = [0.7071, 0, 0]"});
    each("dtrack.devices.rotation",
         [&](const auto& line) {
             return with(of_tracker(line), "flystick = 0", "flystick = 0\nrotation = [0, 90, 0]");
         },
         {"orientation = [0, -90, 0]", "orientation = [90, -90, 0]"});
    each("buttons", of_head, {"buttons = [0, 1]"});
    each("buttons", of_wand,
         {"buttons = [1, 1, 2]", "buttons = [1, 2, 4, 8]", "buttons = [16]", "buttons = [100]",
          "buttons = [1, 2, 3]"});
    each("valuators", of_head, {"valuators = [0]"});
    each("valuators", of_wand, {"valuators = [0, 0]", "valuators = [8]"});
    each("valuator_factors", of_wand,
         {"valuators = [0, 1]\nvaluator_factors = [1, 0]",
          "valuators = [0, 1]\nvaluator_factors = [100, 100]",
          "valuators = [0, 1]\nvaluator_factors = [0.01, 0.01]"});
    const std::string head = "name = \"head\"", wand = "name = \"wand\"";
    for (const auto* name : {"Wand", "hand", "flystick", "stylus"})
        all.push_back(
            {"dtrack.devices.name", name, with(cave(), wand, fmt::format("name = \"{}\"", name))});
    for (const auto* name : {"Head", "glasses"})
        all.push_back(
            {"dtrack.devices.name", name, with(cave(), head, fmt::format("name = \"{}\"", name))});
    const std::string osc = "[[osc.devices]]\nname = \"wand\"\n";
    const std::string vrpn = "[vrpn]\n[[vrpn.devices]]\nname = \"wand2\"\n";
    const std::string of_box = "button = \"Button0@pc\"\n";
    const std::vector<Mistake> others{
        {"dtrack.devices", "one body twice", with(cave(), "flystick = 0", "body = 0")},
        {"dtrack.devices.marker", "a head without orientation",
         with(cave(), "body = 0", "marker = 1")},
        {"dtrack.devices", "a marker in the hand", with(cave(), "flystick = 0", "marker = 1")},
        {"dtrack.devices", "head and hand exchanged",
         with(with(with(cave(), head, "name = \"x\""), wand, head), "name = \"x\"", wand)},
        {"dtrack.devices", "numbers from 1",
         with(with(cave(), "body = 0", "body = 1"), "flystick = 0", "flystick = 1")},
        {"osc.devices.name", "a head without a pose",
         powerwall("[osc]\n[[osc.devices]]\nname = \"head\"\npose = false\n")},
        {"vrpn.devices.button", "one box for both hands",
         cave("[vrpn]\n[[vrpn.devices]]\nname = \"wand\"\n" + of_box +
              "[[vrpn.devices]]\nname = \"wand2\"\n" + of_box)},
        {"vrpn.devices.tracker", "the buttons' name", cave(vrpn + "tracker = \"Button0@pc\"\n")},
        {"osc.port", "a port twice",
         cave("[osc]\nport = 5000\n[[osc.devices]]\nname = \"wand2\"\n")},
        {"osc.devices.name", "two poses", cave("[osc]\n" + osc)},
        {"osc.devices.source", "an address for a name",
         cave("[osc]\n" + osc + "source = \"/isochron/wand\"\n")},
        {"osc.devices.source", "a device in the prefix",
         cave("[osc]\nprefix = \"/isochron/wand\"\n" + osc)},
        {"dtrack.devices.name", "the other hand alone", with(cave(), wand, "name = \"wand2\"")},
        {"dtrack.devices.name", "a headset, too", cave("[openxr]\nenabled = true\n")},
        {"prediction_limit_ms", "less than is to be predicted",
         cave("[tracking]\ndisplay_delay_ms = 120\n")},
        {"lost_after_ms", "lost before held",
         cave("[tracking]\nheld_after_ms = 500\nlost_after_ms = 100\n")},
        {"vrpn.devices.tracker", "host before name",
         cave(vrpn + "tracker = \"192.168.0.4@Tracker0\"\n")},
        {"vrpn.devices.buttons", "buttons of nothing",
         cave(vrpn + "tracker = \"Tracker0@pc\"\nbuttons = [0]\n")},
        {"vrpn.devices.valuators", "valuators of nothing",
         cave(vrpn + "tracker = \"Tracker0@pc\"\nvaluators = [0]\n")},
    };
    all.insert(all.end(), others.begin(), others.end());
    return all;
}

std::vector<Mistake> mistakes_of_values() {
    std::vector<Mistake> all;
    const auto add = [&](const std::string& key, const std::string& table) {
        all.push_back({key, table, cave(table + "\n")});
    };
    add("tracking.held_after_ms", "[tracking]\nheld_after_ms = 0.1\nlost_after_ms = 1");
    add("quality.longest_ms", "[quality]\nframe_budget_ms = 33\nlongest_ms = 16");
    add("comfort.vignette_full", "[comfort]\nvignette_speed = 2\nvignette_full = 0.5");
    add("lighting", "[lighting]\nambient = 0\nhead_light = 0\nkey_light = 0");
    add("lighting", "[lighting]\nkey_direction = [0, -1, 0]");
    add("surfaces", "[[surfaces]]\nopacity = 0");
    add("surfaces", "[[surfaces]]\ncolor = [0.055, 0.063, 0.078]");
    add("surfaces", "[[surfaces]]\nquantile = 1");
    add("quantile", "[[surfaces]]\nquantile = 95");
    add("coloring.percentiles", "[coloring]\npercentiles = [0.02, 0.98]");
    add("openxr.enabled", "[openxr]\nmirror = \"both\"");
    add("openxr.enabled", "[openxr]\nenabled = true");
    add("comfort.vignette", "[comfort]\nvignette_speed = 0.5");
    add("cluster.frame_timeout", "[cluster]\ntimeout = 60\nframe_timeout = 10");
    add("rendering.picture_samples", "[rendering]\nsamples = 16\npicture_samples = 4");
    add("rendering.samples", "[rendering]\nsamples = 3");
    add("rendering.samples", "[rendering]\nsamples = 64");
    add("rendering.vsync", "[rendering]\nvsync = false");
    add("rendering.context", "[rendering]\ncontext = \"egl\"");
    add("quality.frame_budget_ms",
        "[rendering]\nframe_rate_limit = 90\n[quality]\nframe_budget_ms = 33");
    add("quality.frame_budget_ms", "[openxr]\nenabled = true\n[quality]\nframe_budget_ms = 33");
    add("quality.still_budget_ms", "[quality]\nframe_budget_ms = 16\nstill_budget_ms = 10");
    add("panel", "[panel]\ndistance = 5");
    add("panel", "[panel]\nwidth = 2\ndistance = 0.3");
    add("cluster", "[cluster]\nswap_group = true");
    add("placement.fill", "[placement]\nfill = 0.85");
    add("lighting.ambient", "[lighting]\nambient = 2.5");
    add("lighting", "[look]\nlight = [0.6, 0.8]");
    add("lighting", "[look]\nlight = [30, -50]");
    add("surfaces.opacity", "[[surfaces]]\nopacity = 0.01");
    add("surfaces", "[[surfaces]]\nisovalue = 5\n[[surfaces]]\nisovalue = 5");
    return all;
}

std::vector<Mistake> all_mistakes() {
    std::vector<Mistake> all;
    for (const auto& some : {mistakes_of_screens(), mistakes_of_windows(), mistakes_of_displays(),
                             mistakes_of_viewers(), mistakes_of_trackers(), mistakes_of_values()})
        all.insert(all.end(), some.begin(), some.end());
    return all;
}

TEST(LabMistakes, EachIsToldWithItsKey) {
    const std::vector<Mistake> all = all_mistakes();
    EXPECT_GE(all.size(), 180u);
    for (const Mistake& mistake : all)
        EXPECT_THAT(said_of(mistake.text), Contains(HasSubstr(mistake.key))) << mistake.what << "\n"
                                                                             << mistake.text;
}

TEST(LabMistakes, EveryCheckTellsOfOne) {
    std::deque<Config> configs;
    std::deque<CheckedRoom> rooms;
    for (const Mistake& mistake : all_mistakes())
        try {
            rooms.emplace_back(configs.emplace_back(parse_config(mistake.text, "lab.toml")));
        } catch (const ConfigError&) { // it is refused before
        }
    for (const auto& checks : {checks_of_screens(), checks_of_walls(), checks_of_displays(),
                               checks_of_viewers(), checks_of_devices(), checks_of_values()})
        for (const Check& check : checks) {
            const bool told = std::ranges::any_of(rooms, [&](const CheckedRoom& room) {
                return !findings_of({&check, 1}, room).empty();
            });
            EXPECT_TRUE(told || std::string(check.key) == "*")
                << "check " << &check - checks.data() << " of " << check.key;
        }
}

/// A file that gives a key a value.
std::string with_value(const std::string& key, double value) {
    const std::size_t dot = key.rfind('.');
    const std::string table = key.substr(0, dot),
                      line = fmt::format("{} = {}\n", key.substr(dot + 1), value);
    if (key == "*.latency_ms")
        return cave("[osc]\n" + line + "[[osc.devices]]\nname = \"wand2\"\n");
    if (table == "*")
        return cave((key == "*.lost_after_ms" ? "[tracking]\nheld_after_ms = 20\n"
                                              : "[tracking]\nlost_after_ms = 60000\n") +
                    line);
    if (table == "windows.viewports.projection")
        return with(powerwall(), "lower_left", line + "lower_left");
    return cave(table == "surfaces" ? "[[surfaces]]\n" + line
                                    : fmt::format("[{}]\n{}", table, line));
}

TEST(LabMistakes, ValuesOutsideOfWhatIsUsualAreToldAndThoseInsideAreNot) {
    EXPECT_THAT(said_of(""), IsEmpty());
    for (const UsualValues& usual : usual_values()) {
        const std::string name = std::string(usual.key).substr(std::string(usual.key).rfind('.'));
        // Lengths, times and speeds in a unit that is a thousandth or a thousand times as large.
        int told = 0;
        for (const double value : {usual.low / 2, usual.high * 2}) {
            const auto said = said_of(with_value(usual.key, value));
            told += std::ranges::any_of(
                said, [&](const auto& line) { return line.find(name + ": ") != line.npos; });
        }
        EXPECT_GE(told, 1) << usual.key;
        const auto inside = said_of(with_value(usual.key, std::sqrt(usual.low * usual.high)));
        for (const std::string& line : inside)
            EXPECT_THAT(line, testing::Not(HasSubstr("is unusual"))) << usual.key;
    }
}

/// A tiled cylinder, such as a CAVE2: columns of displays with frames, interlaced.
std::string cylinder(int columns, int rows, double radius, double bezel) {
    std::vector<Wall> walls;
    const double width = 1.02, height = 0.57375, gap = 2 * bezel;
    const double turn = 2 * std::asin((width + gap) / 2 / radius);
    for (int i = 0; i < columns; ++i)
        for (int j = 0; j < rows; ++j) {
            const double angle = (i - (columns - 1) / 2.0) * turn, low = 0.3 + j * (height + gap);
            const double away = radius * std::cos(turn / 2); // so that edges meet at the radius
            const double x = away * std::sin(angle), z = -away * std::cos(angle);
            const double dx = width / 2 * std::cos(angle), dz = width / 2 * std::sin(angle);
            walls.push_back({fmt::format("c{} {}", i, j),
                             {x - dx, low, z - dz},
                             {x - dx, low + height, z - dz},
                             {x + dx, low + height, z + dz},
                             fmt::format("stereo = \"vertical_interlaced\"\nnode = {}\nposition = "
                                         "[0, {}]\n",
                                         i + 1, 768 * j),
                             fmt::format("bezel = {}\n", bezel),
                             width / 1366});
        }
    return room_of({0, 1.7, 0}, walls);
}

std::string tiled(int columns, int rows, double gap, double bezel) {
    std::vector<Wall> walls;
    for (int i = 0; i < columns; ++i)
        for (int j = 0; j < rows; ++j) {
            const double x = -2 + i * (1 + gap), y = 0.5 + j * (0.5625 + gap);
            walls.push_back({fmt::format("t{}{}", i, j),
                             {x, y, -2},
                             {x, y + 0.5625, -2},
                             {x + 1, y + 0.5625, -2},
                             kQuad + "\n",
                             fmt::format("bezel = {}\n", bezel),
                             1.0 / 1920});
        }
    return room_of({0, 1.7, 0}, walls);
}

std::string curved(int panels, double radius, double span) {
    std::vector<Wall> walls;
    for (int i = 0; i < panels; ++i) {
        const double a = -span / 2 + span * i / panels, b = a + span / panels;
        walls.push_back({fmt::format("panel {}", i),
                         {radius * std::sin(a), 0.3, -radius * std::cos(a)},
                         {radius * std::sin(a), 2.3, -radius * std::cos(a)},
                         {radius * std::sin(b), 2.3, -radius * std::cos(b)}});
    }
    return room_of({0, 1.7, 0}, walls);
}

struct SoundRoom {
    const char* what;
    std::string text;
};

std::vector<SoundRoom> sound_rooms() {
    const std::string left = "stereo = \"left\"\n", right = "stereo = \"right\"\n",
                      mono = "stereo = \"mono\"\n";
    std::vector<Wall> passive;
    for (const Wall& wall : box(3, 3, 3, "front left right floor"))
        for (const auto& [suffix, eye] : {std::pair("_left", left), std::pair("_right", right)}) {
            passive.push_back(wall);
            passive.back().name += suffix;
            passive.back().window = eye;
        }
    std::vector<Wall> both;
    for (const auto* viewer : {"guide", "guest"})
        for (const auto& [suffix, eye] : {std::pair(" left", left), std::pair(" right", right)}) {
            both.push_back({viewer + std::string(suffix),
                            {-1.6, 0.3, -1.5},
                            {-1.6, 2.3, -1.5},
                            {1.6, 2.3, -1.5},
                            eye});
            both.back().viewer = viewer;
        }
    std::vector<Wall> apart = box(3, 3, 3, "front left right");
    for (auto* corner : {&apart[1].lower_left, &apart[1].upper_left, &apart[1].upper_right})
        (*corner)[0] -= 0.15;
    for (auto* corner : {&apart[2].lower_left, &apart[2].upper_left, &apart[2].upper_right})
        (*corner)[0] += 0.15;
    std::vector<Wall> short_floor = box(3, 3, 3, "front left right floor");
    short_floor.back().lower_left[2] = 0.75;
    std::string two_projectors = row_of({"position = [0, 0]\n", "position = [1920, 0]\n"});
    two_projectors = with_all(two_projectors, kQuad + "\n", left);
    std::string of_right = with_all(with_all(two_projectors, left, right), "\"t", "\"r");
    of_right = with(with(of_right, "[1920, 0]", "[5760, 0]"), "[0, 0]", "[3840, 0]");
    two_projectors += of_right.substr(of_right.find("[[windows]]"));
    std::vector<Wall> around;
    for (int i = 0; i < 5; ++i) {
        const double a = 0.4 * std::numbers::pi * i, b = a + 0.4 * std::numbers::pi;
        around.push_back({fmt::format("side {}", i),
                          {2 * std::sin(a), 0, -2 * std::cos(a)},
                          {2 * std::sin(a), 2.5, -2 * std::cos(a)},
                          {2 * std::sin(b), 2.5, -2 * std::cos(b)}});
    }
    const std::string pentagon = room_of({0, 1.7, 0}, around);
    const double c = 1.5, s = 1.5 * std::numbers::sqrt3;
    return {
        {"CAVE of four walls", cave()},
        {"powerwall", powerwall()},
        {"three walls", room_of({0, 1.7, 0}, box(3, 2.25, 3, "front left right"))},
        {"a CAVE of 10 feet",
         room_of({0, 1.7, 0}, box(3.048, 3.048, 3.048, "front left right floor"))},
        {"five walls", room_of({0, 1.7, 0}, box(3, 3, 3, "front left right floor ceiling"))},
        {"six walls", room_of({0, 1.7, 0}, box(3, 3, 3, "front left right back floor ceiling"))},
        {"origin in the middle",
         room_of({0, 0.2, 0}, box(3, 3, 3, "front left right floor", -1.5))},
        {"origin at the eyes", room_of({0, 0, 0}, box(3, 2.4, 3, "front left right floor", -1.7))},
        {"walls 20 cm above the floor",
         room_of({0, 1.7, 0}, box(3, 3, 3, "front left right floor", 0, 0.2))},
        {"side walls 15 cm apart", room_of({0, 1.7, 0}, apart)},
        {"a floor that ends before the walls", room_of({0, 1.7, 0}, short_floor)},
        {"wings at 30 degrees",
         room_of({0, 1.7, 0},
                 {{"center", {-1.5, 0, -2}, {-1.5, 2.25, -2}, {1.5, 2.25, -2}},
                  {"left wing", {-1.5 - c, 0, -2 + s}, {-1.5 - c, 2.25, -2 + s}, {-1.5, 2.25, -2}},
                  {"right wing", {1.5, 0, -2}, {1.5, 2.25, -2}, {1.5 + c, 2.25, -2 + s}}})},
        {"two walls in a corner",
         room_of({0, 1.7, 0.3}, {{"left", {-2, 0, 0}, {-2, 2.1, 0}, {0, 2.1, -2}},
                                 {"right", {0, 0, -2}, {0, 2.1, -2}, {2, 2.1, 0}}})},
        {"an L-shaped table",
         room_of({0, 1.65, 0.5},
                 {{"vertical", {-0.9, 0.8, -0.6}, {-0.9, 1.9, -0.6}, {0.9, 1.9, -0.6}},
                  {"table", {-0.9, 0.8, 0.5}, {-0.9, 0.8, -0.6}, {0.9, 0.8, -0.6}}}) +
             "[placement]\nsize = 0.5\nheight = 1.0\ndistance = 0.2\n"},
        {"a workbench",
         room_of({0, 1.7, 0.9},
                 {{"table", {-0.9, 0.9, 0.6}, {-0.9, 0.9, -0.6}, {0.9, 0.9, -0.6}}})},
        {"a tilted desk, origin on it", room_of({0, 0.25, 0.4}, {{"desk",
                                                                  {-0.26, -0.1, 0},
                                                                  {-0.26, 0.1533, -0.1463},
                                                                  {0.26, 0.1533, -0.1463},
                                                                  kQuad + "\n",
                                                                  "",
                                                                  0.00027}})},
        {"displays with frames", tiled(4, 3, 0.0055, 0.00275)},
        {"displays whose frames are given wide", tiled(4, 3, 0.0055, 0.0055)},
        {"displays 15 cm apart", tiled(3, 1, 0.15, 0)},
        {"displays whose frames are given", tiled(3, 3, 0.02, 0.01)},
        {"a cylinder of displays", cylinder(18, 4, 3.25, 0.004)},
        {"a curved wall", curved(5, 3, 2.1)},
        {"blended projectors",
         room_of({0, 1.7, 0}, {{"b1", {-2.2, 0.4, -2}, {-2.2, 2.4, -2}, {0.2, 2.4, -2}},
                               {"b2", {-0.2, 0.4, -2}, {-0.2, 2.4, -2}, {2.2, 2.4, -2}}})},
        {"two projectors for each wall", room_of({0, 1.7, 0}, passive)},
        {"a hall with a wall and a floor of 16 x 9 m",
         room_of({0, 1.7, 3},
                 {{"front", {-8, 0, -4.5}, {-8, 9, -4.5}, {8, 9, -4.5}, kQuad + "\n", "", 0.002},
                  {"floor", {-8, 0, 4.5}, {-8, 0, -4.5}, {8, 0, -4.5}, kQuad + "\n", "", 0.002}})},
        {"a cinema", room_of({0, 1.2, 6}, {{"screen", {-5, 1, -4}, {-5, 5.2, -4}, {5, 5.2, -4}}})},
        {"a wall over a stage",
         room_of({0, 2.6, 0},
                 {{"wall", {-1.8, 1.1, -2.5}, {-1.8, 3.125, -2.5}, {1.8, 3.125, -2.5}}})},
        {"a leaning wall",
         room_of({0, 1.7, 0},
                 {{"wall", {-1, 0.5, -1.6}, {-1, 2.4319, -1.0824}, {1, 2.4319, -1.0824}}})},
        {"mono on purpose",
         room_of({0, 1.2, 0},
                 {{"tv", {-0.7, 0.5, -2}, {-0.7, 1.2875, -2}, {0.7, 1.2875, -2}, mono}},
                 "eye_separation = 0.0\n") +
             "[dtrack]\n[[dtrack.devices]]\nname = \"head\"\nbody = 0\n"},
        {"a display that stands on its side",
         room_of({0, 1.7, 0}, {{"d", {0.3, 0.6, -2}, {-0.3, 0.6, -2}, {-0.3, 1.6667, -2}, mono}})},
        {"a headset, a window for each eye", two_eyes("left", "right")},
        {"displays one above the other in a window", column_of(0.5, 0)},
        {"displays on one desktop, in their order",
         row_of({"position = [0, 0]\n", "position = [1920, 0]\n", "position = [3840, 0]\n"})},
        {"a projector for each eye of two displays, on one desktop", two_projectors},
        {"projectors that share a fifth", row_of({"", ""}, 0.8)},
        {"machines whose projector is the second monitor", on_machines({1, 1, 1, 1})},
        {"five walls around the viewer", pentagon},
        {"a headset", with(hmd(), "lower_left", "carried_by = \"head\"\nlower_left")},
        {"an operator's window", cave("[[windows]]\nname = \"operator\"\nstereo = \"mono\"\n"
                                      "[[windows.viewports]]\n[windows.viewports.projection]\n"
                                      "carried_by = \"head\"\nfit_aspect = true\n"
                                      "lower_left = [-0.8, -0.45, -1]\nupper_left = [-0.8, 0.45, "
                                      "-1]\nupper_right = [0.8, 0.45, -1]\n")},
        {"names in other ways", with_all(with_all(with_all(cave(), "\"front\"", "\"FrontWall\""),
                                                  "\"left\"", "\"wall-left\""),
                                         "\"floor\"", "\"p4\"")},
        {"a tracker with z up, feet by OSC",
         with(cave(), "port = 5000",
              "address = \"192.168.0.20\"\nfrom = \"192.168.0.10\"\nport = 5001\norientation = "
              "[0.4, -89.2, 0.1]\nposition = [0, 0.1, 0.5]\nlatency_ms = 12") +
             "buttons = [0, 1, 3]\nvaluators = [1, 0]\nvaluator_factors = [1, -1]\noffset = [0, "
             "0.05, -0.12]\n[osc]\nscale = 0.3048\n[[osc.devices]]\nname = \"wand2\"\n"},
        {"data as a landscape", powerwall("[placement]\nsize = 20\nheight = 1.5\ndistance = 15\n")},
        {"data around the viewer",
         cave("[placement]\nsize = 3\nheight = 1.5\ndistance = 0\n[comfort]\nnear_fade = [0.15, "
              "0.35]\n")},
        {"a box of buttons alone", powerwall("[osc]\n[[osc.devices]]\nname = \"wand\"\npose = "
                                             "false\nbuttons = [0, 1]\n")},
        {"projectors and glasses for each of two viewers",
         with_all(room_of({0, 1.7, 0}, both), "[viewer]\nposition",
                  "[[viewers]]\nname = \"guest\"\nhead = \"head2\"\n[[viewers]]\nname = "
                  "\"guide\"\nposition") +
             kTracker + "[[dtrack.devices]]\nname = \"head2\"\nbody = 1\n"},
        {"children's eyes", with(powerwall(), "0.063", "0.052")},
    };
}

TEST(LabMistakes, FramesOfAWallAreOneWarningWhereTheyAreNotGiven) {
    EXPECT_THAT(said_of(tiled(3, 3, 0.02, 0)),
                testing::ElementsAre(HasSubstr("20 such gaps: bezel")));
    EXPECT_THAT(said_of(tiled(3, 3, 0.04, 0.01)), testing::ElementsAre(HasSubstr("such gaps")));
}

TEST(LabMistakes, SoundRoomsAreSilent) {
    for (const SoundRoom& room : sound_rooms())
        EXPECT_THAT(said_of(room.text), IsEmpty()) << room.what << "\n" << room.text;
}

TEST(LabMistakes, ALengthInAnotherUnitIsNamedWithTheUnit) {
    EXPECT_THAT(said_of(viewer_at("[0, 5.6, 0]")), Contains(HasSubstr("5.6 feet would be 1.71 m")));
    EXPECT_THAT(said_of(moved(cave(), times(10))),
                Contains(HasSubstr("30 decimeters would be 3.00 m")));
    EXPECT_THAT(said_of(cave("[quality]\nframe_budget_ms = 0.016\n")),
                Contains(HasSubstr("0.016 seconds would be 16 ms")));
}

TEST(LabMistakes, AnInvertedWallIsToldAtItsWindow) {
    EXPECT_THAT(said_of(in_window(kQuad, "stereo = \"quadbuffer_inverted\"")),
                testing::ElementsAre("lab.toml:5: warning: windows.stereo: window front is "
                                     "quadbuffer_inverted, and window left beside it quadbuffer: "
                                     "its eyes are exchanged"));
}

} // namespace
} // namespace isochron::app
