// Arrays of VTK's XML images: those that can be read, and what their text says.
#include "index/readers/formats/open_series.h"
#include "tests/support/paths.h"
#include "tests/support/reader_fixtures.h"

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace isochron::index {
namespace {

/// An image of 3 x 3 x 3 vertices.
std::string image_with(const std::string& arrays) {
    return "<VTKFile type='ImageData' version='0.1' byte_order='LittleEndian'><ImageData "
           "WholeExtent='0 2 0 2 0 2' Origin='0 0 0' Spacing='1 1 1'><Piece Extent='0 2 0 2 0 2'>"
           "<PointData>" +
           arrays + "</PointData></Piece></ImageData></VTKFile>";
}

std::string array_of(const std::string& type, const std::string& name, const std::string& value) {
    std::string text = "<DataArray type='" + type + "' Name='" + name + "' format='ascii'>";
    for (int i = 0; i < 27; ++i)
        text += value + " ";
    return text + "</DataArray>";
}

TEST(VtiArrays, ThoseWithoutNumbersThatCanBeReadAreNotOffered) {
    const TestFolder folder;
    const std::string flags = array_of("Bit", "flags", "1"), value = array_of("Float32", "p", "2");
    const auto opened = [&](const std::string& arrays, const ReadOptions& options = {}) {
        folder.write("a.vti", image_with(arrays));
        try {
            return open_series({folder.path() / "a.vti"}, options)->info().array;
        } catch (const Error& error) {
            return std::string(error.what());
        }
    };
    EXPECT_EQ(opened(flags + value), "p");
    EXPECT_THAT(opened(flags + value + array_of("Int16", "q", "3")),
                AllOf(HasSubstr("choose one with --array: p (f32), q (i16)"),
                      testing::Not(HasSubstr("flags"))));
    EXPECT_THAT(opened(flags), HasSubstr("a.vti: holds no array of numbers that can be read"));
    EXPECT_THAT(opened(flags + value, {.array = "flags"}),
                HasSubstr("array flags does not hold numbers that can be read"));
}

TEST(VtiArrays, InfinitiesAsTextAreWhatTheySay) {
    const TestFolder folder;
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const auto with = [&](const std::string& type, const std::string& words) {
        std::string text = "<DataArray type='" + type + "' Name='p' format='ascii'>" + words;
        for (auto left = 26 - std::count(words.begin(), words.end(), ' '); left > 0; --left)
            text += " 3";
        return folder.write("a.vti", image_with(text + "</DataArray>"));
    };
    for (const auto& [word, value] : {std::pair{"inf", kInfinity},
                                      {"-inf", -kInfinity},
                                      {"-INF", -kInfinity},
                                      {"Infinity", kInfinity},
                                      {"+infinity", kInfinity},
                                      {"-Infinity", -kInfinity}}) {
        const auto floats = values_of<float>(*open_series({with("Float32", word)}), 0);
        EXPECT_EQ(floats[0], value) << word;
        EXPECT_EQ(floats[1], 3.f);
        const auto doubles = values_of<double>(*open_series({with("Float64", word)}), 0);
        EXPECT_EQ(doubles[0], static_cast<double>(value)) << word;
    }
    const auto both = values_of<float>(*open_series({with("Float32", "-inf -3.40282347e+38")}), 0);
    EXPECT_EQ(both[0], -kInfinity);
    EXPECT_EQ(both[1], std::numeric_limits<float>::lowest());
}

TEST(VtiArrays, WithoutANameAreToldInOurWords) {
    const TestFolder folder;
    std::string arrays = array_of("Float32", "p", "2");
    arrays.erase(arrays.find(" Name='p'"), 9);
    EXPECT_THAT(error_of([&] { open_series({folder.write("a.vti", image_with(arrays))}); }),
                testing::EndsWith("has no Name"));
}

} // namespace
} // namespace isochron::index
