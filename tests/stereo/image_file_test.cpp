// Pictures are read as they were written; comparisons of pictures can fail.
#include "stereo/image_file.h"

#include "index/error.h"
#include "render/gl/gl.h"
#include "tests/support/image_compare.h"
#include "tests/support/paths.h"
#include "tests/support/test_seed.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iterator>
#include <random>

namespace isochron::stereo {
namespace {

namespace fs = std::filesystem;
using render::Image;
using test_support::images_match;

constexpr unsigned kSeed = 7;

Image random_image(int width, int height) {
    std::mt19937 engine(kSeed);
    std::uniform_int_distribution<int> byte(0, 255);
    Image image{width, height, {}};
    for (int i = 0; i < 4 * width * height; ++i)
        image.rgba.push_back(static_cast<std::uint8_t>(i % 4 == 3 ? 255 : byte(engine)));
    return image;
}

class ImageFile : public testing::Test {
  protected:
    ImageFile() {
        std::string name = (fs::path(testing::TempDir()) / "pictures_XXXXXX").string();
        folder_ = mkdtemp(name.data());
    }
    ~ImageFile() override { fs::remove_all(folder_); }
    std::size_t files() const {
        return static_cast<std::size_t>(
            std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
    }
    fs::path folder_;
};

TEST_F(ImageFile, PngKeepsEveryByteAndTheTopRowFirst) {
    const Image image = random_image(37, 21);
    write_image(image, folder_ / "a.png");
    const Image back = read_image(folder_ / "a.png");
    EXPECT_EQ(back.width, 37);
    EXPECT_EQ(back.height, 21);
    EXPECT_EQ(back.rgba, image.rgba);
    EXPECT_EQ(files(), 1u);
}

TEST_F(ImageFile, ExrComesBackToTheSameBytes) {
    const Image image = random_image(64, 32);
    write_image(image, folder_ / "a.EXR");
    EXPECT_EQ(read_image(folder_ / "a.EXR").rgba, image.rgba);
    std::ifstream file(folder_ / "a.EXR", std::ios::binary);
    std::string magic(4, '\0');
    file.read(magic.data(), 4);
    EXPECT_EQ(magic, "\x76\x2f\x31\x01");
}

TEST_F(ImageFile, WritingTwiceGivesTheSameFile) {
    const Image image = random_image(20, 20);
    for (const char* name : {"a.png", "a.exr"}) {
        std::string contents[2];
        for (std::string& text : contents) {
            write_image(image, folder_ / name);
            std::ifstream file(folder_ / name, std::ios::binary);
            text.assign(std::istreambuf_iterator<char>(file), {});
        }
        EXPECT_EQ(contents[0], contents[1]) << name;
        // Within a second a date would be the same twice.
        const std::time_t now = std::time(nullptr);
        char year[8];
        std::strftime(year, sizeof year, "%Y:", std::localtime(&now));
        EXPECT_THAT(contents[0].substr(0, 400), testing::Not(testing::HasSubstr(year))) << name;
    }
    EXPECT_EQ(files(), 2u);
}

TEST_F(ImageFile, ErrorsNameTheFileInOneLine) {
    const Image image = random_image(4, 4);
    const auto message = [](auto function) -> std::string {
        try {
            function();
        } catch (const std::exception& error) {
            return error.what();
        }
        return "no error";
    };
    using testing::AllOf;
    using testing::HasSubstr;
    const auto no_newline = testing::Not(HasSubstr("\n"));
    EXPECT_THAT(message([&] { write_image(image, folder_ / "a.jpg"); }),
                AllOf(HasSubstr("a.jpg"), HasSubstr(".png or .exr"), no_newline));
    EXPECT_THAT(message([&] { write_image(image, folder_ / "no" / "a.png"); }),
                AllOf(HasSubstr("no/a.png"), no_newline));
    EXPECT_THAT(message([&] { write_image(Image{}, folder_ / "a.png"); }),
                AllOf(HasSubstr("a.png"), HasSubstr("0x0"), no_newline));
    EXPECT_THAT(message([&] { read_image(folder_ / "none.png"); }),
                AllOf(HasSubstr("none.png"), no_newline));
    std::ofstream(folder_ / "text.png") << "this is no picture";
    EXPECT_THAT(message([&] { read_image(folder_ / "text.png"); }),
                AllOf(HasSubstr("text.png"), no_newline));
    EXPECT_EQ(files(), 1u);
}

TEST_F(ImageFile, DamageIsOneLineOrNone) {
    const Image image = random_image(24, 16);
    std::mt19937 random(test_seed());
    for (const std::string name : {"a.png", "a.exr"}) {
        write_image(image, folder_ / name, "a note");
        EXPECT_EQ(read_note(folder_ / name), "a note");
        std::ifstream file(folder_ / name, std::ios::binary);
        const std::string whole(std::istreambuf_iterator<char>(file), {});
        int refused = 0;
        for (int i = 0; i < 100; ++i) {
            std::string bytes = whole;
            if (i % 2)
                bytes.resize(random() % bytes.size());
            else
                bytes[random() % bytes.size()] ^= char(1 << random() % 8);
            std::ofstream(folder_ / "damaged", std::ios::binary) << bytes;
            try {
                const Image back = read_image(folder_ / "damaged");
                EXPECT_EQ(back.rgba.size(), std::size_t(4) * back.width * back.height);
            } catch (const std::exception& error) {
                ++refused;
                EXPECT_THAT(error.what(), testing::HasSubstr("damaged"));
                EXPECT_THAT(error.what(), testing::Not(testing::HasSubstr("\n")));
            }
        }
        EXPECT_GT(refused, 50) << name; // whatever is cut, at least
    }
}

TEST(ImageCompare, SeesSmallDifferencesAndWritesThem) {
    const Image image = random_image(16, 8);
    EXPECT_TRUE(images_match(image, image, {}, "same"));
    Image other = image;
    other.rgba[20] ^= 4;
    EXPECT_TRUE(images_match(other, image, {.maximum = 4, .mean = 1}, "compare"));
    EXPECT_FALSE(images_match(other, image, {.maximum = 3, .mean = 1}, "compare"));
    EXPECT_FALSE(images_match(other, image, {.maximum = 4, .mean = 0.001}, "compare"));
    const fs::path failed = fs::path(test_support::binary_root()) / "failed_images" / "compare.png";
    const Image beside = read_image(failed);
    EXPECT_EQ(beside.width, 48);
    EXPECT_EQ(beside.at(5, 0)[0], other.at(5, 0)[0]);
    EXPECT_EQ(beside.at(16 + 5, 0)[0], image.at(5, 0)[0]);
    EXPECT_EQ(beside.at(32 + 5, 0)[0], 32);
    fs::remove(failed);
    EXPECT_FALSE(images_match(random_image(8, 8), image, {255, 255}, "compare"));
    fs::remove(failed);
    EXPECT_FALSE(test_support::matches_golden(image, "compare_without_golden", {255, 255}));
    fs::remove(failed.parent_path() / "compare_without_golden.png");
}

} // namespace
} // namespace isochron::stereo
