// The writer of .pvd series: when files appear, and that they are always the same.
#include "index/readers/formats/series/series_writer.h"

#include "index/error.h"
#include "tests/support/reader_fixtures.h"

#include <gmock/gmock.h>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

SeriesInfo small_series() {
    SeriesInfo info;
    info.array = "speed <a&b>";
    info.grid = {{4, 3, 2}, {1.5, -2, 1e-3}, {0.5, 1, 2}, glm::dmat3(0, 1, 0, -1, 0, 0, 0, 0, 1)};
    info.type = ValueType::i16;
    return info;
}

TEST(SeriesWriter, GivesFilesTheirNamesOnlyWhenAllAreWritten) {
    TestFolder folder;
    {
        SeriesWriter writer(folder.path() / "new", "s", small_series());
        const auto values = ramp<std::int16_t>(24);
        writer.append(bytes_of(values), 0.0);
        writer.append(bytes_of(values), 0.25);
        EXPECT_FALSE(fs::exists(folder.path() / "new" / "s_0000.vti"));
        writer.finish();
    }
    EXPECT_EQ(names_in(folder.path() / "new"),
              (std::vector<std::string>{"s.pvd", "s_0000.vti", "s_0001.vti"}));
}

TEST(SeriesWriter, LeavesNothingWhenAbandoned) {
    TestFolder folder;
    {
        SeriesWriter writer(folder.path(), "s", small_series());
        writer.append(bytes_of(ramp<std::int16_t>(24)), 0.0);
        EXPECT_FALSE(names_in(folder.path()).empty());
    }
    EXPECT_TRUE(names_in(folder.path()).empty());
}

TEST(SeriesWriter, WritesTheSameBytesForTheSameValues) {
    TestFolder folder;
    for (const char* name : {"a", "b"}) {
        SeriesWriter writer(folder.path() / name, "s", small_series());
        writer.append(bytes_of(ramp<std::int16_t>(24)), 1.0);
        writer.finish();
    }
    for (const char* file : {"s_0000.vti", "s.pvd"})
        EXPECT_EQ(read_file(folder.path() / "a" / file), read_file(folder.path() / "b" / file));
}

TEST(SeriesWriter, RefusesWrongSizesTimesAndScaling) {
    TestFolder folder;
    SeriesWriter writer(folder.path(), "s", small_series());
    EXPECT_THAT(error_of([&] { writer.append(bytes_of(ramp<std::int16_t>(23)), 0.0); }),
                HasSubstr("step 0 has 46 bytes, expected 48"));
    writer.append(bytes_of(ramp<std::int16_t>(24)), 1.0);
    EXPECT_THAT(error_of([&] { writer.append(bytes_of(ramp<std::int16_t>(24)), 1.0); }),
                HasSubstr("step 1 is at time 1, expected a greater one"));
    SeriesInfo scaled = small_series();
    scaled.scaling.slope = 2;
    EXPECT_THAT(error_of([&] { SeriesWriter(folder.path(), "s", scaled); }),
                HasSubstr("carries no scaling"));
}

} // namespace
} // namespace isochron::index
