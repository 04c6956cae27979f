// Files from other people's tools: values and geometry, compared with independent readings.
#include "index/readers/formats/open_series.h"
#include "tests/support/paths.h"
#include "tests/support/reader_fixtures.h"

#include <glm/vec4.hpp>
#include <gmock/gmock.h>

namespace isochron::index {
namespace {

using testing::HasSubstr;

const std::filesystem::path kFormats = std::filesystem::path(test_support::test_data()) / "formats";

struct Sums {
    /// Sums of v, and of v (i mod 1009), which sees the order.
    std::int64_t plain = 0, weighted = 0;
    bool operator==(const Sums&) const = default;
};

Sums sums_of(VolumeSeries& series, std::size_t step) {
    Sums sums;
    std::int64_t i = 0;
    for (std::int64_t v : values_of<std::int16_t>(series, step)) {
        sums.plain += v;
        sums.weighted += v * (i++ % 1009);
    }
    return sums;
}

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
    for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(a[axis], b[axis], tolerance) << "axis " << axis;
}

// All sums below: NumPy over the bytes after the header, in file order.
TEST(RealNifti, FourDimensionalSeriesReadsForwardsAndBackwards) {
    const auto series = open_series(
        {std::filesystem::path(test_support::test_data()) / "fmri" / "filtered_func_data.nii.gz"});
    ASSERT_EQ(series->info().steps(), 64u);
    EXPECT_EQ(series->info().times[63], 63.0);
    EXPECT_EQ(series->info().anatomy, Anatomy::none); // neither qform nor sform
    EXPECT_EQ(series->info().scaling, Scaling{});
    EXPECT_EQ(sums_of(*series, 63), (Sums{165922277, 82661577878}));
    EXPECT_EQ(sums_of(*series, 0), (Sums{166341695, 82900808975}));
}

TEST(RealNifti, KeepsUnitsTimesAndAnObliqueSform) {
    const auto series = open_series({kFormats / "example4d.nii.gz"});
    const SeriesInfo& info = series->info();
    EXPECT_EQ(info.length_unit, "mm");
    EXPECT_EQ(info.time_unit, "s");
    EXPECT_EQ(info.times, (std::vector<double>{0, 2000}));
    EXPECT_EQ(info.anatomy, Anatomy::ras);
    expect_near(info.grid.spacing, {2, 2, 2.2}, 1e-6);
    expect_near(info.grid.origin, {117.8551025390625, -35.72294235229492, -7.248798370361328},
                1e-9);
    expect_near(info.grid.direction[0], {-1, 0, 0}, 1e-6);
    EXPECT_EQ(sums_of(*series, 1), (Sums{50990959, 25676162662}));
}

TEST(RealNifti, KeepsTheStoredTypeUnderAScaling) {
    const auto series = open_series({kFormats / "functional.nii"});
    EXPECT_EQ(series->info().steps(), 20u);
    EXPECT_EQ(series->info().type, ValueType::i16);
    EXPECT_DOUBLE_EQ(series->info().scaling.slope, 0.07540696859359741);
    EXPECT_DOUBLE_EQ(series->info().scaling.intercept, 3100.76171875);
    EXPECT_EQ(sums_of(*series, 19), (Sums{7521274, 3777408686}));
}

TEST(RealNifti, ReadsBigEndianFiles) {
    const auto series = open_series({kFormats / "anatomical.nii"});
    EXPECT_EQ(series->info().grid.vertices, (std::array<std::uint32_t, 3>{33, 41, 25}));
    EXPECT_EQ(sums_of(*series, 0), (Sums{284166082, 142507416602}));
}

TEST(RealNifti, OfOneVertexAlongAnAxisIsRefused) {
    EXPECT_THAT(error_of([] { open_series({kFormats / "5D_small.nii"}); }),
                HasSubstr("5D_small.nii: 1x2x3"));
}

TEST(RealMetaImage, ReadsCompressedLocalData) {
    const auto series = open_series({kFormats / "3DCT_lung_baseline_small.mha"});
    EXPECT_EQ(series->info().anatomy, Anatomy::lps);
    EXPECT_EQ(series->info().grid.spacing, glm::dvec3(2.732, 2.732, 5));
    EXPECT_EQ(series->info().grid.origin, glm::dvec3(-152.461, -148.986, -1432));
    EXPECT_EQ(sums_of(*series, 0), (Sums{-99576319, -50183180735}));
}

TEST(RealNrrd, GivesTheSameBallInEveryEncoding) {
    for (const char* file : {"BallBinary30x30x30.nhdr", "BallBinary30x30x30.nrrd",
                             "BallBinary30x30x30_gz.nrrd", "BallBinary30x30x30_bz2.nrrd"}) {
        const auto series = open_series({kFormats / file});
        EXPECT_EQ(series->info().anatomy, Anatomy::lps) << file;
        EXPECT_EQ(sums_of(*series, 0), (Sums{3682296, 1863053909})) << file;
    }
}

TEST(RealNrrd, RefusesOneAndTwoDimensions) {
    EXPECT_THAT(error_of([] { open_series({kFormats / "test1d_ascii.nrrd"}); }),
                HasSubstr("1 dimensions, expected 3"));
    EXPECT_THAT(error_of([] { open_series({kFormats / "test2d_ascii.nrrd"}); }),
                HasSubstr("2 dimensions, expected 3"));
}

TEST(RealFiles, CutShortAreRefused) {
    TestFolder folder;
    for (const char* name :
         {"3DCT_lung_baseline_small.mha", "BallBinary30x30x30.nrrd", "BallBinary30x30x30_gz.nrrd",
          "BallBinary30x30x30_bz2.nrrd", "anatomical.nii", "example4d.nii.gz"})
        for (const double part : {0.0, 0.001, 0.5, 0.9}) {
            const std::string whole = read_file(kFormats / name);
            const auto file = folder.write(name, whole.substr(0, part_of(whole.size(), part)));
            EXPECT_THAT(error_of([&] {
                            const auto series = open_series({file});
                            std::vector<std::byte> values(series->info().step_bytes());
                            series->read(series->info().steps() - 1, values);
                        }),
                        HasSubstr(name))
                << part;
        }
}

} // namespace
} // namespace isochron::index
