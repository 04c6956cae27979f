// Pictures are read as they were written; comparisons of pictures can fail.
#include "stereo/image_file.h"

#include "index/error.h"
#include "index/readers/process/process_text.h"
#include "render/gl/gl.h"
#include "tests/support/drawing/image_compare.h"
#include "tests/support/paths.h"
#include "tests/support/test_seed.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace isochron::stereo {
namespace {

namespace fs = std::filesystem;
using render::Image;
using test_support::images_match;

constexpr unsigned kSeed = 7;

/// What stands in notes: JSON between marks, and what XML and TIFF would want written otherwise.
std::string long_note() {
    std::string note = "<isochron-picture>{\"data\":\"\\u00e9 & <b> 'x' \\n\",\"list\":[";
    for (int i = 0; i < 4000; ++i)
        note += std::to_string(i) + ",";
    return note + "0]}</isochron-picture>";
}

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
    std::string bytes_of(const std::string& name) const {
        std::ifstream file(folder_ / name, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    fs::path folder_;
};

const std::vector<std::string> kAllFormats{"a.png", "a.exr", "a.tiff", "a.jpg"};

/// One format, by a file's name; how such a file begins.
struct Kept {
    std::string name, begin;
};
void PrintTo(const Kept& kept, std::ostream* out) {
    *out << kept.name;
}
class KeepsEveryByte : public ImageFile, public testing::WithParamInterface<Kept> {};

TEST_P(KeepsEveryByte, TheTopRowFirstWithItsNote) {
    const auto& [name, begin] = GetParam();
    // More rows than two strips of a TIFF have.
    const Image image = random_image(37, 71);
    write_image(image, folder_ / name, long_note());
    const Image back = read_image(folder_ / name);
    EXPECT_EQ(back.width, 37);
    EXPECT_EQ(back.height, 71);
    EXPECT_EQ(back.rgba, image.rgba);
    EXPECT_EQ(read_note(folder_ / name), long_note());
    EXPECT_EQ(bytes_of(name).substr(0, 4), begin);
    EXPECT_EQ(files(), 1u);
    write_image(image, folder_ / name);
    EXPECT_EQ(read_note(folder_ / name), "");
}

INSTANTIATE_TEST_SUITE_P(ImageFile, KeepsEveryByte,
                         testing::Values(Kept{"a.png", "\x89PNG"}, Kept{"a.tif", {"II*\0", 4}},
                                         Kept{"a.TIFF", {"II*\0", 4}},
                                         Kept{"a.EXR", "\x76\x2f\x31\x01"}));

TEST_F(ImageFile, JpegKeepsTheNoteAndColorsWithinAFew) {
    Image image{64, 48, {}};
    for (int y = 0; y < image.height; ++y)
        for (const int x : {0, 1, 2, 3})
            for (int i = 0; i < 16; ++i)
                image.rgba.insert(image.rgba.end(), {static_cast<std::uint8_t>(4 * y),
                                                     static_cast<std::uint8_t>(60 * x),
                                                     static_cast<std::uint8_t>(250 - 4 * y), 255});
    for (const char* name : {"a.jpg", "a.JPEG"}) {
        write_image(image, folder_ / name, long_note());
        EXPECT_EQ(read_note(folder_ / name), long_note());
        EXPECT_EQ(bytes_of(name).substr(0, 3), "\xff\xd8\xff");
        EXPECT_TRUE(
            images_match(read_image(folder_ / name), image, {.maximum = 8, .mean = 1}, "jpeg"));
    }
}

TEST_F(ImageFile, BytesAreDecodedAsTheFileIs) {
    const Image image = random_image(20, 10);
    for (const std::string& name : kAllFormats) {
        write_image(image, folder_ / name, "a note");
        const std::string bytes = bytes_of(name);
        EXPECT_EQ(decoded_image(std::as_bytes(std::span(bytes)), name).rgba,
                  read_image(folder_ / name).rgba);
    }
}

// Written by libpng and OpenEXR themselves, as Isochron 0.2 did.
TEST_F(ImageFile, PicturesOfEarlierVersionsAreReadWithTheirNotes) {
    for (const char* name : {"of_libraries.png", "of_libraries.exr"}) {
        const fs::path path = fs::path(test_support::test_data()) / "pictures" / name;
        const Image image = read_image(path);
        ASSERT_EQ(image.rgba.size(), 4u * 24 * 16);
        for (int i = 0; i < 24 * 16; ++i)
            for (int c = 0; c < 4; ++c)
                ASSERT_EQ(image.rgba[4 * i + c],
                          c == 3 ? 255 : (37 * (i % 24) + 61 * (i / 24) + 89 * c) % 256)
                    << name;
        EXPECT_EQ(read_note(path), "<isochron-picture>{\"format\":\"isochron picture\","
                                   "\"data\":\"\\u00e9 & <b>\"}</isochron-picture>");
    }
}

TEST_F(ImageFile, PalettesGraysAndSixteenBitsAreRead) {
    const auto rgba = [](const char* name) {
        return read_image(fs::path(test_support::test_data()) / "pictures" / name).rgba;
    };
    using testing::ElementsAre;
    EXPECT_THAT(rgba("gray16.png"), ElementsAre(0, 0, 0, 255, 128, 128, 128, 255, //
                                                255, 255, 255, 255));
    EXPECT_THAT(rgba("gray_alpha.png"), ElementsAre(7, 7, 7, 255, 200, 200, 200, 99));
    const std::vector<std::uint8_t> row{0,  0,   0,  255, 255, 0, 0, 128, //
                                        10, 200, 30, 255, 1,   2, 3, 0};
    std::vector<std::uint8_t> both = row;
    for (const std::size_t pixel : {3, 2, 1, 0})
        both.insert(both.end(), &row[4 * pixel], &row[4 * pixel] + 4);
    EXPECT_EQ(rgba("palette.png"), both);
}

// The number of processors and of threads changes no byte: a child process that has one processor
// writes the same pictures.
TEST_F(ImageFile, OneProcessorWritesTheSameBytes) {
    constexpr const char* kFolder = "ISOCHRON_PICTURES_OF_ONE_PROCESSOR";
    const char* given = std::getenv(kFolder);
    const Image image = random_image(300, 200);
    for (const std::string& name : kAllFormats)
        write_image(image, given ? fs::path(given) / name : folder_ / name, "a note");
    if (given)
        return;
    fs::create_directory(folder_ / "one");
    const std::string command =
        std::string("cpu=$(taskset -cp $$ | sed 's/.*[:,-] *//'); ") + kFolder + "='" +
        (folder_ / "one").string() + "' OPENIMAGEIO_THREADS=1 taskset -c $cpu '" +
        fs::read_symlink("/proc/self/exe").string() +
        "' --gtest_filter=ImageFile.OneProcessorWritesTheSameBytes >/dev/null";
    ASSERT_EQ(std::system(command.c_str()), 0);
    for (const std::string& name : kAllFormats)
        EXPECT_EQ(bytes_of("one/" + name), bytes_of(name)) << name;
}

TEST_F(ImageFile, WritingTwiceGivesTheSameFile) {
    const Image image = random_image(20, 20);
    for (const std::string& name : kAllFormats) {
        std::string contents[2];
        for (std::string& text : contents) {
            write_image(image, folder_ / name, "a note");
            text = bytes_of(name);
        }
        EXPECT_EQ(contents[0], contents[1]) << name;
        // Within a second a date would be the same twice.
        const std::time_t now = std::time(nullptr);
        char year[8];
        std::strftime(year, sizeof year, "%Y:", std::localtime(&now));
        EXPECT_THAT(contents[0], testing::Not(testing::HasSubstr(year))) << name;
    }
    EXPECT_EQ(files(), kAllFormats.size());
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
    EXPECT_THAT(message([&] { write_image(image, folder_ / "a.bmp"); }),
                AllOf(HasSubstr("a.bmp"), HasSubstr(".png, .exr, .tiff or .jpg"), no_newline));
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
    std::ofstream(folder_ / "movie.png") << "GIF89a and so on";
    EXPECT_THAT(message([&] { read_image(folder_ / "movie.png"); }),
                HasSubstr("movie.png: not a picture: expected PNG, EXR, TIFF or JPEG"));
    // Where libjpeg would end the program.
    EXPECT_THAT(message([&] { write_image(random_image(65501, 1), folder_ / "wide.jpg"); }),
                AllOf(HasSubstr("wide.jpg: a picture of 65501 x 1"), no_newline));
    EXPECT_THAT(message([&] { write_image(random_image(65500, 1), folder_ / "wide.jpg"); }),
                "no error");
    for (const char* name : {"a.jpg", "a.tiff"})
        EXPECT_THAT(message([&] { write_image(image, folder_ / name, std::string(64001, 'n')); }),
                    AllOf(HasSubstr(name), HasSubstr("the note of 64001 bytes"), no_newline));
    for (const std::string& name : kAllFormats) {
        const std::string note(name == "a.png" || name == "a.exr" ? 200'000 : 64000, 'n');
        write_image(image, folder_ / name, note);
        EXPECT_EQ(read_note(folder_ / name), note);
    }
}

#ifndef ISOCHRON_SANITIZED // where readers have no fence
TEST_F(ImageFile, IsReadByAReaderBehindTheFence) {
    write_image(random_image(24, 16), folder_ / "a.png", "a note");
    EXPECT_EQ(read_note(folder_ / "a.png"), "a note");
    const std::string parent = "PPid:\t" + std::to_string(::getpid()) + "\n";
    int readers = 0;
    for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
        const std::string status = index::process_text(entry.path() / "status");
        if (!status.starts_with("Name:\tisochron-reader") || status.find(parent) == status.npos)
            continue;
        ++readers;
        EXPECT_THAT(status, testing::HasSubstr("NoNewPrivs:\t1"));
        EXPECT_THAT(status, testing::HasSubstr("Seccomp:\t2"));
    }
    EXPECT_EQ(readers, 1);
}
#endif

/// Each format in a test of its own: every damaged picture is read by a process of its own.
class DamagedImage : public ImageFile, public testing::WithParamInterface<std::string> {};

INSTANTIATE_TEST_SUITE_P(Formats, DamagedImage, testing::ValuesIn(kAllFormats),
                         [](const auto& name) { return name.param.substr(2); });

TEST_P(DamagedImage, IsOneLineOrNone) {
    const std::string& name = GetParam();
    write_image(random_image(24, 16), folder_ / name, "a note");
    EXPECT_EQ(read_note(folder_ / name), "a note");
    const std::string whole = bytes_of(name);
    std::mt19937 random(test_seed());
    int refused = 0;
    const int rounds = tries(30);
    for (int i = 0; i < rounds; ++i) {
        std::string bytes = whole;
        if (i % 2)
            bytes.resize(random() % bytes.size());
        else
            bytes[random() % bytes.size()] ^= char(1 << random() % 8);
        std::ofstream(folder_ / "damaged", std::ios::binary) << bytes;
        testing::internal::CaptureStderr();
        try {
            const Image back = read_image(folder_ / "damaged");
            EXPECT_EQ(back.rgba.size(), std::size_t(4) * back.width * back.height);
        } catch (const std::exception& error) {
            ++refused;
            EXPECT_THAT(error.what(), testing::HasSubstr("damaged"));
            EXPECT_THAT(error.what(), testing::Not(testing::HasSubstr("\n")));
        }
        EXPECT_EQ(testing::internal::GetCapturedStderr(),
                  ""); // the line that the caller writes is the only one
    }
    // Whatever is cut, save the last bytes, which hold no pixels. JPEG has no checksums.
    EXPECT_GE(refused, rounds * (name == "a.jpg" ? 4 : 5) / 10);
}

TEST(ImageCompare, SeesSmallDifferencesAndWritesThem) {
    const Image image = random_image(16, 8);
    EXPECT_TRUE(images_match(image, image, {}, "same"));
    Image other = image;
    other.rgba[20] ^= 4;
    EXPECT_TRUE(images_match(other, image, {.maximum = 4, .mean = 1}, "compare"));
    EXPECT_FALSE(images_match(other, image, {.maximum = 3, .mean = 1}, "compare"));
    EXPECT_FALSE(images_match(other, image, {.maximum = 4, .mean = 0.001}, "compare"));
    const double mean = 4.0 / (3 * 16 * 8);
    EXPECT_TRUE(images_match(other, image, {.maximum = 4, .mean = 1.001 * mean}, "compare"));
    EXPECT_FALSE(images_match(other, image, {.maximum = 4, .mean = 0.999 * mean}, "compare"));
    // Two channels of all pixels differ by more than eight.
    Image strays = image;
    for (const std::size_t i : {4, 6, 81})
        strays.rgba[i] ^= i == 81 ? 8 : 16;
    const double two = 2.0 / (3 * 16 * 8);
    const auto allowed = [](double share) { return test_support::ImageTolerance{255, 255, share}; };
    EXPECT_TRUE(images_match(strays, image, allowed(1.001 * two), "compare"));
    EXPECT_FALSE(images_match(strays, image, allowed(0.999 * two), "compare"));
    strays.rgba[3] = 0; // alpha does not count
    EXPECT_TRUE(images_match(strays, image, allowed(1.001 * two), "compare"));
    EXPECT_FALSE(images_match(other, image, {.maximum = 3, .mean = 1}, "compare"));
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
