// The script that plays a headset in a separate program.
//
// ISOCHRON_PLAYED_HEADSET names a JSON file. `log` is the file for violations, pulses and frames, a
// line of JSON each; `paced` and `connected` are as in played_headset.h, `eye_size` is the recommended
// size of an eye's picture (2 numbers). `frames` is a list of changes. Each has `at`, the frame from
// which it holds (counted by xrWaitFrame), and any of `head`, `left` and `right` (7 numbers: x y z,
// then the quaternion x y z w), `inputs` (`right/squeeze/value`: 1), `happens` (`exit`,
// `lose_session`, ..., or `interrupt`, which is Ctrl+C in the terminal), `picture` (a file for the
// left eye's picture of the previous frame, as PPM) and `right_picture` (likewise).
#include "tests/support/played_headset/world.h"

#include <nlohmann/json.hpp>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

namespace isochron::played {
namespace {

using nlohmann::json;

json& script() {
    static json one;
    return one;
}

interaction::Pose pose_of(const json& numbers) {
    const auto v = numbers.get<std::array<float, 7>>();
    return {{v[0], v[1], v[2]}, glm::quat(v[6], v[3], v[4], v[5])};
}

Happening happening_of(const std::string& name) {
    static const std::map<std::string, Happening> all{{"exit", Happening::exit},
                                                      {"hide", Happening::hide},
                                                      {"cover", Happening::cover},
                                                      {"show", Happening::show},
                                                      {"recenter", Happening::recenter},
                                                      {"lose_session", Happening::lose_session},
                                                      {"lose_at_once", Happening::lose_at_once},
                                                      {"lose_instance", Happening::lose_instance}};
    return all.at(name);
}

void place(Hand& hand, const json& numbers) {
    hand.present = true;
    hand.grip = hand.aim = pose_of(numbers);
}

void write_picture(const std::filesystem::path& path, std::size_t eye) {
    const auto& frames = world().headset.frames;
    if (frames.empty() || frames.back().views.size() <= eye)
        return;
    const render::Image& picture = frames.back().views[eye].picture;
    std::ofstream file(path, std::ios::binary);
    file << "P6\n" << picture.width << " " << picture.height << "\n255\n";
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4)
        file.write(reinterpret_cast<const char*>(&picture.rgba[i]), 3);
}

void write_line(const json& line) {
    std::ofstream(world().log, std::ios::app) << line.dump() << "\n";
}

/// Writes everything since the last frame into the log, and drops the pictures.
void write_log() {
    PlayedHeadset& headset = world().headset;
    for (const Pulse& pulse : std::exchange(headset.pulses, {}))
        write_line({{"pulse", pulse.hand}, {"amplitude", pulse.amplitude}});
    for (const SubmittedFrame& frame : std::exchange(headset.frames, {}))
        write_line({{"frame", frame.display_time},
                    {"views", frame.views.size()},
                    {"session", headset.sessions},
                    {"depth", !frame.views.empty() && !frame.views[0].depth.empty()}});
}

} // namespace

void read_script() {
    const char* path = std::getenv("ISOCHRON_PLAYED_HEADSET");
    if (!path || !script().is_null())
        return;
    std::ifstream file(path);
    script() = json::parse(file);
    world().log = script().at("log").get<std::string>();
    world().headset.paced = script().value("paced", true);
    world().headset.connected = script().value("connected", true);
    const auto size = script().value("eye_size", std::array<int, 2>{96, 96});
    for (Eye& eye : world().headset.eyes)
        eye.size = {size[0], size[1]};
}

void play_script(std::size_t frame) {
    if (script().is_null())
        return;
    PlayedHeadset& headset = world().headset;
    for (const json& each : script().at("frames")) {
        if (each.at("at").get<std::size_t>() != frame)
            continue;
        if (each.contains("picture"))
            write_picture(each["picture"].get<std::string>(), 0);
        if (each.contains("right_picture"))
            write_picture(each["right_picture"].get<std::string>(), 1);
        if (each.contains("head"))
            headset.head = pose_of(each["head"]);
        if (each.contains("left"))
            place(headset.left, each["left"]);
        if (each.contains("right"))
            place(headset.right, each["right"]);
        const json inputs = each.value("inputs", json::object());
        for (const auto& [name, value] : inputs.items()) {
            const bool left = name.starts_with("left/");
            (left ? headset.left : headset.right).inputs[name.substr(left ? 5 : 6)] = value;
        }
        if (each.value("happens", "") == "interrupt")
            ::raise(SIGINT);
        else if (each.contains("happens"))
            headset.happens(happening_of(each["happens"]));
    }
    write_log();
}

} // namespace isochron::played
