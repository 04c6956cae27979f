// A picture that the program has written is drawn again from its note, with the same bytes.
#include "tests/app/explore/small_cave.h"
#include "tests/support/as_words.h"
#include "tests/support/child_process.h"
#include "tests/support/index_repair.h"
#include "tests/support/session_fixture.h"

#include "app/output/picture_note.h"
#include "index/volume/volume_series.h"
#include "interaction/recording/recording.h"
#include "stereo/image_file.h"

#include <fmt/format.h>

#include <gmock/gmock.h>

#include <algorithm>
#include <span>

namespace isochron::app {
namespace {

using testing::HasSubstr;

class ReproduceTest : public testing::Test {
  protected:
    ReproduceTest() { build_sphere(folder_.path(), 6); }

    ChildResult isochron(const std::vector<std::string>& arguments) {
        return run_child(test_support::binary_root() + "/isochron", arguments, folder_.path());
    }

    /// Somebody who walks, then stands; with everything that can be seen in the picture.
    void record(const std::string& configuration, const std::string& stereo,
                const interaction::Commands& more = {}) {
        interaction::RecordingHeader header;
        header.configuration = configuration;
        header.data = (folder_.path() / "sphere.isochron").string();
        header.start.stereo = stereo;
        interaction::RecordingWriter writer(folder_.path() / "walk.jsonl", header);
        for (int i = 0; i < 12; ++i) {
            interaction::RecordedFrame frame;
            frame.input = head_at_rest(i < 6 ? i / 60.0 : i);
            frame.input.devices.front().pose->position.x =
                0.02f * static_cast<float>(std::min(i, 6));
            frame.input.devices.push_back(
                {.name = "wand",
                 .pose = interaction::Pose{{0.2f, 1.3f, -0.3f}, {1, 0, 0, 0}},
                 .valuators = {}});
            frame.latched.time = frame.input.time;
            frame.latched.devices = {frame.input.devices.front()};
            frame.latched.devices.front().pose->position.y += 0.01f;
            if (i == 0)
                frame.commands = more;
            if (i < 3)
                frame.commands.instant = index::Instant(static_cast<std::uint32_t>(i));
            if (i == 2 || i == 11)
                frame.commands.stamps = {"now"};
            writer.append(frame);
        }
        writer.finish();
    }

    std::vector<std::string> pictures(const std::vector<std::string>& more) {
        std::filesystem::remove_all(folder_.path() / "out");
        std::vector<std::string> arguments = as_words("replay walk.jsonl --stamps --out out");
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ChildResult result = isochron(arguments);
        EXPECT_EQ(result.status, 0) << result.err;
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(folder_.path() / "out"))
            names.push_back("out/" + entry.path().filename().string());
        std::ranges::sort(names);
        return names;
    }

    /// @param stride only every so manyth picture is made again
    void expect_same(const std::vector<std::string>& more, std::size_t stride = 1) {
        const std::vector<std::string> names = pictures(more);
        for (std::size_t i = 0; i < names.size(); i += stride) {
            const std::string& name = names[i];
            const ChildResult result = isochron({"reproduce", name, "--data", "sphere.isochron"});
            EXPECT_EQ(result.status, 0) << name << ": " << result.out << result.err;
            EXPECT_THAT(result.out, HasSubstr("made again: the same "));
            EXPECT_EQ(folder_.read(name).find(folder_.path().string()), std::string::npos)
                << "a path of this machine in " << name;
        }
    }

    TestFolder folder_;
};

const std::string kOne = "[[windows]]\nsize = [96, 64]\n";

TEST_F(ReproduceTest, WindowsAndEyesOfACaveAreTheSame) {
    record(cave_of("48, 30"), "quadbuffer");
    expect_same({}, 5);
    expect_same({"--eyes", "each"}, 5);
}

TEST_F(ReproduceTest, WhatAnEmulatedCaveShowsIsTheSame) {
    record(cave_of("48, 30"), "quadbuffer");
    expect_same({"--emulate", "--size", "96", "64"}, 3);
}

TEST_F(ReproduceTest, EveryFormatIsTheSame) {
    record(kOne, "side_by_side");
    expect_same({"--format", "exr", "--samples", "1"}, 3);
    expect_same({"--format", "tiff"}, 3);
    expect_same({"--format", "jpg"}, 3);
}

TEST_F(ReproduceTest, EveryFootprintAndStereoModeIsTheSame) {
    record(kOne, "side_by_side");
    expect_same({}, 3);
    expect_same({"--quality", "fast"}, 3);
    expect_same({"--quality", "fast", "--shape", "voxel"}, 3);
    expect_same(as_words("--footprint gaussian --stereo anaglyph_red_cyan"), 3);
    expect_same(as_words("--stereo checkerboard --size 80 70 --ray"), 3);
    expect_same({"--caption"}, 3);
}

TEST_F(ReproduceTest, WhatToolsHaveMadeIsTheSame) {
    interaction::Commands made;
    made.clip = interaction::ClipPlane{true, {16, 16, 16}, {0, 0, 1}};
    made.rulers = interaction::Rulers{
        .list = {{.name = "1", .places = {{4, 16, 16}, {28, 16, 16}}},
                 {.name = "2", .places = {{4, 4, 16}, {4, 28, 16}, {28, 28, 16}}, .angle = true}}};
    made.mark = interaction::Mark{interaction::MarkedPoint{{10, 12, 16}, {}, 8.0}};
    made.isosurfaces = {{8.0, {1, 0.5f, 0.2f}, 1.0f}, {12.0, {0.2f, 0.5f, 1}, 0.4f}};
    made.coloring = interaction::Coloring{interaction::ColorBy::first_crossing, "lagoon", {}};
    made.grid = true;
    record(kOne, "mono", made);
    expect_same({});
}

TEST_F(ReproduceTest, RaysAndCaptionsAreInPicturesThatAskForThem) {
    record(kOne, "mono");
    const auto last = [&](const std::vector<std::string>& more) {
        return stereo::read_image(folder_.path() / pictures(more).back());
    };
    const render::Image plain = last({}), ray = last({"--ray"}), caption = last({"--caption"});
    const auto differ = [&](const render::Image& a, const render::Image& b, int low, int high) {
        int pixels = 0;
        for (int y = low; y < high; ++y)
            for (int x = 0; x < a.width; ++x)
                pixels += std::memcmp(a.at(x, y), b.at(x, y), 3) != 0;
        return pixels;
    };
    EXPECT_GT(differ(plain, ray, 0, 64), 5);
    EXPECT_GT(differ(plain, caption, 0, 28), 100) << "at the top";
    EXPECT_GT(differ(plain, caption, 40, 64), 50) << "axes and scale bar below";
}

TEST_F(ReproduceTest, DataThatWereReadOtherwiseAreToldByTheirReading) {
    record(kOne, "mono");
    const std::string now = folder_.read("sphere.isochron");
    std::string before = now;
    const std::string key = "\"reading_number\":";
    --before[before.rfind(key) + key.size()];
    index::repair_checksums(std::as_writable_bytes(std::span(before)));
    folder_.write("sphere.isochron", before);
    EXPECT_THAT(isochron({"info", "sphere.isochron"}).out, HasSubstr("were read otherwise"));
    const std::string picture = pictures({}).front();
    const auto reproduced = [&] {
        const ChildResult result = isochron({"reproduce", picture, "--data", "sphere.isochron"});
        EXPECT_EQ(result.status, 0) << result.err;
        return result.err;
    };
    EXPECT_THAT(reproduced(), testing::Not(HasSubstr("read otherwise")));
    folder_.write("sphere.isochron", now);
    EXPECT_THAT(isochron({"info", "sphere.isochron"}).out,
                testing::Not(HasSubstr("were read otherwise")));
    EXPECT_THAT(reproduced(), HasSubstr(fmt::format("read otherwise (reading {}, sphere.isochron "
                                                    "has {})",
                                                    index::kReading - 1, index::kReading)));
}

TEST_F(ReproduceTest, OtherDataAreToldByTheirHash) {
    record(kOne, "mono");
    const std::string picture = pictures({}).front();
    std::filesystem::create_directory(folder_.path() / "other");
    build_sphere(folder_.path() / "other", 7);
    ChildResult result = isochron({"reproduce", picture, "--data", "other/sphere.isochron"});
    EXPECT_EQ(result.status, 1);
    EXPECT_THAT(result.err, HasSubstr("made of other data: expected hash "));
    // Found here by its name; elsewhere not.
    EXPECT_EQ(isochron({"reproduce", picture}).status, 0);
    std::filesystem::remove(folder_.path() / "sphere.isochron");
    result = isochron({"reproduce", picture});
    EXPECT_EQ(result.status, 1);
    EXPECT_THAT(result.err, HasSubstr("it shows sphere.isochron (hash "));
}

TEST_F(ReproduceTest, ChangedPixelsAndOtherStatesAreTold) {
    record(kOne, "mono");
    const std::string picture = pictures({}).back();
    const auto path = folder_.path() / picture;
    const std::string note = note_text_in(path);
    render::Image image = stereo::read_image(path);
    image.rgba[4 * (96 * 3 + 7)] ^= 5;
    stereo::write_image(image, folder_.path() / "changed.png", note);
    ChildResult result = isochron({"reproduce", "changed.png", "-o", "again.png"});
    EXPECT_EQ(result.status, 1);
    EXPECT_THAT(result.out, HasSubstr("differs: pixels: 1 of 6144 differ, by at most "));
    EXPECT_THAT(result.out, HasSubstr("the first at 7, 3\n"));
    EXPECT_EQ(folder_.read("again.png"), folder_.read(picture));

    PictureNote other = note_from(note);
    other.program = "isochron 9.9.9";
    other.state.isovalue = 4.0;
    other.state.isosurfaces->front().isovalue = 4.0;
    stereo::write_image(stereo::read_image(path), folder_.path() / "other.png", text_of(other));
    result = isochron({"reproduce", "other.png"});
    EXPECT_EQ(result.status, 1);
    EXPECT_THAT(result.out, HasSubstr("differs: program: isochron 9.9.9, this is "));
    EXPECT_THAT(result.out, HasSubstr("differs: pixels: "));
}

// Such as those of a version that compresses otherwise.
TEST_F(ReproduceTest, TheSamePixelsInOtherBytesAreTheSamePicture) {
    record(kOne, "mono");
    for (const char* format : {"png", "jpg"}) {
        const std::string picture = pictures({"--format", format}).back();
        folder_.write(std::string("longer.") + format, folder_.read(picture) + "more");
        const ChildResult result = isochron({"reproduce", std::string("longer.") + format});
        EXPECT_EQ(result.status, 0) << result.err;
        EXPECT_THAT(result.out,
                    HasSubstr("made again: the same pixels, which the file stores in other bytes"));
    }
    // Other pixels of a JPEG are told, too.
    const std::string picture = pictures({"--format", "jpg"}).back();
    render::Image image = stereo::read_image(folder_.path() / picture);
    for (std::size_t i = 0; i < 4 * 96; ++i)
        image.rgba[i] ^= 40;
    stereo::write_image(image, folder_.path() / "other.jpg",
                        note_text_in(folder_.path() / picture));
    const ChildResult result = isochron({"reproduce", "other.jpg"});
    EXPECT_EQ(result.status, 1);
    EXPECT_THAT(result.out, HasSubstr("differs: pixels: "));
}

TEST_F(ReproduceTest, WhatIsNoPictureOfOursIsOneLine) {
    const render::Image image{8, 8, std::vector<std::uint8_t>(256, 9)};
    stereo::write_image(image, folder_.path() / "plain.png");
    stereo::write_image(image, folder_.path() / "cut.png",
                        "<isochron-picture>{</isochron-picture>");
    folder_.write("text.png", "no picture");
    const std::string whole = folder_.read("plain.png");
    folder_.write("half.png", whole.substr(0, 60));
    for (const auto& [name, what] :
         {std::pair{"plain.png", "it has no note of what it shows"},
          std::pair{"cut.png", "not JSON at byte "}, std::pair{"text.png", "text.png: "},
          std::pair{"none.png", "none.png: "},
          std::pair{"half.png", "half.png: the file ends early"}}) {
        const ChildResult result = isochron({"reproduce", name});
        EXPECT_EQ(result.status, 1) << name;
        EXPECT_THAT(result.err, HasSubstr(what));
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    }
}

} // namespace
} // namespace isochron::app
