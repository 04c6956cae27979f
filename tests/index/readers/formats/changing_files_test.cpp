// Files that change while they are read: one error line, and no mix of values from two times.
#include "index/readers/formats/open_series.h"
#include "tests/index/readers/formats/packed.h"
#include "tests/support/reader_fixtures.h"

#include <gmock/gmock.h>

#include <chrono>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr std::size_t kVertices = 2 * 2 * 2;

std::string header(const std::string& encoding, std::size_t steps, const std::string& more = "") {
    return fmt::format("NRRD0004\ntype: float\ndimension: 4\nsizes: 2 2 2 {}\nspacings: 1 1 1 1\n"
                       "encoding: {}\n{}\n",
                       steps, encoding, more);
}

class ChangingFiles : public testing::Test {
  protected:
    static void read(VolumeSeries& series, std::size_t step) { values_of<float>(series, step); }
    /// As a write of another moment, however coarse the file system's clock is.
    static void touch(const fs::path& path) {
        fs::last_write_time(path, fs::last_write_time(path) + std::chrono::seconds(7));
    }
    TestFolder folder_;
};

TEST_F(ChangingFiles, AFileThatShrinksIsOneLine) {
    const auto whole = ramp<float>(40 * kVertices);
    for (const std::string encoding : {"ascii", "raw", "gzip"}) {
        const auto bytes = [&](std::size_t steps) {
            const std::vector<float> values(whole.begin(), whole.begin() + steps * kVertices);
            return header(encoding, steps) + (encoding == "ascii"  ? as_words(values)
                                              : encoding == "gzip" ? gzip(text_of(values))
                                                                   : text_of(values));
        };
        const auto path = folder_.write("a.nrrd", bytes(40));
        const auto other = folder_.write("b.nrrd", bytes(1));
        ReadOptions options;
        options.time_step = 1;
        // The second file is read in between, so that the first one is opened again.
        const auto series = open_series({path, other}, options);
        read(*series, 3);
        read(*series, 40);
        folder_.write("a.nrrd", bytes(1));
        EXPECT_THAT(error_of([&] { read(*series, 39); }),
                    HasSubstr("a.nrrd: changed while it was read: "))
            << encoding;
    }
}

TEST_F(ChangingFiles, AFileThatIsWrittenToIsOneLine) {
    const auto path = folder_.write("a.nrrd", header("raw", 2) + text_of(ramp<float>(16)));
    const auto series = open_series({path});
    read(*series, 0);
    folder_.write("a.nrrd", header("raw", 2) + text_of(ramp<float>(16, 5)));
    touch(path);
    EXPECT_THAT(error_of([&] { read(*series, 1); }),
                HasSubstr("a.nrrd: changed while it was read: it was written to"));
}

TEST_F(ChangingFiles, AFileThatIsReplacedIsOneLine) {
    const std::string bytes = header("raw", 2) + text_of(ramp<float>(16));
    const auto path = folder_.write("a.nrrd", bytes);
    const auto series = open_series({path});
    const auto time = fs::last_write_time(path);
    fs::rename(folder_.write("new", bytes), path);
    fs::last_write_time(path, time);
    EXPECT_THAT(error_of([&] { read(*series, 1); }),
                HasSubstr("a.nrrd: changed while it was read: another file has taken its place"));
    fs::remove(path);
    EXPECT_THAT(error_of([&] { read(*series, 1); }), HasSubstr("a.nrrd: there is no such file"));
}

TEST_F(ChangingFiles, ValuesBesideTheHeaderCountToo) {
    const auto values = folder_.write("a.raw", text_of(ramp<float>(16)));
    const auto path = folder_.write("a.nhdr", header("raw", 2, "data file: a.raw\n"));
    const auto series = open_series({path});
    read(*series, 0);
    touch(values);
    EXPECT_THAT(error_of([&] { read(*series, 1); }),
                HasSubstr("a.raw: changed while it was read: it was written to"));
}

} // namespace
} // namespace isochron::index
