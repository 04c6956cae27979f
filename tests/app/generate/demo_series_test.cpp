// The demo series as files: their contents, and that they are complete and always the same.
#include "app/generate/demo_series.h"
#include "index/readers/formats/open_series.h"

#include "index/error.h"
#include "index/scan/scan.h"
#include "index/volume/volume_series.h"
#include "tests/support/reader_fixtures.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;
using index::names_in;
using index::read_file;
using index::TestFolder;
using testing::HasSubstr;

void ignore_progress(std::string_view, double) {}

/// Every file of a folder with its bytes.
std::vector<std::pair<std::string, std::string>> contents(const fs::path& folder) {
    std::vector<std::pair<std::string, std::string>> result;
    for (const std::string& name : names_in(folder))
        result.emplace_back(name, read_file(folder / name));
    return result;
}

/// A series read back, all steps in memory.
struct Loaded {
    index::SeriesInfo info;
    std::vector<std::byte> bytes;

    explicit Loaded(const fs::path& pvd) {
        const auto series = index::open_series({pvd});
        info = series->info();
        bytes.resize(info.steps() * stride());
        for (std::size_t step = 0; step < info.steps(); ++step)
            series->read(step, std::span(bytes).subspan(step * stride(), info.step_bytes()));
    }
    std::size_t stride() const { return (info.step_bytes() + 7) / 8 * 8; }
    index::StepValues values() const {
        return {info.grid, info.type, info.scaling, info.steps(), bytes.data(), stride()};
    }
};

VorticitySeries small_vorticity(std::uint64_t seed, index::ValueType type = index::ValueType::f32) {
    return {.seed = seed, .type = type, .size = 16, .steps = 3};
}

double sphere_at(std::size_t x, std::size_t y, std::size_t z, std::size_t step) {
    const double dx = static_cast<double>(x) - (22.0 + 0.20 * static_cast<double>(step));
    const double dy = static_cast<double>(y) - (19.0 + 0.09 * static_cast<double>(step));
    const double dz = static_cast<double>(z) - (22.0 + 0.12 * static_cast<double>(step));
    return 255.0 * std::exp(-(dx * dx + dy * dy + dz * dz) / 242.0);
}

TEST(SphereSeries, HoldsTheClosedFormInBothTypes) {
    TestFolder folder;
    for (const auto type : {index::ValueType::f32, index::ValueType::u8}) {
        const fs::path dir = folder.path() / std::string(index::name_of(type));
        ASSERT_TRUE(generate(SphereSeries{.type = type}, dir, ignore_progress));
        const Loaded sphere(dir / "sphere.pvd");
        EXPECT_EQ(sphere.info.type, type);
        EXPECT_EQ(sphere.info.array, "sphere");
        EXPECT_EQ(sphere.info.grid, (index::Grid{{61, 50, 60}}));
        ASSERT_EQ(sphere.info.steps(), 55u);
        for (const std::size_t step : {0u, 27u, 54u}) {
            EXPECT_EQ(sphere.info.times[step], static_cast<double>(step));
            std::size_t i = 0;
            for (std::size_t z = 0; z < 60; ++z)
                for (std::size_t y = 0; y < 50; ++y)
                    for (std::size_t x = 0; x < 61; ++x, ++i) {
                        const double expected = sphere_at(x, y, z, step);
                        if (type == index::ValueType::f32)
                            ASSERT_NEAR(sphere.values().step<float>(step)[i], expected,
                                        1e-5 * expected);
                        else
                            ASSERT_NEAR(sphere.values().step<std::uint8_t>(step)[i], expected,
                                        0.5 + 1e-4);
                    }
        }
    }
}

TEST(SphereSeries, HasThePublishedNumberOfActiveCells) {
    TestFolder folder;
    generate(SphereSeries{}, folder.path(), ignore_progress);
    const Loaded sphere(folder.path() / "sphere.pvd");
    double sum = 0.0;
    for (std::uint32_t step = 0; step < 55; ++step) {
        std::vector<index::CellId> cells;
        index::scan(sphere.values(), {.instant = index::Instant(step), .isovalue = 112.5}, cells);
        EXPECT_NEAR(static_cast<double>(cells.size()), 3730.0, 40.0) << "step " << step;
        sum += static_cast<double>(cells.size());
    }
    EXPECT_NEAR(sum / 55.0, 3730.0, 15.0);
}

TEST(VorticitySeries, HasTheGridAndTimesOfTheFlow) {
    TestFolder folder;
    generate(small_vorticity(1), folder.path(), ignore_progress);
    const Loaded vorticity(folder.path() / "vorticity.pvd");
    EXPECT_EQ(vorticity.info.array, "vorticity");
    EXPECT_EQ(vorticity.info.grid.vertices, (std::array<std::uint32_t, 3>{16, 16, 16}));
    EXPECT_NEAR(vorticity.info.grid.spacing.y, 2.0 * std::acos(-1.0) / 16.0, 1e-12);
    const auto& times = vorticity.info.times;
    ASSERT_EQ(times.size(), 3u);
    EXPECT_GT(times[0], 0.0);
    EXPECT_NEAR(times[2] - times[1], times[1] - times[0], 1e-9);
}

TEST(VorticitySeries, RoundsOverTheWholeSeries) {
    TestFolder folder;
    generate(small_vorticity(5), folder.path() / "f32", ignore_progress);
    generate(small_vorticity(5, index::ValueType::u8), folder.path() / "u8", ignore_progress);
    const Loaded exact(folder.path() / "f32" / "vorticity.pvd");
    const Loaded rounded(folder.path() / "u8" / "vorticity.pvd");
    float highest = 0.0F;
    for (std::size_t step = 0; step < 3; ++step)
        for (float value : exact.values().step<float>(step))
            highest = std::max(highest, value);
    for (std::size_t step = 0; step < 3; ++step)
        for (std::size_t i = 0; i < 16 * 16 * 16; ++i)
            ASSERT_NEAR(rounded.values().step<std::uint8_t>(step)[i],
                        255.0 * exact.values().step<float>(step)[i] / highest, 0.5 + 1e-3);
}

TEST(VorticitySeries, FollowsFromTheSeedAlone) {
    TestFolder folder;
    generate(small_vorticity(1), folder.path() / "a", ignore_progress);
    generate(small_vorticity(1), folder.path() / "b", ignore_progress);
    generate(small_vorticity(2), folder.path() / "c", ignore_progress);
    EXPECT_EQ(contents(folder.path() / "a"), contents(folder.path() / "b"));
    EXPECT_NE(read_file(folder.path() / "a" / "vorticity_0000.vti"),
              read_file(folder.path() / "c" / "vorticity_0000.vti"));
}

TEST(DemoSeries, OneThatIsCompleteIsKept) {
    TestFolder folder;
    ASSERT_TRUE(generate(small_vorticity(1), folder.path(), ignore_progress));
    const auto written = fs::last_write_time(folder.path() / "vorticity_0000.vti");
    EXPECT_FALSE(generate(small_vorticity(1), folder.path(), [](std::string_view, double) {
        ADD_FAILURE() << "nothing is left to do";
    }));
    EXPECT_EQ(fs::last_write_time(folder.path() / "vorticity_0000.vti"), written);
}

TEST(DemoSeries, AnotherOfThatNameIsNeverOverwritten) {
    TestFolder folder;
    generate(small_vorticity(1), folder.path(), ignore_progress);
    const auto before = contents(folder.path());
    EXPECT_THAT(
        index::error_of([&] { generate(small_vorticity(2), folder.path(), ignore_progress); }),
        HasSubstr("vorticity.pvd: is another series than"));
    EXPECT_EQ(contents(folder.path()), before);
    fs::remove(folder.path() / "vorticity.json"); // now it is nobody knows whose
    EXPECT_THAT(
        index::error_of([&] { generate(small_vorticity(1), folder.path(), ignore_progress); }),
        HasSubstr("vorticity.pvd"));
}

TEST(DemoSeries, ACanceledOneLeavesNothing) {
    TestFolder folder;
    struct Cancel {};
    EXPECT_THROW(generate(small_vorticity(1), folder.path(),
                          [](std::string_view phase, double fraction) {
                              if (phase == "computing steps" && fraction > 0.5)
                                  throw Cancel();
                          }),
                 Cancel);
    EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{});
}

} // namespace
} // namespace isochron::app
