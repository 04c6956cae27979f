// What docs/FORMATS.md says of instants, sentence by sentence, each tried on a cell.
#include "index/file/step_view.h"
#include "index/indexing/index_build.h"
#include "index/readers/formats/series/missing_numbers.h"
#include "index/search/first_crossing.h"
#include "index/search/index_search.h"
#include "index/volume/blend.h"
#include "index/volume/step_gaps.h"
#include "tests/support/memory_series.h"
#include "tests/support/paths.h"
#include "tests/support/test_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace isochron::index {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// One cell: seven vertices that are 0 at all steps, and one with these values.
class OneCell {
  public:
    explicit OneCell(std::vector<double> values, ValueType type = ValueType::f64)
        : field_({2, 2, 2}, values.size(), type, [&](double x, double y, double z, double t) {
              return x + y + z == 3 ? values[static_cast<std::size_t>(t)] : 0.0;
          }) {
        MemorySeries series(field_.view());
        build_index(series, folder_.path() / "a.isochron", {});
        file_ = IndexFile::open(folder_.path() / "a.isochron");
    }
    const std::shared_ptr<const IndexFile>& file() const { return file_; }
    bool active(Instant at, double isovalue) const {
        return !search_in(file_)({at, isovalue}, {})->ids.empty();
    }

  private:
    test_support::TestFolder folder_;
    TestField field_;
    std::shared_ptr<const IndexFile> file_;
};

std::string page() {
    std::ifstream file(test_support::source_root() + "/docs/FORMATS.md");
    std::string text{std::istreambuf_iterator<char>(file), {}};
    std::ranges::replace(text, '\n', ' ');
    return text;
}

const std::vector<std::pair<const char*, std::function<void()>>> kSentences{
    {"An instant is a step k and a fraction n / N of the way to the next step, N = 65536",
     [] { EXPECT_EQ(Instant(1, 65535).number() + 1, Instant(2).number()); }},
    {"A vertex is above the isovalue v at an instant if and only if (N - n) s_k + n s_(k+1) >= N v "
     "in exact arithmetic.",
     [] {
         const OneCell cell({0, 1});
         EXPECT_TRUE(cell.active({0, 1}, 1.0 / 65536));
         EXPECT_FALSE(cell.active({0, 1}, std::nextafter(1.0 / 65536, 1.0)));
     }},
    {"A cell is active if and only if some of its vertices are above, some are not, and none is "
     "missing.",
     [] {
         EXPECT_TRUE(OneCell({0, 1}).active({0, 32768}, 0.25));
         EXPECT_FALSE(OneCell({0, 1}).active({0, 32768}, -0.25)) << "all are above";
         EXPECT_FALSE(OneCell({NAN, 1}).active({0, 32768}, 0.25));
     }},
    {"A vertex that is NaN or infinite at one of the two steps is missing between them.",
     [] {
         for (const double missing : {kInfinite, -kInfinite, double{NAN}}) {
             EXPECT_FALSE(OneCell({1, missing}).active({0, 1}, 0.5));
             EXPECT_FALSE(OneCell({missing, 1}).active({0, 65535}, 0.5));
         }
     }},
    {"At n = 0 the instant is the step itself, where infinities are values.",
     [] {
         EXPECT_TRUE(OneCell({kInfinite, 1}).active({0, 0}, 0.5));
     }},
    {"The last step holds.",
     [] {
         EXPECT_TRUE(OneCell({0, 1}).active({1, 40000}, 1.0));
     }},
    {"The first crossing of a cell is the first instant at which it is active, also where playing "
     "holds; where steps are held it is the first step.",
     [] {
         const OneCell cell({0, 1, 0});
         const auto first = [&](const CrossingsBetween& between) {
             return first_crossings(cell.file()->info(), search_in(cell.file()), 0.25, {}, between);
         };
         const auto blended = first(crossings_between(cell.file(), 0, 0.25, {}));
         EXPECT_EQ(blended->steps[0], 0);
         EXPECT_EQ(blended->fractions[0], 65536 / 4);
         EXPECT_EQ(first({})->steps[0], 1);
     }},
    {"Blended values are stored as the greatest f64 that is not above the exact blend",
     [] {
         EXPECT_LT(blended(1, std::nextafter(1.0, 2.0), 1), std::nextafter(1.0, 2.0));
         EXPECT_EQ(blended(1, std::nextafter(1.0, 2.0), 65535), 1.0);
     }},
    {"Integers of 8 and 16 bits without scaling become i32 in units of 1/65536, which hold the "
     "exact blend.",
     [] {
         EXPECT_EQ(Blend(ValueType::u8, {}, 5).type(), ValueType::i32);
         EXPECT_EQ(Blend(ValueType::i16, {}, 5).scaling().slope, 1.0 / 65536);
         EXPECT_EQ(Blend(ValueType::i16, {2.0, 0}, 5).type(), ValueType::f64);
     }},
    {"Where the isovalues are known, at most 8 that f32 can tell apart, blends of f32 without "
     "scaling stay f32: the nearest one, or, if that would cross an isovalue, the nearest one on "
     "the blend's own side.",
     [] {
         const std::array<double, 1> isovalue{std::nextafter(0.25, 1.0)};
         const Blend blend(ValueType::f32, {}, 32768, isovalue);
         ASSERT_EQ(blend.type(), ValueType::f32);
         const std::array<float, 3> a{0.25f, 0.0f, 0.25f},
             b{0.25f, 0.5f, std::nextafter(0.25f, 1.0f)};
         std::array<float, 3> out{};
         blend(std::as_bytes(std::span(a)), std::as_bytes(std::span(b)),
               reinterpret_cast<std::byte*>(out.data()));
         const float next = std::nextafter(0.25f, 1.0f);
         EXPECT_EQ(out, (std::array<float, 3>{0.25f, 0.25f, next})) << "the last is halfway to it";
         const std::array<double, 2> alike{0.25 + 1e-12, 0.25 + 2e-12};
         EXPECT_EQ(Blend(ValueType::f32, {}, 32768, alike).type(), ValueType::f64);
         const std::vector<double> many(9, 1.0);
         EXPECT_EQ(Blend(ValueType::f32, {}, 32768, many).type(), ValueType::f64);
     }},
    {"A gap is where the time to the next step is more than three times the median, or where "
     "metadata key `missing_after` says so",
     [] {
         SeriesInfo info;
         info.times = {0, 1, 2, 6, 7, 10};
         info.missing_after = {0};
         EXPECT_EQ(gaps_of(info), (std::vector<std::uint32_t>{0, 2}));
     }},
    {"There the next number or date is more than one and a half times as far away as the lower "
     "median.",
     [] {
         const auto missing = [](const std::vector<std::filesystem::path>& files) {
             return missing_after(files);
         };
         EXPECT_EQ(missing({"t2", "t4", "t7"}), std::vector<std::uint32_t>{});
         EXPECT_EQ(missing({"t2", "t4", "t8"}), std::vector<std::uint32_t>{1});
     }},
};

TEST(InstantsPage, EverySentenceIsThereAndTrue) {
    const std::string text = page();
    for (const auto& [sentence, is_true] : kSentences) {
        SCOPED_TRACE(sentence);
        EXPECT_NE(text.find(sentence), std::string::npos);
        is_true();
    }
}

/// Several isovalues at once, as surfaces are extracted: each has the cells that it has alone.
TEST(InstantsPage, SeveralIsovaluesHaveTheCellsThatEachHasAlone) {
    std::mt19937 random(test_seed());
    const TestField field({40, 30, 20}, 2, ValueType::f32, turbulence(random));
    MemorySeries series(field.view());
    const test_support::TestFolder folder;
    build_index(series, folder.path() / "a.isochron", {});
    const auto file = IndexFile::open(folder.path() / "a.isochron");
    const auto search = search_into(file, std::nullopt, Shading::none);
    for (const std::vector<double>& isovalues : {std::vector<double>{0.1, -0.2, 0.1, 1e300, -1e300},
                                                 std::vector<double>{0.1, std::nextafter(0.1, 1.0)},
                                                 std::vector<double>{0.0, 1e-50, kInfinite, NAN}}) {
        const StepView step = step_of_query(*file, {0, 12345}, isovalues);
        const StepView any = step_of_query(*file, {0, 12345});
        for (const double isovalue : isovalues) {
            CellSet some, expected;
            ASSERT_TRUE(search(step, isovalue, {}, some));
            ASSERT_TRUE(search(any, isovalue, {}, expected));
            EXPECT_EQ(some.ids, expected.ids) << isovalue;
        }
    }
}

} // namespace
} // namespace isochron::index
