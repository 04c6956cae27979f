// Left stays left: a landmark keeps its physical position, however the file stores it.
#include "index/readers/formats/open_series.h"
#include "tests/support/reader_fixtures.h"

#include <glm/vec4.hpp>
#include <gmock/gmock.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace isochron::index {
namespace {

using testing::Contains;
using testing::HasSubstr;

constexpr int kNx = 5, kNy = 4, kNz = 3;

/// 60 dark voxels and one bright one, 3 1 2.
std::vector<std::int16_t> landmark() {
    std::vector<std::int16_t> values(kNx * kNy * kNz, 1);
    values[(2 * kNy + 1) * kNx + 3] = 100;
    return values;
}

/// Where the brightest voxel lies in physical space, in RAS whatever the file's own space is.
glm::dvec3 landmark_in_ras(const std::filesystem::path& file) {
    const auto series = open_series({file});
    const auto values = values_of<std::int16_t>(*series, 0);
    const auto at = std::max_element(values.begin(), values.end()) - values.begin();
    const glm::dvec4 index(at % kNx, at / kNx % kNy, at / (kNx * kNy), 1);
    glm::dvec3 p(series->info().grid.physical_from_index() * index);
    EXPECT_NE(series->info().anatomy, Anatomy::none);
    for (int axis = 0; axis < 3; ++axis)
        EXPECT_GT(series->info().grid.spacing[axis], 0);
    if (series->info().anatomy == Anatomy::lps)
        p = {-p.x, -p.y, p.z};
    return p;
}

void expect_at(const glm::dvec3& got, const glm::dvec3& expected) {
    for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(got[axis], expected[axis], 1e-5) << "axis " << axis;
}

/// A NIfTI-1 header and the landmark, spacing 2 3 4, no orientation yet.
class Nifti {
  public:
    Nifti() : header_(352, '\0') {
        put<std::int32_t>(0, 348);
        const std::int16_t dim[8]{3, kNx, kNy, kNz, 1, 1, 1, 1};
        const float pixdim[8]{1, 2, 3, 4, 0, 0, 0, 0};
        for (std::size_t i = 0; i < 8; ++i) {
            put(40 + 2 * i, dim[i]);
            put(76 + 4 * i, pixdim[i]);
        }
        put<std::int16_t>(70, 4);
        put<std::int16_t>(72, 16);
        put(108, 352.0f);
        std::memcpy(header_.data() + 344, "n+1", 4);
    }

    template <class T>
    Nifti& put(std::size_t offset, T value) {
        std::memcpy(header_.data() + offset, &value, sizeof value);
        return *this;
    }
    Nifti& qform(float qfac, const float (&quatern)[3], const float (&offset)[3]) {
        put(76, qfac).put<std::int16_t>(252, 1);
        for (std::size_t i = 0; i < 3; ++i)
            put(256 + 4 * i, quatern[i]).put(268 + 4 * i, offset[i]);
        return *this;
    }
    Nifti& sform(const float (&rows)[12]) {
        put<std::int16_t>(254, 1);
        for (std::size_t i = 0; i < 12; ++i)
            put(280 + 4 * i, rows[i]);
        return *this;
    }
    std::filesystem::path write(const TestFolder& folder) const {
        return folder.write("landmark.nii", header_ + text_of(landmark()));
    }

  private:
    std::string header_;
};

TEST(LeftStaysLeft, InNiftiWithPositiveQfac) {
    TestFolder folder;
    expect_at(landmark_in_ras(Nifti().qform(1, {0, 0, 0}, {10, 20, 30}).write(folder)),
              {10 + 6, 20 + 3, 30 + 8});
    // Half a turn about y, then a quarter turn about z: closed forms of the quaternion.
    expect_at(landmark_in_ras(Nifti().qform(1, {0, 1, 0}, {10, 20, 30}).write(folder)),
              {10 - 6, 20 + 3, 30 - 8});
    expect_at(
        landmark_in_ras(Nifti().qform(1, {0, 0, std::sqrt(0.5f)}, {10, 20, 30}).write(folder)),
        {10 - 3, 20 + 6, 30 + 8});
}

TEST(LeftStaysLeft, InNiftiWithNegativeQfac) {
    TestFolder folder;
    expect_at(landmark_in_ras(Nifti().qform(-1, {0, 0, 0}, {10, 20, 30}).write(folder)),
              {10 + 6, 20 + 3, 30 - 8});
    // The usual radiological file: x to the left, y and z as ever.
    expect_at(landmark_in_ras(Nifti().qform(-1, {0, 1, 0}, {10, 20, 30}).write(folder)),
              {10 - 6, 20 + 3, 30 + 8});
}

TEST(LeftStaysLeft, InNiftiWithAShearedSform) {
    TestFolder folder;
    const auto file = Nifti().sform({2, 0.5, 0, 1, 0, 3, 0.25, 2, 0, 0, 4, 3}).write(folder);
    expect_at(landmark_in_ras(file), {1 + 6 + 0.5, 2 + 3 + 0.5, 3 + 8});
    EXPECT_THAT(open_series({file})->info().notes, Contains("the axes are sheared"));
}

TEST(LeftStaysLeft, InEverySpaceOfNrrd) {
    TestFolder folder;
    const auto nrrd = [&](const std::string& space, const std::string& directions) {
        return folder.write("landmark.nrrd",
                            "NRRD0004\ntype: short\ndimension: 3\nspace: " + space +
                                "\nsizes: 5 4 3\nspace directions: " + directions +
                                "\nspace origin: (10, 20, 30)\nendian: little\n"
                                "encoding: raw\n\n" +
                                text_of(landmark()));
    };
    const std::string straight = "(2,0,0) (0, 3, 0) (0,0,4)";
    expect_at(landmark_in_ras(nrrd("right-anterior-superior", straight)), {16, 23, 38});
    expect_at(landmark_in_ras(nrrd("left-posterior-superior", straight)), {-16, -23, 38});
    expect_at(landmark_in_ras(nrrd("LAS", straight)), {-16, 23, 38});
    expect_at(landmark_in_ras(nrrd("RAS", "(-2,0,0) (0,0,3) (0,4,0)")), {4, 28, 33});
}

TEST(NrrdTime, IsTheSlowestAxis) {
    TestFolder folder;
    std::string text;
    for (int i = 0; i < 24; ++i)
        text += std::to_string(i) + (i % 5 ? " " : "\n");
    const std::string head = "NRRD0005\ntype: unsigned char\ndimension: 4\nsizes: 2 2 2 3\n"
                             "spacings: 1 2 -3 0.5\nunits: \"mm\" \"mm\" \"mm\" \"s\"\n"
                             "encoding: ascii\n";
    const auto series = open_series({folder.write("t.nrrd", head + "\n" + text)});
    EXPECT_EQ(series->info().times, (std::vector<double>{0, 0.5, 1}));
    EXPECT_EQ(series->info().time_unit, "s");
    EXPECT_EQ(series->info().length_unit, "mm");
    EXPECT_EQ(series->info().grid.direction[2], glm::dvec3(0, 0, -1));
    EXPECT_EQ(values_of<std::uint8_t>(*series, 2), ramp<std::uint8_t>(8, 16));
    const auto short_file = folder.write("s.nrrd", head + "\n" + text.substr(0, 55));
    EXPECT_THAT(error_of([&] { values_of<std::uint8_t>(*open_series({short_file}), 2); }),
                HasSubstr("s.nrrd: truncated: "));
}

TEST(LyingHeaders, CostNoMemory) {
    TestFolder folder;
    auto nifti = Nifti().qform(1, {0, 0, 0}, {0, 0, 0});
    for (std::size_t i = 1; i <= 3; ++i)
        nifti.put<std::int16_t>(40 + 2 * i, 1600);
    EXPECT_THAT(error_of([&] { open_series({nifti.write(folder)}); }), HasSubstr("truncated"));
    for (const char* sizes : {"1600 1600 1600", "1000000000 1000000000 1000000000"})
        for (const char* encoding : {"raw", "gzip", "ascii"})
            EXPECT_THAT(error_of([&] {
                            open_series({folder.write(
                                "huge.nrrd", std::string("NRRD0004\ntype: short\ndimension: 3\n"
                                                         "endian: little\nsizes: ") +
                                                 sizes + "\nencoding: " + encoding + "\n\nxx")});
                        }),
                        HasSubstr("huge.nrrd"));
}

TEST(LyingHeaders, DoNotPassForValues) {
    TestFolder folder;
    for (const float offset : {0.0f, 16.0f, 347.0f, -1.0f, std::nanf("")})
        EXPECT_THAT(error_of([&] { open_series({Nifti().put(108, offset).write(folder)}); }),
                    HasSubstr("landmark.nii: the data's offset is"))
            << offset;
}

/// A gzip file of one stored block behind a header that holds a file name.
std::string gzip_of(const std::string& content, const std::string& name) {
    const auto little = [](std::uint32_t number, int bytes) {
        std::string text;
        for (; bytes > 0; --bytes, number >>= 8)
            text += static_cast<char>(number);
        return text;
    };
    const auto size = static_cast<std::uint32_t>(content.size());
    const auto sum =
        static_cast<std::uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(content.data()), size));
    return std::string("\x1f\x8b\x08\x08\0\0\0\0\0\x03", 10) + name + '\0' + '\1' +
           little(size, 2) + little(~size, 2) + content + little(sum, 4) + little(size, 4);
}

TEST(CompressedNifti, MayHaveALongGzipHeader) {
    TestFolder folder;
    const std::string plain = read_file(Nifti().write(folder));
    for (const std::size_t length : {std::size_t{0}, std::size_t{230}, std::size_t{10'000}}) {
        const auto series =
            open_series({folder.write("named.nii.gz", gzip_of(plain, std::string(length, 'n')))});
        EXPECT_EQ(values_of<std::int16_t>(*series, 0), landmark()) << length;
    }
}

TEST(Disagreement, OfNiftiScalingNamesBothFiles) {
    TestFolder folder;
    const auto a = folder.path() / "a.nii", b = folder.path() / "b.nii";
    std::filesystem::rename(Nifti().put(112, 2.0f).write(folder), a);
    std::filesystem::rename(Nifti().put(112, 3.0f).write(folder), b);
    EXPECT_THAT(error_of([&] {
                    open_series({a, b});
                }),
                testing::AllOf(HasSubstr("b.nii: scaling 3 x + 0, "), HasSubstr("a.nii has 2")));
    std::filesystem::copy_file(a, folder.path() / "c.nii");
    EXPECT_EQ(open_series({a, folder.path() / "c.nii"})->info().times, (std::vector<double>{0, 1}));
}

} // namespace
} // namespace isochron::index
