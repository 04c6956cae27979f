// Building an index: it is complete under its name, or does not exist.
#include "index/error.h"
#include "index/indexing/index_build.h"
#include "index/readers/formats/open_series.h"
#include "tests/support/memory_series.h"
#include "tests/support/reader_fixtures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <fstream>

#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

namespace isochron::index {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class IndexBuildTest : public testing::Test {
  protected:
    /// The message with which building fails; empty if it does not.
    std::string build_error(VolumeSeries& read, const std::filesystem::path& out,
                            const Progress& progress = {}, const BuildOptions& options = {}) {
        try {
            build_index(read, out, options, progress);
        } catch (const std::exception& error) {
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << "one line";
            return error.what();
        }
        return {};
    }

    TestFolder folder;
    TestField field{{40, 30, 20}, 4, ValueType::f32, moving_sphere};
    MemorySeries series{field.view()};
};

TEST_F(IndexBuildTest, TheSameSeriesGivesTheSameBytesOnOneCpuAndOnAll) {
    build_index(series, folder.path() / "a", {});
    cpu_set_t before, one;
    ASSERT_EQ(0, sched_getaffinity(0, sizeof before, &before));
    CPU_ZERO(&one);
    for (int cpu = 0; cpu < CPU_SETSIZE && CPU_COUNT(&one) == 0; ++cpu)
        if (CPU_ISSET(cpu, &before))
            CPU_SET(cpu, &one);
    ASSERT_EQ(0, sched_setaffinity(0, sizeof one, &one));
    build_index(series, folder.path() / "b", {});
    sched_setaffinity(0, sizeof before, &before);
    EXPECT_EQ(read_file(folder.path() / "a"), read_file(folder.path() / "b"));
}

TEST_F(IndexBuildTest, AStepThatCannotBeReadLeavesNothingBehind) {
    series.before_read = [](std::size_t step) {
        if (step == 2)
            throw Error("t2.raw: cannot be read");
    };
    EXPECT_EQ(build_error(series, folder.path() / "a"), "t2.raw: cannot be read");
    EXPECT_THAT(names_in(folder.path()), IsEmpty());
}

TEST_F(IndexBuildTest, ASourceThatChangesMeanwhileLeavesTheOldIndexAsItWas) {
    const auto source = folder.write("t.raw", std::string(4 * 27, 'a'));
    ReadOptions read;
    read.dims = {{3, 3, 3}};
    read.type = ValueType::u8;
    build_index(*open_series({source}, read), folder.path() / "a", {});
    const std::string old = read_file(folder.path() / "a");
    for (const std::size_t size : {std::size_t{4 * 27 + 1}, std::size_t{27}}) {
        folder.write("t.raw", std::string(4 * 27, 'b'));
        const auto changing = open_series({source}, read);
        EXPECT_THAT(build_error(*changing, folder.path() / "a",
                                [&](std::string_view phase, double done) {
                                    if (phase == "reading" && done > 0)
                                        std::filesystem::resize_file(source, size);
                                }),
                    HasSubstr("t.raw: changed while it was read: "));
        EXPECT_EQ(read_file(folder.path() / "a"), old);
        EXPECT_THAT(names_in(folder.path()), ElementsAre("a", "t.raw"));
    }
}

TEST_F(IndexBuildTest, CancelingInAnyPhaseLeavesTheOldIndexAsItWas) {
    build_index(series, folder.path() / "a", {});
    const std::string old = read_file(folder.path() / "a");
    std::vector<std::string> phases;
    const BuildOptions everything{.tiers = TierSet().with(Tier::bricks).with(Tier::tree)};
    build_index(series, folder.path() / "a", everything, [&](std::string_view phase, double) {
        if (phases.empty() || phases.back() != phase)
            phases.emplace_back(phase);
    });
    EXPECT_NE(read_file(folder.path() / "a"), old);
    const std::string replaced = read_file(folder.path() / "a");
    ASSERT_GE(phases.size(), 5u);
    for (const std::string& end : phases) {
        EXPECT_EQ(build_error(
                      series, folder.path() / "a",
                      [&](std::string_view phase, double) {
                          if (phase == end)
                              throw std::runtime_error("enough");
                      },
                      everything),
                  "enough");
        EXPECT_THAT(names_in(folder.path()), ElementsAre("a"));
        EXPECT_EQ(read_file(folder.path() / "a"), replaced);
    }
}

TEST_F(IndexBuildTest, AFullDiskIsToldAndLeavesNothingBehind) {
    build_index(series, folder.path() / "whole", {});
    const auto whole = static_cast<rlim_t>(std::filesystem::file_size(folder.path() / "whole"));
    std::filesystem::remove(folder.path() / "whole");
    // A limit on the size of files fails a write as a full disk does.
    struct rlimit before{};
    ASSERT_EQ(0, getrlimit(RLIMIT_FSIZE, &before));
    const auto previous = std::signal(SIGXFSZ, SIG_IGN);
    for (const rlim_t limit : {rlim_t{0}, rlim_t{10'000}, whole / 2, whole - 1}) {
        struct rlimit small = before;
        small.rlim_cur = limit;
        ASSERT_EQ(0, setrlimit(RLIMIT_FSIZE, &small));
        const std::string error = build_error(series, folder.path() / "a");
        setrlimit(RLIMIT_FSIZE, &before);
        EXPECT_THAT(error, HasSubstr("cannot be written: File too large")) << limit;
        EXPECT_THAT(names_in(folder.path()), IsEmpty()) << limit;
    }
    std::signal(SIGXFSZ, previous);
}

TEST_F(IndexBuildTest, PlacesThatCannotBeWrittenAreToldBeforeAnythingIsRead) {
    series.before_read = [](std::size_t) { FAIL() << "read"; };
    EXPECT_THAT(build_error(series, folder.path() / "no/such/a"), HasSubstr("there is no folder"));
    EXPECT_THAT(build_error(series, folder.path()), HasSubstr("not a regular file"));
    EXPECT_THAT(build_error(series, "/dev/null"), HasSubstr("not a regular file"));
    EXPECT_THAT(build_error(series, "/proc/a.isochron"), HasSubstr("cannot be written"));
    std::ofstream(folder.path() / "volume.raw") << "precious";
    EXPECT_THAT(build_error(series, folder.path() / "volume.raw"),
                HasSubstr("exists and is not an isochron index: not replaced"));
    EXPECT_EQ(read_file(folder.path() / "volume.raw"), "precious");
    EXPECT_THAT(names_in(folder.path()), ElementsAre("volume.raw"));
}

TEST_F(IndexBuildTest, SeriesBeyondTheLimitsAreRefused) {
    const auto with = [&](const std::function<void(SeriesInfo&)>& change) {
        MemorySeries changed(field.view());
        changed.before_read = [](std::size_t) { FAIL() << "read"; };
        change(changed.info());
        return build_error(changed, folder.path() / "a");
    };
    EXPECT_THAT(with([](auto& info) { info.grid.vertices = {1, 5, 5}; }), HasSubstr("vertices"));
    EXPECT_THAT(with([](auto& info) { info.grid.vertices = {70'000, 2, 2}; }),
                HasSubstr("vertices"));
    EXPECT_THAT(with([](auto& info) { info.grid.vertices = {65537, 65537, 2}; }),
                HasSubstr("cells"));
    EXPECT_THAT(with([](auto& info) { info.grid.vertices = {4096, 4096, 2049}; }),
                HasSubstr("34376515584 vertices, expected at most 2^35 in a step"));
    EXPECT_THAT(with([](auto& info) { info.grid.spacing.y = 0; }), HasSubstr("spacing"));
    EXPECT_THAT(with([](auto& info) { info.grid.direction[2] = info.grid.direction[1]; }),
                HasSubstr("one plane"));
    EXPECT_THAT(with([](auto& info) { info.times = {0, 1, 1, 2}; }), HasSubstr("step 2"));
    EXPECT_THAT(with([](auto& info) { info.times.clear(); }), HasSubstr("0 steps"));
    EXPECT_THAT(with([](auto& info) { info.scaling.slope = 0; }), HasSubstr("slope"));
    EXPECT_THAT(names_in(folder.path()), IsEmpty());
}

} // namespace
} // namespace isochron::index
