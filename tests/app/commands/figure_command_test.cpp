// A figure has its words as text, in the sizes that its file says, and is made again.
#include "tests/support/as_words.h"
#include "tests/support/session_fixture.h"

#include "index/indexing/index_build.h"
#include "stereo/image_file.h"
#include "tests/support/child_process.h"
#include "tests/support/memory_series.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <regex>
#include <string>
#include <vector>

namespace isochron::app {
namespace {

using testing::HasSubstr;

constexpr const char* kTwoPanels = R"(width = 120.0
dpi = 150
font_size = 8
margin = 3
gap = 5
caption = "Figure 1. A sphere at two moments; the scale bar says how long."
[[panels]]
index = "sphere.isochron"
step = 1
isovalue = 8.0
title = "first moment"
[[panels]]
index = "sphere.isochron"
step = 5
isosurfaces = [{isovalue = 6.0, color = [0.2, 0.4, 0.8]}, {isovalue = 12.0, opacity = 0.5}]
)";

/// A word of a page [mm].
struct PageWord {
    std::string text;
    double left, top, right, bottom;
};

class FigureCommand : public testing::Test {
  protected:
    FigureCommand() {
        build_sphere(folder_.path());
        folder_.write("f.toml", kTwoPanels);
    }
    ChildResult isochron(const std::vector<std::string>& words) {
        return run_child(test_support::binary_root() + "/isochron", words, folder_.path());
    }
    ChildResult tool(const std::string& line) {
        return run_child("/bin/sh", {"-c", line}, folder_.path());
    }
    /// The words of a PDF, as poppler finds them.
    std::vector<PageWord> words_of(const std::string& pdf) {
        const std::string text = tool("pdftotext -bbox " + pdf + " -").out;
        const std::regex word(
            R"re(<word xMin="([0-9.]+)" yMin="([0-9.]+)" xMax="([0-9.]+)" yMax="([0-9.]+)">([^<]*)<)re");
        std::vector<PageWord> words;
        for (std::sregex_iterator at(text.begin(), text.end(), word), end; at != end; ++at) {
            const auto mm = [&](int i) { return std::stod((*at)[i]) * 25.4 / 72; };
            words.push_back({(*at)[5], mm(1), mm(2), mm(3), mm(4)});
        }
        return words;
    }
    static const PageWord* found(const std::vector<PageWord>& words, const std::string& text) {
        const auto at = std::ranges::find(words, text, &PageWord::text);
        return at == words.end() ? nullptr : &*at;
    }

    TestFolder folder_;
};

TEST_F(FigureCommand, HasAllWordsAsTextAndTheSizesOfItsFile) {
    const ChildResult made = isochron({"figure", "f.toml", "-o", "f.pdf"});
    ASSERT_EQ(made.status, 0) << made.err;
    const std::string about = tool("pdfinfo f.pdf").out;
    std::smatch size;
    ASSERT_TRUE(
        std::regex_search(about, size, std::regex("Page size: +([0-9.]+) x ([0-9.]+) pts")));
    EXPECT_NEAR(std::stod(size[1]) * 25.4 / 72, 120.0, 0.1);
    const auto words = words_of("f.pdf");
    std::map<std::string, int> count;
    for (const PageWord& word : words)
        ++count[word.text];
    // Letters, titles, the caption, both surfaces of the second panel, axes with their units.
    for (const char* text : {"a", "b", "first", "moment", "Figure", "bar", "isovalues", "x", "y",
                             "z", "[mm]", "12", "mm"})
        EXPECT_GE(count[text], 1) << text;
    EXPECT_GE(count["0"] + count["10"] + count["20"] + count["30"], 8) << "ticks of the axes";
    // Panels are (120 - 2 * 3 - 5) / 2 = 54.5 mm wide: the letters begin at 3 and 62.5 mm.
    const PageWord *const a = found(words, "a"), *const b = found(words, "b");
    ASSERT_TRUE(a && b);
    EXPECT_NEAR(a->left, 3.0, 0.1);
    EXPECT_NEAR(b->left, 62.5, 0.1);
    EXPECT_NEAR(a->top, b->top, 0.01);
    // A line of DejaVu Sans is as high as 1.164 of its size: 8 points are 2.822 mm.
    const PageWord* const title = found(words, "first");
    ASSERT_TRUE(title);
    EXPECT_NEAR(title->bottom - title->top, 1.164 * 8 * 25.4 / 72, 0.1);
    EXPECT_THAT(tool("pdffonts f.pdf").out, HasSubstr("DejaVuSans-Bold"));
    EXPECT_EQ(tool("pdffonts f.pdf | awk 'NR > 2 && $(NF - 4) != \"yes\"'").out, "")
        << "embedded: the fifth column from the right";
}

TEST_F(FigureCommand, OfPixelsHasAsManyAsItsResolutionSays) {
    for (const char* file : {"f.png", "f.tiff"}) {
        ASSERT_EQ(isochron({"figure", "f.toml", "-o", file}).status, 0);
        const render::Image image = stereo::read_image(folder_.path() / file);
        EXPECT_EQ(image.width, std::lround(120 / 25.4 * 150));
        EXPECT_EQ(image.at(0, 0)[0], 255) << "white";
        EXPECT_EQ(image.at(image.width - 1, image.height - 1)[2], 255);
    }
    EXPECT_THAT(tool("file f.png").out,
                HasSubstr(fmt::format("{} x", std::lround(120 / 25.4 * 150))));
}

/// An index as simulations have them: its first array has one value everywhere.
void build_with_still_first(const std::filesystem::path& path) {
    const auto named = [](const char* name, const index::TestField& field) {
        auto series = std::make_unique<index::MemorySeries>(field.view());
        series->info().array = name;
        return series;
    };
    const std::array<std::uint32_t, 3> shape{12, 10, 8};
    const index::TestField still(shape, 3, index::ValueType::f32,
                                 [](double, double, double, double) { return 1.2; });
    const index::TestField heat(shape, 3, index::ValueType::f32,
                                [](double x, double, double, double t) { return 300 + x + t; });
    const index::TestField load(shape, 3, index::ValueType::f32,
                                [](double, double y, double, double) { return 9000 + y; });
    const auto first = named("density", still), second = named("heat", heat),
               third = named("load", load);
    index::BuildOptions options;
    options.further = {{.series = second.get(), .array = "heat"},
                       {.series = third.get(), .array = "load"}};
    index::build_index(*first, path, options);
}

TEST_F(FigureCommand, ShowsTheFirstArrayWithASurfaceAndOfEachArrayItsOwnIsovalue) {
    build_with_still_first(folder_.path() / "run.isochron");
    folder_.write("f.toml", "width = 120\ndpi = 72\n[[panels]]\nindex = \"run.isochron\"\n"
                            "[[panels]]\nindex = \"run.isochron\"\narray = \"load\"\n");
    ASSERT_EQ(isochron({"figure", "f.toml", "-o", "f.pdf"}).status, 0);
    const std::string words = tool("pdftotext -raw f.pdf -").out;
    EXPECT_THAT(words, testing::ContainsRegex("heat, isovalue 3[01][0-9]"));
    EXPECT_THAT(words, testing::ContainsRegex("load, isovalue 90[01][0-9]"));
    EXPECT_THAT(isochron(as_words("query run.isochron --isovalue 0.5 --step 0")).err,
                HasSubstr("isovalue 0.5 has no surface: density is 1.2 everywhere"));
    // A film begins with that array, too.
    ASSERT_EQ(isochron(as_words("movie run.isochron --film turn -o turn.jsonl")).status, 0);
    EXPECT_THAT(folder_.read("turn.jsonl"), HasSubstr("\"array\":\"heat\""));
}

TEST_F(FigureCommand, NamesTheStepsOfItsGhosts) {
    folder_.write("k.json",
                  R"({"format": "isochron keys", "version": 1, "keys": [{"time": 0, "step": 3,
        "ghosts": {"earlier": 1, "later": 1, "every": 2, "opacity": 0.5}}]})");
    folder_.write("f.toml", "width = 80\ndpi = 72\n[[panels]]\nindex = \"sphere.isochron\"\n"
                            "keys = \"k.json\"\nkey = 1\n");
    ASSERT_EQ(isochron({"figure", "f.toml", "-o", "f.pdf"}).status, 0);
    const std::string words = tool("pdftotext -layout f.pdf -").out;
    EXPECT_THAT(words, testing::ContainsRegex("step 6, later[^z]*step 2, earlier"));
}

TEST_F(FigureCommand, IsMadeAgainAndSaysWhatDiffers) {
    folder_.write("f.toml", "width = 40\ndpi = 72\n[[panels]]\nindex = \"sphere.isochron\"\n");
    ASSERT_EQ(isochron({"figure", "f.toml", "-o", "f.pdf"}).status, 0);
    for (const char* file : {"f.pdf", "f.png"}) {
        EXPECT_EQ(isochron({"figure", "f.toml", "-o", file}).status, 0) << "replaces its own";
        const ChildResult again = isochron({"reproduce", file});
        EXPECT_EQ(again.status, 0) << again.err;
        EXPECT_THAT(again.out, HasSubstr("made again: the same"));
    }
    folder_.write("thesis.pdf", "%PDF-1.5 somebody else's");
    EXPECT_EQ(isochron({"figure", "f.toml", "-o", "thesis.pdf"}).status, 1);
    EXPECT_EQ(folder_.read("thesis.pdf"), "%PDF-1.5 somebody else's");
    std::string bytes = folder_.read("f.pdf");
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
    folder_.write("f.pdf", bytes);
    const ChildResult differs = isochron({"reproduce", "f.pdf"});
    EXPECT_EQ(differs.status, 1);
    EXPECT_THAT(differs.err, HasSubstr("made again, it differs"));
}

TEST_F(FigureCommand, WhatIsWrongIsSaidInALineWithItsPlace) {
    const std::string panel = "[[panels]]\nindex = \"sphere.isochron\"\n";
    const std::vector<std::pair<std::string, std::string>> rows{
        {"width = 5\n" + panel, "f.toml:1: width: expected a number from 20 to 1200, got 5"},
        {"widht = 90\n" + panel, "did you mean 'width'?"},
        {"letters = \"x\"\n" + panel, "expected one of a, A, (a), none, got x"},
        {"dpi = 300\n", "panels: expected 1 to 4 tables [[panels]], got none"},
        {panel + panel + panel + panel + panel, "got 5"},
        {"[[panels]]\nstep = 1\n", "a panel needs an index"},
        {"[[panels]]\nindex = \"none.isochron\"\n", "none.isochron"},
        {panel + "step = 99\n", "does not fit"},
        {panel + "isovalue = \"high\"\n", "isovalue"},
        {panel + "stpe = 1\n", "stpe"},
        {panel + "key = 2\n", "a key of what?"},
        {panel + "array = \"none\"\n", "none"},
        {panel + "aspect = nan\n", "aspect: expected a number from 0.1 to 10"},
        {"width = [\n", "f.toml:"}};
    for (const auto& [text, words] : rows) {
        folder_.write("f.toml", text);
        const ChildResult refused = isochron({"figure", "f.toml", "-o", "f.pdf"});
        EXPECT_EQ(refused.status, 1) << text;
        EXPECT_THAT(refused.err, HasSubstr(words)) << text;
        EXPECT_EQ(std::ranges::count(refused.err, '\n'), 1) << refused.err;
        EXPECT_FALSE(std::filesystem::exists(folder_.path() / "f.pdf"));
    }
    EXPECT_EQ(isochron({"figure", "f.toml", "-o", "f.svg"}).status, 2);
}

} // namespace
} // namespace isochron::app
