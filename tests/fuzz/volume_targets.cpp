// Fuzz targets: files of volumes that the program decodes itself.
#include "tests/fuzz/memory_file.h"
#include "tests/fuzz/targets.h"

#include "index/error.h"
#include "index/readers/formats/own_formats.h"
#include "index/readers/formats/series/file_series.h"
#include "index/readers/process/reader_messages.h"
#include "index/volume/time_unit.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

namespace isochron::fuzz {
namespace {

/// Options that come with the input's length, so that a file alone is an input.
index::ReadOptions options_for(Bytes input) {
    index::ReadOptions options;
    options.allow_surplus = input.size() % 2 == 1;
    if (input.size() % 4 >= 2)
        options.component = "magnitude";
    return options;
}

/// Opens a file and reads its steps from the last to the first, and then the last one again.
void read_file(const std::string& path, index::OpenVolumeFile open,
               const index::ReadOptions& options) {
    constexpr std::size_t kMostBytes = 256 << 10, kMostSteps = 8;
    try {
        const auto series = index::open_file_series({{path, open, std::nullopt}}, options);
        const index::SeriesInfo& info = series->info();
        claim(info.steps() > 0, "a series has a step");
        if (info.step_bytes() > kMostBytes)
            return;
        std::vector<std::byte> last(info.step_bytes()), step(info.step_bytes());
        series->read(info.steps() - 1, last);
        for (std::size_t t = std::min(info.steps(), kMostSteps); t-- > 0;)
            series->read(t, step);
        series->read(info.steps() - 1, step);
        claim(step == last, "a step reads alike each time");
    } catch (const index::Error& error) {
        claim_one_line(error.what());
    }
}

void read_all(Bytes input, const index::OpenVolumeFile& open, const index::ReadOptions& options) {
    const MemoryFile file(input);
    read_file(file.path(), open, options);
}

/// The input is a header beside files of values: `a`, `b`, `c` of 4,096 bytes, and `v01` to `v04`.
void read_header(Bytes input, const char* name, const index::OpenVolumeFile& open) {
    static const ValueFiles kFiles;
    read_file(kFiles.with_header(name, input), open, options_for(input));
}

void fuzz_nrrd_parts(Bytes input) {
    read_header(input, "h.nhdr", index::open_nrrd);
}

void fuzz_metaimage_parts(Bytes input) {
    read_header(input, "h.mhd", index::open_metaimage);
}

void fuzz_bov(Bytes input) {
    read_header(input, "h.bov", index::open_bov);
}

void fuzz_nrrd(Bytes input) {
    read_all(input, index::open_nrrd, options_for(input));
}

void fuzz_metaimage(Bytes input) {
    read_all(input, index::open_metaimage, options_for(input));
}

void fuzz_nifti(Bytes input) {
    read_all(input, index::open_nifti, options_for(input));
}

void fuzz_mrc(Bytes input) {
    read_all(input, index::open_mrc, options_for(input));
}

void fuzz_mgh(Bytes input) {
    read_all(input, index::open_mgh, options_for(input));
}

void fuzz_cube(Bytes input) {
    read_all(input, index::open_gaussian_cube, options_for(input));
}

void fuzz_raw(Bytes input) {
    index::ReadOptions options = options_for(input);
    if (input.size() < 4)
        return;
    options.dims = {{input[0], input[1], input[2]}};
    options.type = static_cast<index::ValueType>(input[3] % 7);
    options.header_bytes = input[3] / 7;
    options.big_endian = input[0] % 2 == 1;
    read_all(input.subspan(4), index::open_raw, options);
}

void fuzz_time_unit(Bytes input) {
    const std::string text(input.begin(), input.end());
    const std::size_t line = text.find('\n');
    if (line == text.npos)
        return;
    const std::vector<double> times{0, 1, 2.5};
    const auto same = index::times_in(text.substr(0, line), text.substr(line + 1), times);
    claim(!same || same->size() == times.size(), "every time has one in another unit");
}

/// A message between the program and a reader: a byte that says which way it goes, then the
/// message.
void fuzz_reader(Bytes input) {
    if (input.empty())
        return;
    const std::span<const std::byte> bytes = std::as_bytes(input.subspan(1));
    const auto comes_back = [&](auto decode) {
        const auto sent = index::encoded(decode(bytes));
        claim(index::encoded(decode(sent)) == sent, "a message comes back as sent");
    };
    try {
        if (input[0] % 2 == 0)
            comes_back(index::request_from);
        else
            comes_back(index::reply_from);
    } catch (const index::Error& error) {
        claim_one_line(error.what());
    }
}

} // namespace

std::span<const Target> volume_targets() {
    static constexpr std::array kTargets{Target{"nrrd", fuzz_nrrd},
                                         Target{"metaimage", fuzz_metaimage},
                                         Target{"nifti", fuzz_nifti},
                                         Target{"mrc", fuzz_mrc},
                                         Target{"mgh", fuzz_mgh},
                                         Target{"cube", fuzz_cube},
                                         Target{"raw", fuzz_raw},
                                         Target{"time_unit", fuzz_time_unit},
                                         Target{"reader", fuzz_reader},
                                         Target{"nrrd_parts", fuzz_nrrd_parts},
                                         Target{"metaimage_parts", fuzz_metaimage_parts},
                                         Target{"bov", fuzz_bov}};
    return kTargets;
}

} // namespace isochron::fuzz
