// Several arrays of one file: what its library decodes together is decoded once.

#include "index/readers/formats/open_series.h"
#include "index/volume/volume_series.h"
#include "tests/support/reader_fixtures.h"

#include <fmt/format.h>

#include <sys/inotify.h>
#include <unistd.h>

#include <array>
#include <memory>
#include <thread>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;

/// Counts how often a file is opened, by whatever process.
class Opens {
  public:
    explicit Opens(const fs::path& file) : events_(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC)) {
        // Events that equal the one before are told once, so closing counts, too.
        if (::inotify_add_watch(events_, file.c_str(), IN_OPEN | IN_ACCESS | IN_CLOSE) < 0)
            throw Error("cannot watch " + file.string());
    }
    ~Opens() { ::close(events_); }
    Opens(const Opens&) = delete;
    Opens& operator=(const Opens&) = delete;

    /// Since the last call.
    int count() {
        int opened = 0;
        alignas(inotify_event) std::array<char, 4096> told;
        for (ssize_t size; (size = ::read(events_, told.data(), told.size())) > 0;)
            for (ssize_t at = 0; at < size;) {
                const auto* event = reinterpret_cast<const inotify_event*>(told.data() + at);
                opened += (event->mask & IN_OPEN) ? 1 : 0;
                at += static_cast<ssize_t>(sizeof(inotify_event) + event->len);
            }
        return opened;
    }

  private:
    int events_;
};

/// Tetrahedra about the corner at 0 of a cube, with three arrays: x, y and z, times a factor.
std::string tetrahedra(double factor) {
    std::string points, cells, offsets, types, arrays;
    const std::array<std::array<int, 3>, 4> at{{{0, 0, 0}, {6, 0, 0}, {0, 6, 0}, {0, 0, 6}}};
    for (const auto& p : at)
        points += fmt::format("{} {} {} ", p[0], p[1], p[2]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        arrays +=
            fmt::format(R"(<DataArray type="Float64" Name="{}" format="ascii">)", "xyz"[axis]);
        for (const auto& p : at)
            arrays += fmt::format("{} ", factor * p[axis]);
        arrays += "</DataArray>";
    }
    return fmt::format(
        R"(<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">
<UnstructuredGrid><Piece NumberOfPoints="4" NumberOfCells="1"><PointData>{}</PointData>
<Points><DataArray type="Float64" Name="p" NumberOfComponents="3" format="ascii">{}</DataArray></Points>
<Cells><DataArray type="Int32" Name="connectivity" format="ascii">0 1 2 3</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">4</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">10</DataArray></Cells>
</Piece></UnstructuredGrid></VTKFile>)",
        arrays, points);
}

class SharedDecodes : public testing::Test {
  protected:
    static std::unique_ptr<VolumeSeries> open(const std::vector<fs::path>& files,
                                              const std::string& array) {
        ReadOptions options;
        options.array = array;
        options.resample = {7, 7, 7};
        return open_series(files, options);
    }
    /// The value at a vertex within, (x, 1, 1).
    static double value(VolumeSeries& series, std::size_t step, std::size_t x) {
        return values_of<double>(series, step).at(x + 7 * (1 + 7 * 1));
    }

    TestFolder folder_;
};

TEST_F(SharedDecodes, OfTheArraysOfAFileAreOne) {
    const fs::path file = folder_.write("t.vtu", tetrahedra(1));
    Opens opens(file);
    auto x = open({file}, "x");
    const int alone = opens.count();
    auto y = open({file}, "y");
    const int second = opens.count();
    auto z = open({file}, "z");
    const int third = opens.count();
    EXPECT_LE(second, 2) << "to see what it is; " << alone << " to read it";
    EXPECT_EQ(third, second);
    EXPECT_GT(alone, second + 2);
    for (int again = 0; again < 2; ++again) {
        EXPECT_NEAR(value(*x, 0, 2), 2, 1e-3);
        EXPECT_NEAR(value(*y, 0, 2), 1, 1e-3);
        EXPECT_NEAR(value(*z, 0, 2), 1, 1e-3);
    }
    EXPECT_EQ(opens.count(), 0);
    x.reset();
    EXPECT_NEAR(value(*y, 0, 2), 1, 1e-3) << "though the first is closed";
    y.reset();
    z.reset();
    open({file}, "y");
    EXPECT_EQ(opens.count(), alone) << "nothing is kept of a closed file";
}

TEST_F(SharedDecodes, OfTheArraysOfASeriesAreOneForEachStep) {
    std::vector<fs::path> files;
    for (int step = 0; step < 3; ++step)
        files.push_back(folder_.write(fmt::format("t{}.vtu", step), tetrahedra(1 + step)));
    const auto x = open(files, "x"), y = open(files, "y");
    for (std::size_t step = 0; step < files.size(); ++step) {
        Opens opens(files[step]);
        EXPECT_NEAR(value(*x, step, 2), 2.0 * static_cast<double>(1 + step), 1e-3);
        opens.count();
        EXPECT_NEAR(value(*y, step, 2), 1.0 * static_cast<double>(1 + step), 1e-3);
        EXPECT_EQ(opens.count(), 0) << step;
    }
}

TEST_F(SharedDecodes, EndWhereTheFileIsAnother) {
    const fs::path file = folder_.write("t.vtu", tetrahedra(1));
    const auto before = open({file}, "x");
    folder_.write("other.vtu", tetrahedra(3));
    fs::rename(folder_.path() / "other.vtu", file);
    EXPECT_NEAR(value(*open({file}, "y"), 0, 1), 3, 1e-3);
}

TEST_F(SharedDecodes, AreNotWaitedForWithinEachOther) {
    const fs::path file = folder_.write("t.vtu", tetrahedra(1));
    const auto x = open({file}, "x"), y = open({file}, "y");
    double within = 0;
    x->stream(0, [&](std::span<const std::byte>) { within = value(*y, 0, 2); });
    EXPECT_NEAR(within, 1, 1e-3);
    EXPECT_NEAR(value(*x, 0, 2), 2, 1e-3);
    EXPECT_NEAR(value(*y, 0, 2), 1, 1e-3);
}

TEST_F(SharedDecodes, MayBeUsedByOtherThreadsAtTheSameTime) {
    const fs::path file = folder_.write("t.vtu", tetrahedra(1));
    const auto x = open({file}, "x"), y = open({file}, "y");
    std::jthread other([&] {
        for (int i = 0; i < 50; ++i)
            EXPECT_NEAR(value(*x, 0, 2), 2, 1e-3);
    });
    for (int i = 0; i < 50; ++i)
        EXPECT_NEAR(value(*y, 0, 2), 1, 1e-3);
}

} // namespace
} // namespace isochron::index
