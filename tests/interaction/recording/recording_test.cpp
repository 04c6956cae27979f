// Recordings are read as they were written, and damaged files only give an error.
#include "interaction/recording/recording.h"

#include "interaction/recording/commands_json.h"

#include "tests/interaction/input_builders.h"
#include "tests/interaction/recording/random_commands.h"
#include "tests/interaction/recording/recording_in.h"
#include "tests/support/paths.h"
#include "tests/support/test_folder.h"
#include "tests/support/test_seed.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

namespace isochron::interaction {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class RecordingFile : public testing::Test {
  protected:
    void write(const std::string& content) {
        fs::remove(path_); // some file systems flush a file that is overwritten
        std::ofstream(path_, std::ios::binary) << content;
    }
    static std::string content_of(const fs::path& path) {
        std::ostringstream content;
        content << std::ifstream(path, std::ios::binary).rdbuf();
        return content.str();
    }
    /// The complaint about a recording with these lines after a good header.
    std::string complaint(const std::string& lines) {
        write(header_line() + lines);
        return complaint();
    }
    std::string complaint() {
        try {
            recording_in(path_);
        } catch (const Error& error) {
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
            return error.what();
        }
        return "no complaint";
    }
    static std::string header_line() {
        return R"({"format":"isochron recording","version":2,"program":"isochron 0.1.0",)"
               R"("configuration":"","data":"a.isochron","data_hash":"00ff","start":{}})"
               "\n";
    }

    const test_support::TestFolder files_;
    const fs::path folder_ = files_.path(), path_ = folder_ / "walk.jsonl";
};

DeviceState random_device(Random& random, std::string name) {
    DeviceState device{std::move(name), std::nullopt, random() % 4 != 0, 0, {}};
    if (random() % 2)
        device.pose = Pose{{float(uniform(random, -3, 3)), 1e-30f, -0.0f}, random_rotation(random)};
    if (device.name == "keys")
        device.actions = std::uint64_t{random()} << 32 | random();
    else if (random() % 2)
        device.buttons = std::uint64_t{random()} << 32 | random();
    for (unsigned i = random() % 4; i > 0; --i)
        device.valuators.push_back(static_cast<float>(uniform(random, -1, 1)));
    device.pose_lost = !device.pose_valid && random() % 2;
    if (random() % 2)
        device.velocity =
            Velocity{{uniform(random, -3, 3), 1e-300, 0}, {0, uniform(random, -9, 9), 1}};
    if (random() % 2)
        device.measured = Seconds(uniform(random, -1, 100));
    if (random() % 2)
        device.device_time = Seconds(uniform(random, 0, 4e9));
    return device;
}

Recording random_recording(unsigned seed, int frames) {
    Random random(seed);
    Recording recording;
    recording.header = {
        2,     "isochron 0.1.0",        "[a]\nb = \"c\"\n", "data/ä b.isochron", "00ff", {640, 480},
        0.025, random_commands(random), random() % 3};
    RecordedFrame frame;
    for (int i = 0; i < frames; ++i) {
        frame.input.time += Seconds(random() % 3 ? uniform(random, 0, 0.5) : 0.0);
        if (i == 0 || random() % 8 == 0) {
            frame.input.devices.clear();
            for (const char* name : {"head", "wand", "keys", "gamepad"})
                if (random() % 3)
                    frame.input.devices.push_back(random_device(random, name));
        }
        for (DeviceState& device : frame.input.devices)
            if (random() % 3 == 0)
                device = random_device(random, device.name);
        frame.commands = random_commands(random);
        frame.from_panel = random_commands(random);
        if (random() % 4 == 0)
            frame.footprint = random() % 2 ? "gaussian" : "quad";
        frame.latched = {};
        if (random() % 2)
            frame.latched = {frame.input.time + Seconds(uniform(random, 0, 0.1)),
                             {random_device(random, "head"), random_device(random, "head 2")}};
        recording.frames.push_back(frame);
    }
    return recording;
}

TEST_F(RecordingFile, EverythingComesBackBitForBit) {
    Random random(test_seed());
    for (int round = 0; round < tries(30); ++round) {
        SCOPED_TRACE(testing::Message() << "round " << round);
        const Recording recording = random_recording(random(), 50);
        write_recording(path_, recording);
        const Recording back = recording_in(path_);
        EXPECT_EQ(back.header, recording.header);
        ASSERT_EQ(back.frames.size(), recording.frames.size());
        for (std::size_t i = 0; i < back.frames.size(); ++i)
            EXPECT_EQ(back.frames[i], recording.frames[i]) << "frame " << i;
        EXPECT_EQ(back.note, "");
    }
}

TEST_F(RecordingFile, WritingAgainWhatWasReadGivesTheSameBytes) {
    write_recording(path_, random_recording(7, 100));
    write_recording(folder_ / "copy.jsonl", recording_in(path_));
    EXPECT_EQ(content_of(path_), content_of(folder_ / "copy.jsonl"));
}

TEST_F(RecordingFile, UnchangedDevicesTakeNoSpace) {
    Recording recording = random_recording(1, 1);
    recording.frames[0].input.time = Seconds(0); // a time of few digits
    for (int i = 0; i < 1000; ++i) {
        RecordedFrame frame{recording.frames[0].input, {}, {}, "gaussian"};
        frame.input.time += Seconds(1 + i);
        recording.frames.push_back(frame);
    }
    write_recording(path_, recording);
    EXPECT_LT(fs::file_size(path_), 22'000u);
}

TEST_F(RecordingFile, AppearsUnderItsNameOnlyWhenFinished) {
    const Recording recording = random_recording(3, 10);
    write("what was here before");
    {
        RecordingWriter writer(path_, recording.header);
        for (const RecordedFrame& frame : recording.frames)
            writer.append(frame);
        EXPECT_EQ(content_of(path_), "what was here before");
        EXPECT_TRUE(fs::exists(path_.string() + ".part"));
    }
    EXPECT_FALSE(fs::exists(path_.string() + ".part"));
    EXPECT_EQ(recording_in(path_).frames.size(), 10u);
}

TEST_F(RecordingFile, ACrashLosesAtMostASecond) {
    RecordingWriter writer(path_, {});
    for (int i = 0; i <= 600; ++i)
        writer.append({{Seconds(i / 60.0), {head_at(kStanding)}}, {}, {}});
    const Recording left = recording_in(path_.string() + ".part");
    ASSERT_FALSE(left.frames.empty());
    EXPECT_GE(left.frames.back().input.time, Seconds(9.0));
}

TEST_F(RecordingFile, WhatWasAppendedSoFarIsARecordingOfItsOwn) {
    const Recording recording = random_recording(4, 30);
    RecordingWriter writer(path_, recording.header);
    for (std::size_t i = 0; i < 12; ++i)
        writer.append(recording.frames[i]);
    writer.copy_to(folder_ / "so_far.jsonl");
    for (std::size_t i = 12; i < 30; ++i)
        writer.append(recording.frames[i]);
    writer.finish();
    EXPECT_EQ(recording_in(folder_ / "so_far.jsonl").frames.size(), 12u);
    EXPECT_EQ(recording_in(folder_ / "so_far.jsonl").note, "");
    EXPECT_EQ(recording_in(path_).frames.size(), 30u);
    EXPECT_THROW(writer.copy_to(folder_ / "nowhere" / "so_far.jsonl"), Error);
}

TEST_F(RecordingFile, ACutLastLineIsLeftOutWithANote) {
    const Recording recording = random_recording(5, 2);
    write_recording(path_, recording);
    const std::string whole = content_of(path_);
    const std::size_t last = whole.rfind('\n', whole.size() - 2) + 1;
    Random random(test_seed());
    for (int round = 0; round < tries(3000); ++round) {
        const std::size_t size = last + 1 + random() % (whole.size() - last - 2);
        write(whole.substr(0, size));
        const Recording back = recording_in(path_);
        EXPECT_EQ(back.frames.size(), 1u);
        EXPECT_EQ(back.note, "walk.jsonl:3: incomplete last line left out");
    }
    write(whole.substr(0, whole.size() - 1)); // complete but for the line end
    EXPECT_EQ(recording_in(path_).frames.size(), 2u);
}

TEST_F(RecordingFile, ComplaintsNameFileAndLine) {
    EXPECT_EQ(complaint("{\"t\":3.2}\n{\"t\":3.1}\n"),
              "walk.jsonl:3: time goes back from 3.2 to 3.1");
    EXPECT_EQ(complaint("{\"t\":0}\n{\"t\":]\n{\"t\":1}\n"), "walk.jsonl:3: not JSON at column 6");
    EXPECT_EQ(complaint("{}\n"), "walk.jsonl:2: frame: \"t\" is missing");
    EXPECT_EQ(complaint("{\"t\":0,\"comands\":{}}\n"),
              "walk.jsonl:2: frame: unknown key \"comands\"");
    EXPECT_EQ(complaint("[1]\n"), "walk.jsonl:2: frame: expected an object, got [1]");
    EXPECT_EQ(complaint("{\"t\":2,\"latched\":{\"t\":1,\"devices\":[]}}\n"),
              "walk.jsonl:2: latched: time goes back from 2 to 1");
    EXPECT_EQ(complaint("{\"t\":null}\n"), "walk.jsonl:2: t: expected a finite number, got null");
    EXPECT_THAT(complaint("{\"t\":NaN}\n"), HasSubstr("walk.jsonl:2: not JSON"));
    EXPECT_THAT(complaint("{\"t\":1e999}\n"), HasSubstr("walk.jsonl:2: a number is out of range"));
    EXPECT_THAT(complaint("\n"), HasSubstr("walk.jsonl:2: not JSON"));
}

TEST_F(RecordingFile, ValuesOutsideTheirRangeAreRefused) {
    const auto with = [&](const std::string& commands) {
        return complaint("{\"t\":0,\"commands\":{" + commands + "}}\n");
    };
    EXPECT_THAT(with(R"("eye_separation":0.2)"), HasSubstr("eye_separation: expected a number"));
    EXPECT_THAT(with(R"("step":-1)"), HasSubstr("step: expected an integer from 0"));
    EXPECT_THAT(with(R"("step":1.5)"), HasSubstr("step: expected an integer from 0"));
    EXPECT_THAT(with(R"("quality":"best")"), HasSubstr("expected auto, fast, quality or paper"));
    EXPECT_THAT(
        with(R"("room_from_physical":{"translation":[0,0,0],"rotation":[0,0,0,1],"scale":0})"),
        HasSubstr("scale: expected a positive number, got 0"));
    EXPECT_THAT(
        with(R"("room_from_physical":{"translation":[0,0,0],"rotation":[0,0,0,2],"scale":1})"),
        HasSubstr("rotation: expected a unit quaternion"));
    const auto device = [&](const std::string& members) {
        return complaint("{\"t\":0,\"devices\":[{" + members + "}]}\n");
    };
    EXPECT_THAT(device(R"("name":"head","pose":[0,0,0,0,0,0,0])"), HasSubstr("unit quaternion"));
    EXPECT_THAT(device(R"("name":"head","pose":[0,0,0])"), HasSubstr("a list of 7"));
    EXPECT_THAT(device(R"("name":"head","buttons":-1)"), HasSubstr("buttons"));
    EXPECT_EQ(device(R"("name":"keys","actions":["play","fly_away"])"),
              "walk.jsonl:2: actions: expected names of actions that this program has, got "
              "\"fly_away\"");
    EXPECT_THAT(device(R"("name":"keys","actions":4096)"), HasSubstr("actions: expected a list"));
    EXPECT_THAT(device(R"("name":"head","valuators":[1e39])"), HasSubstr("valuators"));
    EXPECT_THAT(device(R"("name":"head"},{"name":"head")"), HasSubstr("every name once"));
    EXPECT_THAT(complaint("{\"t\":0,\"changed\":[{\"name\":\"head\"}]}\n"),
                HasSubstr("there was no device \"head\" before"));
}

TEST_F(RecordingFile, BitsOfVersion1BecomeActions) {
    std::string old = header_line();
    old.replace(old.find("\"version\":2"), 11, "\"version\":1");
    write(old +
          R"({"t":0,"devices":[{"name":"keys","buttons":262145},{"name":"more_keys"}]})"
          "\n"
          R"({"t":1,"changed":[{"name":"more_keys","buttons":4294967298}]})"
          "\n"
          R"({"t":2,"devices":[{"name":"more_keys","buttons":1},{"name":"wand","buttons":1}]})"
          "\n");
    const Recording recording = recording_in(path_);
    const ActionSet first = bit(Action::walk_forward) | bit(Action::play);
    EXPECT_THAT(recording.frames[0].input.devices, testing::ElementsAre(keys_down(first)));
    EXPECT_THAT(recording.frames[1].input.devices,
                testing::ElementsAre(keys_down(first | bit(Action::range_last))));
    EXPECT_THAT(recording.frames[2].input.devices,
                testing::ElementsAre(keys_down(bit(Action::range_first)),
                                     DeviceState{"wand", std::nullopt, true, 1, {}}));
    write_recording(folder_ / "copy.jsonl", recording);
    EXPECT_EQ(recording_in(folder_ / "copy.jsonl").header.version, 2);
    EXPECT_EQ(recording_in(folder_ / "copy.jsonl").frames, recording.frames);
}

TEST_F(RecordingFile, TheNamesOfVersion2StayForEver) {
    const Recording recording = recording_in(test_support::test_data() + "/old/version2.jsonl");
    EXPECT_EQ(recording.frames.at(0).input.find("keys")->actions.count(), 82u);
}

TEST_F(RecordingFile, TheOneRulerOfEarlierVersionsIsTheFirstOfTheList) {
    const auto read = [](const char* json) {
        return commands_from(nlohmann::json::parse(json), "here");
    };
    const Commands one = read(R"({"ruler":{"places":[[1,2,3],[4,5,6]]}})");
    const Rulers expected{.list = {{.name = "1", .places = {{1, 2, 3}, {4, 5, 6}}}}};
    EXPECT_EQ(one.rulers, expected);
    EXPECT_EQ(commands_from(commands_json(one), "again").rulers, expected);
    EXPECT_EQ(read(R"({"ruler":{"places":[]}})").rulers, Rulers{});
    EXPECT_EQ(
        read(R"({"keys":[{"time":1,"ruler":{"places":[[1,2,3]]}}]})").keys->at(0).rulers->list,
        (std::vector<Ruler>{{.name = "1", .places = {{1, 2, 3}}}}));
    EXPECT_EQ(read(R"({"mark":{"position":[1,2,3],"step":0,"value":1}})").mark->point->shown, true);
}

TEST_F(RecordingFile, OtherFilesAndNewerVersionsAreRefused) {
    write("");
    EXPECT_EQ(complaint(), "walk.jsonl: not a recording: empty");
    write("{\"a\":1}\n");
    EXPECT_THAT(complaint(), HasSubstr("walk.jsonl:1: not a recording"));
    write("PNG\x89");
    EXPECT_THAT(complaint(), HasSubstr("walk.jsonl:1: not JSON"));
    std::string newer = header_line();
    newer.replace(newer.find("\"version\":2"), 11, "\"version\":3");
    write(newer);
    EXPECT_EQ(complaint(), "walk.jsonl:1: version: this program reads 1 to 2, the recording has 3");
}

TEST_F(RecordingFile, AbsurdSizesAreRefused) {
    EXPECT_THAT(complaint(std::string(100'000, '[') + std::string(100'000, ']') + "\n"),
                HasSubstr("walk.jsonl:2: nested deeper"));
    EXPECT_THAT(complaint("\"" + std::string((16u << 20) + 1, 'x')), HasSubstr("longer than"));
    std::string devices;
    for (int i = 0; i < 65; ++i)
        devices += (i ? ",{\"name\":\"" : "{\"name\":\"") + std::to_string(i) + "\"}";
    EXPECT_THAT(complaint("{\"t\":0,\"devices\":[" + devices + "]}\n"),
                HasSubstr("a list of 0 to 64"));
}

TEST_F(RecordingFile, RandomDamageNeverDoesMoreThanComplain) {
    write_recording(path_, random_recording(11, 8));
    const std::string whole = content_of(path_);
    using namespace std::string_literals; // one of them is the NUL
    const std::string pieces = "{}[]\",:0123456789eE+-.ntf\n\\u\0\xff"s;
    int complaints = 0;
    Random random(test_seed());
    for (int round = 0; round < tries(3000); ++round) {
        SCOPED_TRACE(testing::Message() << "round " << round);
        std::string damaged = whole;
        for (unsigned i = 1 + random() % 4; i > 0 && !damaged.empty(); --i) {
            const std::size_t at = random() % damaged.size();
            switch (random() % 5) {
            case 0: damaged[at] = pieces[random() % pieces.size()]; break;
            case 1: damaged.erase(at, 1 + random() % 20); break;
            case 2: damaged.insert(at, 1, pieces[random() % pieces.size()]); break;
            case 3:
                damaged.insert(at, damaged.substr(random() % damaged.size(), random() % 200));
                break;
            default: damaged.resize(at); break;
            }
        }
        write(damaged);
        try {
            const Recording back = recording_in(path_);
            for (std::size_t i = 1; i < back.frames.size(); ++i)
                ASSERT_GE(back.frames[i].input.time, back.frames[i - 1].input.time);
        } catch (const Error& error) {
            ++complaints;
            EXPECT_THAT(error.what(), HasSubstr("walk.jsonl:"));
        }
    }
    EXPECT_GT(complaints, tries(1000));
}

TEST_F(RecordingFile, WhatCannotBeReadBackIsNotWritten) {
    RecordingWriter writer(path_, {});
    RecordedFrame frame{{Seconds(1), {head_at(kStanding)}}, {}, {}, {}};
    writer.append(frame);
    frame.input.devices[0].pose->position.x = std::nanf("");
    EXPECT_THROW(writer.append(frame), Error);
    frame.input.devices[0].pose->position.x = 0;
    frame.commands.isovalue = std::numeric_limits<double>::infinity();
    EXPECT_THROW(writer.append(frame), Error);
    frame.commands = {};
    frame.input.time = Seconds(0.5);
    EXPECT_THROW(writer.append(frame), Error);
    writer.finish();
    EXPECT_EQ(recording_in(path_).frames.size(), 1u);
}

TEST_F(RecordingFile, AFolderThatDoesNotExistIsNamed) {
    try {
        RecordingWriter writer(folder_ / "nowhere" / "walk.jsonl", {});
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("nowhere/walk.jsonl.part: cannot write: No such file"));
    }
    EXPECT_THROW(RecordingWriter(folder_, {}), Error);
}

} // namespace
} // namespace isochron::interaction
