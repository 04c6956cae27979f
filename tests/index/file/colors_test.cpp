// Colors: the second array in the file, its values on the surface, and first crossings.
#include "index/error.h"
#include "index/file/sections/file_layout.h"
#include "index/indexing/appended_series.h"
#include "index/indexing/index_build.h"
#include "index/search/first_crossing.h"
#include "index/surface/cell_colors.h"
#include "tests/support/memory_series.h"
#include "tests/support/test_field.h"
#include "tests/support/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>

namespace isochron::index {
namespace {

using testing::HasSubstr;

std::string bytes_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

class Colors : public testing::Test {
  protected:
    static constexpr std::array<std::uint32_t, 3> kVertices{17, 12, 9};
    static constexpr std::size_t kSteps = 5;

    Colors()
        : volume_(kVertices, kSteps, ValueType::f32, turbulence(random_)),
          colors_(kVertices, kSteps, ValueType::i16, scaled(turbulence(random_), 900, 40),
                  {0.5, 10}) {}

    std::shared_ptr<const IndexFile> build(const std::string& name, unsigned threads = 0) {
        MemorySeries volume(volume_.view()), colors(colors_.view());
        colors.info().array = "temperature";
        colors.info().value_unit = "K";
        build_index(volume, folder_.path() / name, {.threads = threads, .color = &colors});
        return IndexFile::open(folder_.path() / name);
    }

    test_support::TestFolder folder_;
    std::mt19937 random_{test_seed()};
    TestField volume_, colors_;
};

TEST_F(Colors, ComeOutOfTheFileAsTheyWentIn) {
    const auto file = build("a.isochron");
    const ColorArray* color = file->color();
    ASSERT_NE(color, nullptr);
    EXPECT_EQ(color->array, "temperature");
    EXPECT_EQ(color->value_unit, "K");
    EXPECT_EQ(color->type, ValueType::i16);
    EXPECT_EQ(color->scaling, (Scaling{0.5, 10}));
    const auto sorted = sorted_values(colors_.view());
    EXPECT_EQ(color->low, sorted.front());
    EXPECT_EQ(color->high, sorted.back());
    for (std::uint32_t step = 0; step < kSteps; ++step) {
        const LoadedStep loaded = file->load_color(step);
        EXPECT_TRUE(std::ranges::equal(loaded.values.step<std::int16_t>(step),
                                       colors_.view().step<std::int16_t>(step)));
    }
    EXPECT_NO_THROW(file->verify());
}

TEST_F(Colors, LeaveAllElseAsItIsWithoutThem) {
    const auto with = build("a.isochron");
    MemorySeries volume(volume_.view());
    build_index(volume, folder_.path() / "b.isochron", {});
    const auto without = IndexFile::open(folder_.path() / "b.isochron");
    EXPECT_EQ(without->color(), nullptr);
    EXPECT_EQ(without->stats().color_bytes, 0u);
    EXPECT_EQ(with->content_hash(), without->content_hash());
    EXPECT_EQ(with->stats().file_bytes - without->stats().file_bytes > with->stats().color_bytes,
              true);
}

TEST_F(Colors, GiveTheSameBytesForAnyNumberOfThreads) {
    build("one.isochron", 1);
    build("three.isochron", 3);
    EXPECT_EQ(bytes_of(folder_.path() / "one.isochron"),
              bytes_of(folder_.path() / "three.isochron"));
}

TEST_F(Colors, ThatAreDamagedAreFoundByVerify) {
    const std::filesystem::path path = folder_.path() / "a.isochron";
    EXPECT_GT(build("a.isochron")->stats().color_bytes, 0u);
    std::string bytes = bytes_of(path);
    FileHeader header;
    std::memcpy(&header, bytes.data(), sizeof header);
    const Section steps = header.section(SectionKind::steps);
    ASSERT_EQ(steps.bytes, 2 * 2 * kSteps * sizeof(StepEntry)); // with a level of detail each
    StepEntry last;
    std::memcpy(&last, bytes.data() + steps.offset + (3 * kSteps - 1) * sizeof last, sizeof last);
    bytes[last.offset + 100] ^= 1; // a byte of a chunk
    const std::filesystem::path bad = folder_.path() / "bad.isochron";
    std::ofstream(bad, std::ios::binary) << bytes;
    try {
        IndexFile::open(bad)->verify();
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("colors, step 4"));
    }
}

TEST_F(Colors, OfAnotherGridAreRefused) {
    MemorySeries volume(volume_.view());
    const TestField other({17, 12, 8}, kSteps, ValueType::f32, turbulence(random_));
    MemorySeries colors(other.view());
    try {
        build_index(volume, folder_.path() / "a.isochron", {.color = &colors});
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("vertices"));
    }
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "a.isochron"));
}

TEST(ColorCoordinate, RunsFromEndToEndAndKnowsWhatHasNoValue) {
    EXPECT_EQ(color_coordinate(-3, -3, 5), 0);
    EXPECT_EQ(color_coordinate(5, -3, 5), kColorSteps);
    EXPECT_EQ(color_coordinate(1, -3, 5), kColorSteps / 2);
    EXPECT_EQ(color_coordinate(-99, -3, 5), 0);
    EXPECT_EQ(color_coordinate(99, -3, 5), kColorSteps);
    EXPECT_EQ(color_coordinate(std::nan(""), -3, 5), kNoColor);
    EXPECT_EQ(color_coordinate(7, 7, 7), 0);
    const double most = std::numeric_limits<double>::max();
    EXPECT_EQ(color_coordinate(0, -most, most), kColorSteps / 2);
}

TEST_F(Colors, OfCellsAreThoseOfAFieldThatIsLinear) {
    // Where volume and colors are linear, every cut lies on a plane and colors are exact there.
    const TestField plane(kVertices, 1, ValueType::f64, [](double x, double y, double z, double) {
        return x + 0.3 * y - 0.2 * z;
    });
    const TestField height(kVertices, 1, ValueType::f64, [](double x, double y, double z, double) {
        return 2 * (x + 0.3 * y - 0.2 * z) + 1;
    });
    const double isovalue = 7.77;
    const auto cells = BruteForce(plane.view(), 0).active(isovalue);
    ASSERT_GT(cells.size(), 50u);
    std::vector<std::uint16_t> out(cells.size());
    ASSERT_TRUE(
        color_cells(plane.view(), height.view(), {Instant(0), isovalue}, cells, 0, 30, out));
    for (const std::uint16_t coordinate : out)
        EXPECT_EQ(coordinate, color_coordinate(2 * isovalue + 1, 0, 30));
}

TEST_F(Colors, OfCellsLieBetweenTheirVerticesColors) {
    const StepValues volume = volume_.view(), colors = colors_.view();
    const auto cells = BruteForce(volume, 2).active(0.1);
    const auto sorted = sorted_values(colors);
    std::vector<std::uint16_t> out(cells.size());
    ASSERT_TRUE(
        color_cells(volume, colors, {Instant(2), 0.1}, cells, sorted.front(), sorted.back(), out));
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const auto [x, y, z] = volume.grid.cell_of(cells[i]);
        double low = INFINITY, high = -INFINITY;
        for (unsigned k = 0; k < 8; ++k) {
            const std::size_t vertex =
                (x + (k & 1)) + 17 * ((y + (k >> 1 & 1)) + 12 * std::size_t(z + (k >> 2)));
            low = std::min(low, scaled_value(colors, 2, vertex));
            high = std::max(high, scaled_value(colors, 2, vertex));
        }
        EXPECT_GE(out[i], color_coordinate(low, sorted.front(), sorted.back()));
        EXPECT_LE(out[i], color_coordinate(high, sorted.front(), sorted.back()));
    }
}

TEST_F(Colors, OfCellsAreNoneWhereAVertexHasNone) {
    TestField colors(kVertices, 1, ValueType::f32, turbulence(random_));
    for (std::size_t vertex = 0; vertex < 17 * 12 * 9; ++vertex)
        colors.at<float>(0, vertex) = std::nanf("");
    const auto cells = BruteForce(volume_.view(), 0).active(0.1);
    std::vector<std::uint16_t> out(cells.size());
    StepValues first = volume_.view();
    ASSERT_TRUE(color_cells(first, colors.view(), {Instant(0), 0.1}, cells, 0, 1, out));
    for (const std::uint16_t coordinate : out)
        EXPECT_EQ(coordinate, kNoColor);
}

TEST_F(Colors, ByFirstCrossingAreThoseOfBruteForce) {
    const auto file = build("a.isochron");
    for (const double isovalue : {-0.2, 0.1, 0.4, 9.0}) {
        const auto found = first_crossings(file->info(), search_in(file), isovalue);
        ASSERT_TRUE(found);
        std::vector<std::uint16_t> expected(volume_.view().grid.cell_count(),
                                            FirstCrossings::kNever);
        for (std::size_t step = kSteps; step-- > 0;)
            for (const CellId id : BruteForce(volume_.view(), step).active(isovalue))
                expected[id] = static_cast<std::uint16_t>(step);
        EXPECT_EQ(found->steps, expected);
    }
}

TEST_F(Colors, ByFirstCrossingRunInPhysicalTime) {
    FirstCrossings crossings{.isovalue = 0, .steps = {0, 2, FirstCrossings::kNever, 1}};
    const std::vector<double> times{10, 11, 20};
    const std::vector<CellId> cells{3, 0, 2, 1};
    std::vector<std::uint16_t> out(cells.size());
    color_by_first_crossing(crossings, times, {}, cells, out);
    EXPECT_EQ(out, (std::vector<std::uint16_t>{kColorSteps / 10, 0, kNoColor, kColorSteps}));
}

TEST_F(Colors, ByFirstCrossingStopWhenTheyAreToldTo) {
    const auto file = build("a.isochron");
    std::stop_source stop;
    const Search real = search_in(file);
    int searches = 0;
    const Search stopping = [&](const Query& query, const std::stop_token& token) {
        if (++searches == 2)
            stop.request_stop();
        return token.stop_requested() ? nullptr : real(query, token);
    };
    EXPECT_EQ(first_crossings(file->info(), stopping, 0.1, stop.get_token()), nullptr);
    EXPECT_EQ(searches, 2);
}

} // namespace
} // namespace isochron::index
