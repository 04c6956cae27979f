// Commands to JSON and back.
#include "interaction/recording/commands_json.h"

#include "interaction/recording/json_values.h"

#include <algorithm>
#include <array>
#include <limits>

namespace isochron::interaction {
namespace {

using nlohmann::json;

constexpr std::size_t kMostStamps = 64;   ///< of one frame
constexpr std::size_t kMostPulses = 64;   ///< likewise
constexpr std::size_t kLongestName = 256; ///< [byte]

constexpr std::array<std::string_view, 3> kQualityNames{"auto", "fast", "quality"};

std::uint32_t step_from(const json& value) {
    return static_cast<std::uint32_t>(
        natural(value, "step", std::numeric_limits<std::uint32_t>::max()));
}

json similarity_json(const Similarity& similarity) {
    const glm::dvec3& t = similarity.translation;
    const glm::dquat& r = similarity.rotation;
    return {{"translation", {t.x, t.y, t.z}},
            {"rotation", {r.x, r.y, r.z, r.w}},
            {"scale", similarity.scale}};
}

Similarity similarity_from(const json& value) {
    Members members(value, "room_from_physical");
    const json& t = list(members.at("translation"), "translation", 3, 3);
    const json& r = list(members.at("rotation"), "rotation", 4, 4);
    Similarity result;
    for (int i = 0; i < 3; ++i)
        result.translation[i] = number(t[i], "translation");
    result.rotation = glm::dquat(number(r[3], "rotation"), number(r[0], "rotation"),
                                 number(r[1], "rotation"), number(r[2], "rotation"));
    require_unit(result.rotation, "rotation", r);
    const json& scale = members.at("scale");
    result.scale = number(scale, "scale");
    if (!(result.scale > 0))
        fail("scale", "a positive number", scale);
    members.done({"translation", "rotation", "scale"});
    return result;
}

json views_json(const std::vector<Viewpoint>& views) {
    json result = json::array();
    for (const Viewpoint& view : views)
        result.push_back({{"name", view.name},
                          {"room_from_physical", similarity_json(view.room_from_physical)}});
    return result;
}

std::vector<Viewpoint> views_from(const json& value) {
    std::vector<Viewpoint> views;
    for (const json& each : list(value, "views", 0, kMostViews)) {
        Members members(each, "views");
        views.push_back({text(members.at("name"), "name", kLongestName),
                         similarity_from(members.at("room_from_physical"))});
        members.done({"name", "room_from_physical"});
    }
    return views;
}

PlaybackState playback_from(const json& value) {
    Members members(value, "playback");
    const PlaybackState state{boolean(members.at("playing"), "playing"),
                              boolean(members.at("reverse"), "reverse"),
                              boolean(members.at("loop"), "loop"),
                              number(members.at("speed"), "speed", kSlowest, kFastest)};
    members.done({"playing", "reverse", "loop", "speed"});
    return state;
}

QualityMode quality_from(const json& value) {
    const auto found = std::ranges::find(kQualityNames, text(value, "quality"));
    if (found == kQualityNames.end())
        fail("quality", "auto, fast or quality", value);
    return static_cast<QualityMode>(found - kQualityNames.begin());
}

json isosurfaces_json(const std::vector<Isosurface>& surfaces) {
    json result = json::array();
    for (const Isosurface& surface : surfaces)
        result.push_back({{"isovalue", surface.isovalue},
                          {"color", {surface.color.x, surface.color.y, surface.color.z}},
                          {"opacity", surface.opacity}});
    return result;
}

float share(const json& value, std::string_view where) {
    return static_cast<float>(number(value, where, 0.0, 1.0));
}

std::vector<Isosurface> isosurfaces_from(const json& value) {
    std::vector<Isosurface> surfaces;
    for (const json& one : list(value, "isosurfaces", 1, kMostIsosurfaces)) {
        Members members(one, "isosurface");
        Isosurface& surface = surfaces.emplace_back();
        surface.isovalue = number(members.at("isovalue"), "isovalue");
        const json& color = list(members.at("color"), "color", 3, 3);
        for (int channel = 0; channel < 3; ++channel)
            surface.color[channel] = share(color[channel], "color");
        surface.opacity = share(members.at("opacity"), "opacity");
        members.done({"isovalue", "color", "opacity"});
    }
    return surfaces;
}

json coloring_json(const Coloring& coloring) {
    json result{{"by", kColorByNames[static_cast<std::size_t>(coloring.by)]},
                {"map", coloring.map}};
    if (coloring.range)
        result["range"] = *coloring.range;
    return result;
}

Coloring coloring_from(const json& value) {
    Members members(value, "coloring");
    Coloring coloring;
    const json& by = members.at("by");
    const auto found = std::ranges::find(kColorByNames, text(by, "by"));
    if (found == kColorByNames.end())
        fail("by", "surface, value or first_crossing", by);
    coloring.by = static_cast<ColorBy>(found - kColorByNames.begin());
    coloring.map = text(members.at("map"), "map", kLongestName);
    if (const json* range = members.find("range")) {
        list(*range, "range", 2, 2);
        coloring.range = {number((*range)[0], "range"), number((*range)[1], "range")};
        if (!((*coloring.range)[0] < (*coloring.range)[1]))
            fail("range", "two ascending numbers", *range);
    }
    members.done({"by", "map", "range"});
    return coloring;
}

json room_panel_json(const RoomPanel& panel) {
    return {{"shown", panel.shown}, {"pose", pose_json(panel.pose)}};
}

RoomPanel room_panel_from(const json& value) {
    Members members(value, "room_panel");
    const RoomPanel panel{boolean(members.at("shown"), "shown"), pose_from(members.at("pose"))};
    members.done({"shown", "pose"});
    return panel;
}

/// No place is null.
json mark_json(const Mark& mark) {
    if (!mark.point)
        return nullptr;
    const glm::dvec3& p = mark.point->position;
    return {
        {"position", {p.x, p.y, p.z}}, {"step", mark.point->step}, {"value", mark.point->value}};
}

Mark mark_from(const json& value) {
    if (value.is_null())
        return {};
    Members members(value, "mark");
    MarkedPoint point;
    const json& position = list(members.at("position"), "position", 3, 3);
    for (int i = 0; i < 3; ++i)
        point.position[i] = number(position[i], "position");
    point.step = step_from(members.at("step"));
    point.value = number(members.at("value"), "value");
    members.done({"position", "step", "value"});
    return {point};
}

json haptics_json(const std::vector<HapticPulse>& pulses) {
    json result = json::array();
    for (const HapticPulse& pulse : pulses)
        result.push_back(
            {{"hand", pulse.hand}, {"seconds", pulse.seconds}, {"amplitude", pulse.amplitude}});
    return result;
}

std::vector<HapticPulse> haptics_from(const json& value) {
    std::vector<HapticPulse> pulses;
    for (const json& one : list(value, "haptics", 0, kMostPulses)) {
        Members members(one, "haptics");
        pulses.push_back({text(members.at("hand"), "hand", kLongestName),
                          number(members.at("seconds"), "seconds", 0.0, kLongestPulse),
                          share(members.at("amplitude"), "amplitude")});
        members.done({"hand", "seconds", "amplitude"});
    }
    return pulses;
}

} // namespace

json commands_json(const Commands& commands) {
    json result = json::object();
    if (commands.isosurfaces)
        result["isosurfaces"] = isosurfaces_json(*commands.isosurfaces);
    if (commands.picked)
        result["picked"] = *commands.picked;
    if (commands.isovalue)
        result["isovalue"] = *commands.isovalue;
    if (commands.step)
        result["step"] = *commands.step;
    if (const auto& playback = commands.playback)
        result["playback"] = {{"playing", playback->playing},
                              {"reverse", playback->reverse},
                              {"loop", playback->loop},
                              {"speed", playback->speed}};
    if (commands.room_from_physical)
        result["room_from_physical"] = similarity_json(*commands.room_from_physical);
    if (commands.quality)
        result["quality"] = kQualityNames[static_cast<std::size_t>(*commands.quality)];
    if (commands.eye_separation)
        result["eye_separation"] = *commands.eye_separation;
    if (commands.stereo)
        result["stereo"] = *commands.stereo;
    if (commands.panel)
        result["panel"] = *commands.panel;
    if (commands.grid)
        result["grid"] = *commands.grid;
    if (commands.views)
        result["views"] = views_json(*commands.views);
    if (commands.axes)
        result["axes"] = *commands.axes;
    if (commands.coloring)
        result["coloring"] = coloring_json(*commands.coloring);
    if (commands.room_panel)
        result["room_panel"] = room_panel_json(*commands.room_panel);
    if (commands.mark)
        result["mark"] = mark_json(*commands.mark);
    if (commands.screenshot)
        result["screenshot"] = true;
    if (commands.quit)
        result["quit"] = true;
    if (!commands.stamps.empty())
        result["stamps"] = commands.stamps;
    if (!commands.haptics.empty())
        result["haptics"] = haptics_json(commands.haptics);
    return result;
}

Commands commands_from(const json& value, std::string_view where) {
    Members members(value, where);
    Commands commands;
    if (const json* found = members.find("isosurfaces"))
        commands.isosurfaces = isosurfaces_from(*found);
    if (const json* found = members.find("picked"))
        commands.picked =
            static_cast<std::uint32_t>(natural(*found, "picked", kMostIsosurfaces - 1));
    if (const json* found = members.find("isovalue"))
        commands.isovalue = number(*found, "isovalue");
    if (const json* found = members.find("step"))
        commands.step = step_from(*found);
    if (const json* found = members.find("playback"))
        commands.playback = playback_from(*found);
    if (const json* found = members.find("room_from_physical"))
        commands.room_from_physical = similarity_from(*found);
    if (const json* found = members.find("quality"))
        commands.quality = quality_from(*found);
    if (const json* found = members.find("eye_separation"))
        commands.eye_separation =
            static_cast<float>(number(*found, "eye_separation", 0.0, kWidestEyes));
    if (const json* found = members.find("stereo"))
        commands.stereo = text(*found, "stereo", kLongestName);
    if (const json* found = members.find("panel"))
        commands.panel = boolean(*found, "panel");
    if (const json* found = members.find("grid"))
        commands.grid = boolean(*found, "grid");
    if (const json* found = members.find("views"))
        commands.views = views_from(*found);
    if (const json* found = members.find("axes"))
        commands.axes = boolean(*found, "axes");
    if (const json* found = members.find("coloring"))
        commands.coloring = coloring_from(*found);
    if (const json* found = members.find("room_panel"))
        commands.room_panel = room_panel_from(*found);
    if (const json* found = members.find("mark"))
        commands.mark = mark_from(*found);
    if (const json* found = members.find("screenshot"))
        commands.screenshot = boolean(*found, "screenshot");
    if (const json* found = members.find("quit"))
        commands.quit = boolean(*found, "quit");
    if (const json* found = members.find("stamps"))
        for (const json& stamp : list(*found, "stamps", 0, kMostStamps))
            commands.stamps.push_back(text(stamp, "stamps", kLongestName));
    if (const json* found = members.find("haptics"))
        commands.haptics = haptics_from(*found);
    members.done(
        {"isosurfaces", "picked",         "isovalue",   "step",  "playback",   "room_from_physical",
         "quality",     "eye_separation", "stereo",     "panel", "grid",       "views",
         "axes",        "coloring",       "room_panel", "mark",  "screenshot", "quit",
         "stamps",      "haptics"});
    return commands;
}

} // namespace isochron::interaction
