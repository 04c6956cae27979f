// Series of raw files and .pvd files: order, times, and files that do not match.
#include "index/readers/formats/open_series.h"
#include "index/readers/formats/series/numbered_name.h"
#include "index/readers/formats/series/series_writer.h"
#include "tests/support/reader_fixtures.h"

#include <gmock/gmock.h>

#include <cstring>

namespace isochron::index {
namespace {

using testing::HasSubstr;

ReadOptions raw_u8(std::uint32_t nx, std::uint32_t ny, std::uint32_t nz) {
    ReadOptions options;
    options.dims = {{nx, ny, nz}};
    options.type = ValueType::u8;
    return options;
}

TEST(NaturalOrder, ComparesDigitsAsNumbers) {
    const std::vector<std::string> sorted{"a",   "a1b", "a2",   "a02x", "a10",
                                          "a10", "b",   "t9.5", "t10.5"};
    const auto less = [](const std::string& a, const std::string& b) {
        return natural_less(taken_apart(a), taken_apart(b));
    };
    for (std::size_t i = 0; i < sorted.size(); ++i)
        for (std::size_t j = 0; j < sorted.size(); ++j)
            if (sorted[i] != sorted[j]) {
                EXPECT_EQ(less(sorted[i], sorted[j]), i < j) << sorted[i] << " " << sorted[j];
            }
    EXPECT_NE(less("a01", "a1"), less("a1", "a01"));
}

TEST(RawSeries, PutsFilesInNaturalOrder) {
    TestFolder folder;
    const auto ten = folder.write("t10.raw", std::string(8, 'j'));
    const auto two = folder.write("t2.raw", std::string(8, 'b'));
    const auto series = open_series({ten, two}, raw_u8(2, 2, 2));
    EXPECT_EQ(series->info().sources, (std::vector<std::string>{"t2.raw", "t10.raw"}));
    EXPECT_EQ(series->info().times, (std::vector<double>{0, 1}));
    EXPECT_EQ(values_of<std::uint8_t>(*series, 1), std::vector<std::uint8_t>(8, 'j'));
}

TEST(RawSeries, OfOneStepAFileCanBeReadByManyAtOnce) {
    TestFolder folder;
    std::vector<std::filesystem::path> files;
    for (int i = 0; i < 4; ++i)
        files.push_back(folder.write("t" + std::to_string(i) + ".raw", std::string(8, "abcd"[i])));
    const auto series = open_series(files, raw_u8(2, 2, 2));
    const auto other = series->another();
    ASSERT_TRUE(other);
    EXPECT_EQ(other->info().sources, series->info().sources);
    for (const std::size_t step : {3, 0, 2, 1}) {
        EXPECT_EQ(values_of<std::uint8_t>(*other, step),
                  std::vector<std::uint8_t>(8, "abcd"[step]));
        EXPECT_EQ(values_of<std::uint8_t>(*series, 3 - step),
                  std::vector<std::uint8_t>(8, "dcba"[step]));
        EXPECT_EQ(other->state(step), series->state(step));
    }
    folder.write("t1.raw", std::string(9, 'x'));
    try {
        values_of<std::uint8_t>(*other, 1);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("t1.raw: changed while it was read"));
    }
    EXPECT_FALSE(
        open_series({folder.write("two.raw", std::string(16, 'a'))}, raw_u8(2, 2, 2))->another())
        << "two steps in one file";
}

TEST(RawSeries, ReadsSeveralBigEndianStepsAfterAHeader) {
    TestFolder folder;
    std::string bytes = "head";
    for (char i = 0; i < 16; ++i)
        bytes += {static_cast<char>(1), i};
    ReadOptions options = raw_u8(2, 2, 2);
    options.type = ValueType::i16;
    options.big_endian = true;
    options.header_bytes = 4;
    options.time_step = 0.5;
    options.spacing = glm::dvec3(1, 2, 3);
    const auto series = open_series({folder.write("v.bin", bytes)}, options);
    EXPECT_EQ(series->info().times, (std::vector<double>{0, 0.5}));
    EXPECT_EQ(series->info().grid.spacing, glm::dvec3(1, 2, 3));
    EXPECT_EQ(values_of<std::int16_t>(*series, 1), ramp<std::int16_t>(8, 256 + 8));
}

TEST(RawSeries, RefusesASizeThatIsNoMultiple) {
    TestFolder folder;
    const auto file = folder.write("v.raw", std::string(9, 'x'));
    EXPECT_THAT(error_of([&] { open_series({file}, raw_u8(2, 2, 2)); }),
                HasSubstr("v.raw: 9 bytes, expected a multiple of 8 = 2 x 2 x 2 values of u8"));
    EXPECT_THAT(error_of([&] { open_series({file}, raw_u8(9, 1, 1)); }),
                HasSubstr("needs at least 2 vertices per axis"));
    EXPECT_THAT(error_of([&] { open_series({file}, raw_u8(1'000'000'000, 1'000'000'000, 2)); }),
                HasSubstr("too many cells"));
    EXPECT_THAT(error_of([&] { open_series({file}, {}); }), HasSubstr("need --dims NX NY NZ"));
    EXPECT_THAT(error_of([&] { open_series({folder.write("e.raw", "")}, raw_u8(2, 2, 2)); }),
                HasSubstr("e.raw: 0 bytes"));
}

TEST(Series, RefusesWhatIsNoKnownFile) {
    TestFolder folder;
    EXPECT_THAT(error_of([&] { open_series({folder.path() / "gone.vti"}); }),
                HasSubstr("gone.vti: there is no such file"));
    EXPECT_THAT(error_of([&] { open_series({folder.path()}); }), HasSubstr("a folder"));
    EXPECT_THAT(error_of([&] { open_series({folder.write("v.xyz", "x")}); }),
                HasSubstr("v.xyz: unknown format, expected one of .pvd .series .vti"));
    EXPECT_THAT(error_of([&] { open_series({}); }), HasSubstr("no files"));
}

class WrittenSeries : public testing::Test {
  protected:
    std::filesystem::path write(const std::string& name, std::vector<double> times) {
        SeriesWriter writer(folder_.path(), name, info_);
        for (std::size_t step = 0; step < times.size(); ++step)
            writer.append(bytes_of(ramp<float>(info_.grid.vertex_count(), float(100 * step))),
                          times[step]);
        writer.finish();
        return folder_.path() / (name + ".pvd");
    }

    TestFolder folder_;
    SeriesInfo info_ = [] {
        SeriesInfo info;
        info.array = "speed & <co>";
        info.grid = {{41, 37, 5}, {1.5, -2, 1e-3}, {0.1, 1, 2}, {0, 1, 0, -1, 0, 0, 0, 0, 1}};
        return info;
    }();
};

TEST_F(WrittenSeries, ComesBackAsItWas) {
    const auto series = open_series({write("s", {0.25, 0.5, 7})});
    EXPECT_EQ(series->info().times, (std::vector<double>{0.25, 0.5, 7}));
    EXPECT_EQ(series->info().array, info_.array);
    EXPECT_EQ(series->info().type, ValueType::f32);
    EXPECT_EQ(series->info().grid, info_.grid);
    EXPECT_EQ(series->info().anatomy, Anatomy::none);
    for (std::size_t step : {0, 2, 1})
        EXPECT_EQ(values_of<float>(*series, step),
                  ramp<float>(info_.grid.vertex_count(), float(100 * step)));
}

TEST_F(WrittenSeries, ComesBackHoweverWellItCompresses) {
    info_.type = ValueType::u8;
    info_.grid.vertices = {100, 100, 100};
    const std::vector<std::uint8_t> values(info_.grid.vertex_count(), 7);
    SeriesWriter writer(folder_.path(), "flat", info_);
    writer.append(bytes_of(values), 0.0);
    writer.finish();
    const auto series = open_series({folder_.path() / "flat.pvd"});
    EXPECT_EQ(values_of<std::uint8_t>(*series, 0), values);
}

TEST_F(WrittenSeries, KeepsItsTimesWithoutTheCollection) {
    write("s", {0.25, 0.5});
    const auto series = open_series({folder_.path() / "s_0001.vti", folder_.path() / "s_0000.vti"});
    EXPECT_EQ(series->info().times, (std::vector<double>{0.25, 0.5}));
}

TEST_F(WrittenSeries, NamesBothFilesWhenTwoDisagree) {
    write("a", {0.0});
    const auto b_differs = [&](auto change) {
        const SeriesInfo before = info_;
        change(info_);
        write("b", {1.0});
        info_ = before;
        return error_of([&] {
            open_series({folder_.path() / "a_0000.vti", folder_.path() / "b_0000.vti"});
        });
    };
    EXPECT_THAT(b_differs([](SeriesInfo& info) {
                    info.grid.vertices = {37, 41, 5};
                }),
                testing::AllOf(HasSubstr("b_0000.vti: dimensions 37x41x5, "),
                               HasSubstr("a_0000.vti has 41x37x5")));
    EXPECT_THAT(b_differs([](SeriesInfo& info) { info.grid.spacing.x = 0.2; }),
                HasSubstr("spacing (0.2 1 2)"));
    EXPECT_THAT(b_differs([](SeriesInfo& info) { info.grid.origin.x = 0.2; }), HasSubstr("origin"));
    EXPECT_THAT(b_differs([](SeriesInfo& info) { info.grid.direction = glm::dmat3(1); }),
                HasSubstr("direction of axis 0"));
    EXPECT_THAT(b_differs([](SeriesInfo& info) { info.array = "other"; }),
                HasSubstr("array other"));
}

TEST_F(WrittenSeries, NamesBothFilesOfTheSameTime) {
    write("a", {1.0});
    write("b", {1.0});
    const std::vector<std::filesystem::path> files{folder_.path() / "a_0000.vti",
                                                   folder_.path() / "b_0000.vti"};
    EXPECT_THAT(
        error_of([&] { open_series(files); }),
        testing::AllOf(HasSubstr("b_0000.vti: time 1, "), HasSubstr("a_0000.vti has the same")));
    ReadOptions options;
    options.time_step = 2;
    EXPECT_EQ(open_series(files, options)->info().times, (std::vector<double>{0, 2}));
}

TEST(SeriesOfTypes, IsConvertedToOne) {
    TestFolder folder;
    const auto nrrd = [&](const std::string& name, const std::string& type,
                          const std::string& values) {
        return folder.write(
            name, "NRRD0004\ntype: " + type +
                      "\ndimension: 3\nsizes: 2 2 2\nendian: little\nencoding: raw\n\n" + values);
    };
    const std::vector<float> floats{0.5f, -1, 2, 3, 4, 5, 6, 7};
    const std::vector<std::int16_t> shorts{-32768, 32767, 2, 3, 4, 5, 6, 7};
    const std::vector<double> doubles{0.1, 1, 2, 3, 4, 5, 6, 7};
    const auto a = nrrd("a.nrrd", "float", text_of(floats)),
               b = nrrd("b.nrrd", "short", text_of(shorts)),
               c = nrrd("c.nrrd", "double", text_of(doubles));
    EXPECT_THAT(error_of([&] {
                    open_series({a, b});
                }),
                HasSubstr("b.nrrd: type i16, " + a.string() + " has f32; --type f32"));
    ReadOptions options;
    options.type = ValueType::f32;
    const auto exact = open_series({a, b}, options);
    EXPECT_EQ(values_of<float>(*exact, 0), floats);
    EXPECT_EQ(values_of<float>(*exact, 1), std::vector<float>(shorts.begin(), shorts.end()));
    EXPECT_TRUE(exact->info().notes.empty());
    const auto rounded = open_series({c, b}, options);
    EXPECT_EQ(values_of<float>(*rounded, 1).front(), 0.1f);
    EXPECT_THAT(rounded->info().notes, testing::ElementsAre("values of f64 are rounded to f32"));
    options.type = ValueType::i16;
    const auto integers = open_series({b, a}, options);
    EXPECT_EQ(values_of<std::int16_t>(*integers, 1), shorts);
    EXPECT_THAT(error_of([&] { values_of<std::int16_t>(*integers, 0); }),
                HasSubstr("a.nrrd: holds 0.5, which no integer of 16 bits is"));
    options.type = ValueType::u8;
    EXPECT_THAT(error_of([&] { values_of<std::uint8_t>(*open_series({b}, options), 0); }),
                HasSubstr("holds -32768"));
}

} // namespace
} // namespace isochron::index
