// A user who does anything at random in the window, while trackers send anything and files vanish
// and come back; and a program that is killed under them. ISOCHRON_SOAK_SECONDS in the environment
// says how long the user plays, a few dozen acts otherwise; ISOCHRON_KILLS how often it is killed.
#include "tests/app/commands/explore_fixture.h"

#include "app/config/shipped_configs.h"
#include "app/kept/recording_file.h"
#include "stereo/image_file.h"
#include "tests/support/test_seed.h"
#include "tests/support/tracker_packets.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <array>
#include <chrono>
#include <fstream>
#include <iterator>
#include <optional>
#include <random>
#include <stdexcept>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

int setting(const char* name, int otherwise) {
    const char* text = std::getenv(name);
    return text ? std::atoi(text) : otherwise;
}

class Soak : public ExploreTest {
  protected:
    /// One random act of a user, which never ends the program.
    void act() {
        static const std::vector<std::string> kKeys = as_words(
            "w a s d e q g f x z Up Down Prior Next Left Right space r l End plus minus Home "
            "8 9 0 j k t c b n h 1 2 3 ctrl+1 bracketleft bracketright o i u v p m Tab y "
            "Insert ctrl+z ctrl+shift+z 4 5 6 7 Delete F1 Escape");
        const auto place = [&](int most) { return std::to_string(random_() % most); };
        switch (random_() % 10) {
        case 8: return send_packets();
        case 9:
            if (random_() % 4 == 0)
                vanish_for_a_while();
            return;
        case 0:
            return screen_.xdotool({"mousemove", place(640), place(480), "mousedown", "1",
                                    "mousemove", place(640), place(480), "mouseup", "1"});
        case 1:
            return screen_.xdotool(
                {"mousemove", place(640), place(480), "click", std::to_string(1 + random_() % 5)});
        case 2:
            if (random_() % 4 == 0)
                return screen_.resize_window("Isochron: " + file("sphere.isochron"),
                                             int(160 + random_() % 700),
                                             int(120 + random_() % 500));
            [[fallthrough]];
        default:
            const std::string& key = kKeys[random_() % kKeys.size()];
            screen_.xdotool({"key", key});
        }
    }

    /// Poses of a head and a hand, some of them cut short or overwritten at random.
    void send_packets() {
        const auto number = [&](double most) {
            return double(random_() % 2001) * most / 1000 - most;
        };
        for (int i = 0; i < 20; ++i) {
            const interaction::Pose pose{
                {float(number(1)), float(1.5 + number(0.5)), float(number(1))},
                glm::angleAxis(float(number(3)), glm::vec3(0, 1, 0))};
            std::string packet =
                test_support::osc_pose(i % 2 ? "/isochron/head/pose" : "/isochron/wand/pose", pose);
            if (random_() % 4 == 0)
                packet.resize(random_() % packet.size());
            if (random_() % 4 == 0 && !packet.empty())
                packet[random_() % packet.size()] = char(random_());
            sender_->send(packet);
        }
    }
    /// Takes the data away and brings them back, as a share that is unmounted does.
    void vanish_for_a_while() {
        fs::rename(file("sphere.isochron"), file("gone"));
        screen_.xdotool({"key", "Right"});
        await_frame();
        screen_.xdotool({"key", "Up"});
        fs::rename(file("gone"), file("sphere.isochron"));
    }
    /// Writes a configuration whose head and wand are tracked by OSC. @return its name
    std::string tracked_config() {
        const interaction::UdpSocket free({"127.0.0.1", 0});
        sender_.emplace(free.endpoint());
        folder_.write("tracked.toml",
                      std::string(*shipped_config("desktop")) +
                          fmt::format("\n[[osc]]\nport = {}\n[[osc.devices]]\nname = \"head\"\n"
                                      "[[osc.devices]]\nname = \"wand\"\n",
                                      free.endpoint().port));
        return file("tracked.toml");
    }

    static std::size_t entries(const fs::path& folder) {
        return std::size_t(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
    }

    std::mt19937 random_{test_seed()};
    std::optional<test_support::UdpSender> sender_;
};

TEST_F(Soak, ARandomUserIsFollowedAndReplayed) {
    const auto program = explore({"--record", file("walk.jsonl"), "--isovalue", "8",
                                  "--screenshots", file("shots"), "--config", tracked_config()});
    const fs::path process = fmt::format("/proc/{}", program->pid());
    /// Acts for so long, and 30 times at least. @return threads and files of the program then
    const auto play = [&](double seconds) {
        const auto end = Clock::now() + std::chrono::duration<double>(seconds);
        for (int acts = 0; acts < 30 || Clock::now() < end; ++acts)
            act();
        await_frame();
        return std::array{entries(process / "task"), entries(process / "fd")};
    };
    const double seconds = setting("ISOCHRON_SOAK_SECONDS", 0);
    // The workers of pictures, of lists of files and of colors start when they are first needed. A
    // leak grows whenever the user acts.
    std::array<std::size_t, 2> before = play(seconds / 2);
    EXPECT_TRUE(test_support::eventually([&] {
        const auto after = play(seconds / 2);
        const bool grew = after[0] > before[0] + 8 || after[1] > before[1] + 8;
        before = after;
        return !grew;
    })) << before[0]
        << " threads, " << before[1] << " files";
    screen_.xdotool({"key", "m"});
    // Escape first leaves what is open: pages, popups, tools.
    ASSERT_TRUE(test_support::eventually([&] {
        try {
            if (program->runs())
                leave();
        } catch (const std::runtime_error&) { // the window has just gone
        }
        return !program->runs();
    }));
    ASSERT_EQ(program->exit_status(), 0);
    for (const char* folder : {"first", "second"})
        ASSERT_EQ(Program({"replay", file("walk.jsonl"), "--stamps", "--out", file(folder)})
                      .exit_status(),
                  0);
    std::size_t pictures = 0;
    for (const auto& entry : fs::directory_iterator(file("first"))) {
        const fs::path again = fs::path(file("second")) / entry.path().filename();
        EXPECT_EQ(stereo::read_image(entry.path()).rgba, stereo::read_image(again).rgba) << again;
        ++pictures;
    }
    EXPECT_GE(pictures, 1u);
}

TEST_F(Soak, AKilledExplorerLeavesWholeFiles) {
    for (int i = 0; i < setting("ISOCHRON_KILLS", 2); ++i) {
        const auto program = explore({"--record", file("walk.jsonl"), "--force", "--session",
                                      file("s.isochron-session"), "--screenshots", file("shots"),
                                      "--config", tracked_config()});
        for (std::uint32_t acts = random_() % 10; acts > 0; --acts)
            act();
        program->signal(SIGKILL);
        EXPECT_EQ(program->exit_status(), -1);
        EXPECT_FALSE(fs::exists(file("walk.jsonl"))); // it was not finished
        if (fs::exists(file("s.isochron-session"))) {
            EXPECT_TRUE(nlohmann::json::accept(folder_.read("s.isochron-session")));
        }
        if (fs::exists(file("walk.jsonl.part")) && fs::file_size(file("walk.jsonl.part")) > 0) {
            std::ifstream part(file("walk.jsonl.part"));
            std::string line;
            for (int number = 1; std::getline(part, line) && !part.eof();
                 ++number) // the last may be cut
                EXPECT_TRUE(nlohmann::json::accept(line)) << number << ": " << line;
        }
    }
}

} // namespace
} // namespace isochron::app
