// The index file: it is read as it was written, and damage is reported.
#include "index/error.h"
#include "index/file/sections/file_layout.h"
#include "index/file/sections/metadata.h"
#include "index/indexing/first_steps.h"
#include "index/indexing/index_build.h"
#include "index/search/tree_of_file.h"
#include "index/system/memory_limit.h"
#include "tests/support/memory_series.h"
#include "tests/support/reader_fixtures.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <random>

namespace isochron::index {
namespace {

using testing::HasSubstr;
using testing::Not;

void put(const std::filesystem::path& path, std::string_view bytes) {
    std::filesystem::remove(path); // some file systems flush when a file is overwritten: slow
    std::ofstream(path, std::ios::binary).write(bytes.data(), std::ssize(bytes));
}

/// The message with which opening fails; empty if it does not.
std::string open_error(const std::filesystem::path& path) {
    try {
        IndexFile::open(path);
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr(path.filename().string())) << "names the file";
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << "one line";
        return error.what();
    }
    return {};
}

FileHeader header_of(const std::string& bytes) {
    FileHeader header;
    std::memcpy(&header, bytes.data(), sizeof header);
    return header;
}

/// Puts a header with matching checksum over the old one, and matching sums of its sections.
void reseal(std::string& bytes, FileHeader header) {
    for (Section& section : header.sections)
        section.checksum =
            checksum_of(std::as_bytes(std::span(bytes)).subspan(section.offset, section.bytes));
    const auto sealed = header_bytes(header);
    std::memcpy(bytes.data(), sealed.data(), sealed.size());
}

class IndexFileTest : public testing::Test {
  protected:
    std::filesystem::path build(const StepValues& values, const BuildOptions& options = {}) {
        MemorySeries series(values);
        build_index(series, folder.path() / "a.isochron", options);
        return folder.path() / "a.isochron";
    }
    TestFolder folder;
};

TEST_F(IndexFileTest, KeepsAQuarterOfTheMemoryOrWhatIsAskedFor) {
    std::mt19937 random(test_seed());
    const TestField field({5, 3, 4}, 1, ValueType::u8, scaled(white_noise(random), 100, 10),
                          {1, 0});
    const auto path = build(field.view());
    EXPECT_EQ(IndexFile::open(path)->cache_bytes(), memory_limit() / 4);
    EXPECT_EQ(IndexFile::open(path, 1 << 20)->cache_bytes(), 1u << 20);
}

TEST_F(IndexFileTest, EveryTypeGoesInAndComesOutUnchanged) {
    std::mt19937 random(test_seed());
    for (const ValueType type : kAllTypes)
        for (const bool with_tree : {false, true}) {
            const TestField field({5, 3, 4}, 3, type, scaled(white_noise(random), 100, 10),
                                  {-0.5, 7.25});
            const StepValues in = field.view();
            const auto file = IndexFile::open(build(in, {.with_tree = with_tree}));
            const StepValues& out = file->values();
            EXPECT_EQ(out.type, type);
            EXPECT_EQ(out.scaling, in.scaling);
            ASSERT_EQ(out.steps, 3u);
            EXPECT_EQ(out.stride % 64, 0u);
            EXPECT_EQ(reinterpret_cast<std::uintptr_t>(out.first) % 4096, 0u);
            for (std::size_t t = 0; t < 3; ++t)
                EXPECT_EQ(0, std::memcmp(out.first + t * out.stride, in.first + t * in.stride,
                                         60 * size_of(type)));
            EXPECT_EQ(tree_of(*file) != nullptr, with_tree);
            EXPECT_EQ(file->stats().tree_bytes > 0, with_tree);
            EXPECT_EQ(file->plan().tiers.has(Tier::tree), with_tree);
            // 60 values at most: every type has its levels.
            EXPECT_TRUE(file->chunks().levels(0)->lossless());
            EXPECT_FALSE(file->load(0).bricks.empty());
            EXPECT_EQ(file->stats().file_bytes,
                      std::filesystem::file_size(folder.path() / "a.isochron"));
            EXPECT_NO_THROW(file->verify());

            const auto sorted = sorted_values(in);
            EXPECT_EQ(file->stats().low, sorted.front());
            EXPECT_EQ(file->stats().high, sorted.back());
            EXPECT_EQ(file->info().digits, telling_digits(sorted.front(), sorted.back()));
            std::vector<std::uint64_t> histogram(256);
            for (const double v : sorted)
                ++histogram[std::min<std::size_t>(
                    255,
                    std::size_t(256 * ((v - sorted.front()) / (sorted.back() - sorted.front()))))];
            // Rounding may put a value on a bin's edge into either bin.
            std::int64_t difference = 0;
            for (std::size_t i = 0; i < 256; ++i) {
                difference += std::int64_t(file->stats().histogram[i]) - std::int64_t(histogram[i]);
                EXPECT_LE(std::abs(difference), 3) << "bin " << i;
            }
            EXPECT_EQ(difference, 0);
        }
}

TEST_F(IndexFileTest, TheDescriptionOfTheSeriesGoesInAndComesOutUnchanged) {
    const TestField field({3, 4, 5}, 3, ValueType::f32, moving_sphere);
    MemorySeries series(field.view());
    SeriesInfo& info = series.info();
    info.value_unit = "K \"quoted\" \\ \u00b5";
    info.length_unit = "mm";
    info.time_unit = "ms";
    info.anatomy = Anatomy::lps;
    info.grid.origin = {0.1, -1e300, 1e-300};
    info.grid.spacing = {1.0 / 3, 2, 5e-324};
    info.grid.direction = glm::dmat3(0, 1, 0, -1, 0, 0, 0, 0, -1);
    info.times = {-1.5, 0.1, 1e9};
    info.sources = {"a b.vti", "../c.vti", "d.vti"};
    info.notes = {"cell data averaged to vertices"};
    info.missing_after = {1};
    build_index(series, folder.path() / "a.isochron",
                {.with_tree = true, .tree = {.lattice = 16, .max_variation = 3}});
    const auto file = IndexFile::open(folder.path() / "a.isochron");
    const SeriesInfo& out = file->info();
    EXPECT_EQ(out.array, info.array);
    EXPECT_EQ(out.value_unit, info.value_unit);
    EXPECT_EQ(out.length_unit, info.length_unit);
    EXPECT_EQ(out.time_unit, info.time_unit);
    EXPECT_EQ(out.anatomy, info.anatomy);
    EXPECT_EQ(out.grid, info.grid);
    EXPECT_EQ(file->values().grid, info.grid);
    EXPECT_EQ(out.times, info.times);
    EXPECT_EQ(out.sources, info.sources);
    EXPECT_EQ(out.notes, info.notes);
    EXPECT_EQ(out.missing_after, info.missing_after);
    EXPECT_EQ(file->tree_options(), (ThiOptions{.lattice = 16, .max_variation = 3}));
    EXPECT_EQ(tree_of(*file)->options(), file->tree_options());
}

TEST_F(IndexFileTest, GapsAreInTheMetadataOfThoseSeriesAloneThatHaveSome) {
    const TestField field({3, 4, 5}, 4, ValueType::f32, moving_sphere);
    const auto built = [&](std::vector<std::uint32_t> missing, std::size_t steps) {
        MemorySeries series(field.view());
        series.info().missing_after = std::move(missing);
        FirstSteps first(series, steps);
        build_index(steps < 4 ? static_cast<VolumeSeries&>(first) : series,
                    folder.path() / "a.isochron", {});
        return read_file(folder.path() / "a.isochron");
    };
    const auto gaps = [&] {
        return IndexFile::open(folder.path() / "a.isochron")->info().missing_after;
    };
    EXPECT_THAT(built({}, 4), Not(HasSubstr("missing_after")));
    EXPECT_TRUE(gaps().empty());
    const std::string with = built({0, 2}, 4);
    EXPECT_EQ(built({0, 2}, 4), with);
    EXPECT_EQ(gaps(), (std::vector<std::uint32_t>{0, 2}));
    built({0, 2}, 3); // the step behind the second one has not come yet
    EXPECT_EQ(gaps(), std::vector<std::uint32_t>{0});
    for (const std::vector<std::uint32_t>& wrong :
         {std::vector<std::uint32_t>{3}, {2, 1}, {1, 1}, {0, 9}})
        EXPECT_THROW(built(wrong, 4), Error) << wrong.back();
}

TEST_F(IndexFileTest, ValuesThatAreNotFiniteAreCountedAndKeptOutOfTheRange) {
    TestField field({4, 4, 4}, 2, ValueType::f32, moving_sphere);
    const float inf = std::numeric_limits<float>::infinity();
    field.at<float>(0, 1) = field.at<float>(1, 7) = std::numeric_limits<float>::quiet_NaN();
    field.at<float>(0, 2) = inf;
    field.at<float>(0, 3) = -inf;
    const auto file = IndexFile::open(build(field.view()));
    EXPECT_EQ(file->stats().nan_values, 2u);
    EXPECT_TRUE(std::isfinite(file->stats().low) && std::isfinite(file->stats().high));
    std::uint64_t counted = 0;
    for (const std::uint64_t n : file->stats().histogram)
        counted += n;
    EXPECT_EQ(counted, 2 * 64 - 4u);

    TestField nothing({2, 2, 2}, 1, ValueType::f64,
                      [](double, double, double, double) { return std::nan(""); });
    const auto empty = IndexFile::open(build(nothing.view()));
    EXPECT_EQ(empty->stats().nan_values, 8u);
    EXPECT_EQ(empty->stats().low, 0);
    EXPECT_EQ(empty->stats().high, 0);
}

TEST_F(IndexFileTest, TheContentHashDependsOnValuesAndGridAlone) {
    TestField field({4, 4, 4}, 2, ValueType::u8, moving_sphere);
    const auto hash = [&](const BuildOptions& options, double spacing) {
        MemorySeries series(field.view());
        series.info().grid.spacing.x = spacing;
        build_index(series, folder.path() / "a.isochron", options);
        return IndexFile::open(folder.path() / "a.isochron")->content_hash();
    };
    const std::uint64_t first = hash({}, 1);
    EXPECT_EQ(hash({.with_tree = true, .tree = {.lattice = 8}}, 1), first);
    EXPECT_EQ(hash({.tiers = TierSet{}}, 1), first);
    EXPECT_NE(hash({}, 2), first);
    field.at<std::uint8_t>(1, 63) ^= 1;
    EXPECT_NE(hash({}, 1), first);
}

TEST_F(IndexFileTest, OtherFilesAreRefusedInOneLine) {
    EXPECT_THAT(open_error(folder.path() / "missing"), HasSubstr("no such file"));
    EXPECT_THAT(open_error(folder.path()), HasSubstr("a folder, expected a file"));
    put(folder.path() / "empty", "");
    EXPECT_THAT(open_error(folder.path() / "empty"), HasSubstr("not an isochron index"));
    put(folder.path() / "text", "# vtk DataFile Version 3.0\n");
    EXPECT_THAT(open_error(folder.path() / "text"), HasSubstr("not an isochron index"));
    put(folder.path() / "zeros", std::string(100'000, '\0'));
    EXPECT_THAT(open_error(folder.path() / "zeros"), HasSubstr("not an isochron index"));
}

TEST_F(IndexFileTest, EveryKindOfHeaderDamageHasItsOwnLine) {
    const TestField field({5, 6, 7}, 2, ValueType::f32, moving_sphere);
    const std::string good = read_file(build(field.view()));
    const auto message_of = [&](const std::string& bytes) {
        put(folder.path() / "b.isochron", bytes);
        return open_error(folder.path() / "b.isochron");
    };
    EXPECT_EQ(message_of(good), "");
    EXPECT_THAT(message_of(good.substr(0, 100)), HasSubstr("truncated"));
    EXPECT_THAT(message_of(good.substr(0, good.size() - 1)), HasSubstr("truncated"));
    EXPECT_EQ(message_of(good + "x"), "") << "what an append that was killed left";

    FileHeader newer = header_of(good);
    newer.version = kFileVersion + 1;
    std::string bytes = good;
    reseal(bytes, newer);
    EXPECT_THAT(message_of(bytes), HasSubstr("file version 6, this program reads versions 3 to 5"));
    FileHeader older = header_of(good);
    older.version = 2;
    bytes = good;
    reseal(bytes, older);
    EXPECT_THAT(message_of(bytes), HasSubstr("file version 2, this program reads versions 3 "
                                             "to 5; isochron build"));

    FileHeader foreign = header_of(good);
    foreign.byte_order = 0x04030201;
    bytes = good;
    reseal(bytes, foreign);
    EXPECT_THAT(message_of(bytes), HasSubstr("byte order"));

    for (const auto& [offset, size] : {std::pair<std::uint64_t, std::uint64_t>{8192, ~0ull - 4095},
                                       {~0ull - 4095, 4096},
                                       {1ull << 40, 1},
                                       {8193, 1},
                                       {4096, 1},
                                       {0, 1}}) {
        FileHeader outside = header_of(good);
        outside.section(SectionKind::steps).offset = offset;
        outside.section(SectionKind::steps).bytes = size;
        bytes = good;
        const auto sealed = header_bytes(outside);
        std::memcpy(bytes.data(), sealed.data(), sealed.size());
        EXPECT_THAT(message_of(bytes), HasSubstr("outside the file")) << offset;
    }
}

TEST_F(IndexFileTest, EveryFlippedBitOfTheHeaderIsNoticed) {
    const TestField field({3, 3, 3}, 1, ValueType::u8, moving_sphere);
    const std::string good = read_file(build(field.view()));
    for (std::size_t bit = 0; bit < kHeaderBytes * 8; bit += bit < 1200 ? 1 : 61) {
        std::string bytes = good;
        bytes[bit / 8] = char(bytes[bit / 8] ^ 1 << bit % 8);
        put(folder.path() / "b.isochron", bytes);
        EXPECT_NE(open_error(folder.path() / "b.isochron"), "") << "bit " << bit;
    }
}

TEST_F(IndexFileTest, EveryFlippedBitOfASectionIsFoundByVerify) {
    const std::uint32_t seed = test_seed();
    std::mt19937 random(seed);
    // With something in every section but the directory.
    const TestField field({15, 16, 17}, 2, ValueType::u8, moving_sphere);
    const std::string good = read_file(build(field.view(), {.with_tree = true}));
    const auto file = IndexFile::open(folder.path() / "a.isochron");
    std::vector<std::pair<std::string, Section>> parts;
    for (std::size_t s = 0; s < kSectionNames.size(); ++s)
        if (file->header().sections[s].bytes > 0)
            parts.emplace_back(kSectionNames[s], file->header().sections[s]);
    for (const StepEntry& step : file->step_entries())
        parts.push_back({"volume", {step.offset, step.bytes}});
    for (const auto& [name, part] : parts)
        for (int i = 0; i < 50; ++i) {
            const std::size_t at = part.offset + random() % part.bytes;
            std::string bytes = good;
            bytes[at] = char(bytes[at] ^ 1 << random() % 8);
            put(folder.path() / "b.isochron", bytes);
            try {
                IndexFile::open(folder.path() / "b.isochron")->verify();
                ADD_FAILURE() << name << " byte " << at;
            } catch (const Error& error) {
                EXPECT_THAT(error.what(), HasSubstr(name));
            }
        }
    // Between the parts there are zeros.
    std::vector<char> used(good.size());
    std::fill_n(used.begin(), kDataBegin, 1);
    for (const auto& [name, part] : parts)
        std::fill_n(used.begin() + std::ptrdiff_t(part.offset), part.bytes, 1);
    int gaps = 0;
    for (std::size_t at = 0; at < good.size(); ++at)
        if (!used[at]) {
            std::string bytes = good;
            bytes[at] = 1;
            put(folder.path() / "b.isochron", bytes);
            EXPECT_THROW(IndexFile::open(folder.path() / "b.isochron")->verify(), Error) << at;
            at += 1 + random() % 40;
            ++gaps;
        }
    EXPECT_GT(gaps, 5);
}

/// Damage that no checksum tells: the file must be refused or usable, whatever the text says.
TEST_F(IndexFileTest, DamagedMetadataWithMatchingChecksumsIsRefusedOrUsable) {
    const std::uint32_t seed = test_seed();
    std::mt19937 random(seed);
    const TestField field({5, 6, 7}, 2, ValueType::f32, moving_sphere);
    const std::string good = read_file(build(field.view()));
    const FileHeader header = header_of(good);
    const Section text = header.section(SectionKind::metadata);
    constexpr std::string_view kPieces[]{
        "-1",         "1e999", "null", "[",  "{", "\"", "99999999999999",
        "4294967296", "0",     "true", "[[", "}", ",",  "1.5"};
    int refused = 0;
    for (int i = 0; i < 1500; ++i) {
        std::string json = good.substr(text.offset, text.bytes);
        switch (random() % 4) {
        case 0: json.resize(random() % json.size()); break;
        case 1: json[random() % json.size()] ^= char(1 << random() % 8); break;
        default: {
            const std::string_view piece = kPieces[random() % std::size(kPieces)];
            json.replace(random() % json.size(), random() % 6, piece);
        }
        }
        FileHeader changed = header;
        changed.section(SectionKind::metadata).bytes = json.size();
        changed.file_bytes = text.offset + json.size();
        std::string bytes = good.substr(0, text.offset) + json;
        reseal(bytes, changed);
        put(folder.path() / "b.isochron", bytes);
        try {
            const auto file = IndexFile::open(folder.path() / "b.isochron");
            const StepValues& values = file->values();
            double sum = 0;
            for (std::size_t t = 0; t < values.steps; ++t)
                for (std::size_t v = 0; v < values.grid.vertex_count(); ++v)
                    sum += scaled_value(values, t, v);
            ASSERT_FALSE(std::isinf(sum) && sum == 0);
        } catch (const Error& error) {
            ++refused;
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        }
    }
    EXPECT_GT(refused, 500);
}

TEST_F(IndexFileTest, ADeeplyNestedTextIsRefused) {
    EXPECT_THROW(metadata_from_json(std::string(1'000'000, '[')), Error);
    EXPECT_THROW(metadata_from_json(""), Error);
    EXPECT_THROW(metadata_from_json("{}"), Error);
}

TEST_F(IndexFileTest, ADamagedTreeIsRefusedWhenItIsFirstUsed) {
    const TestField field({5, 6, 7}, 2, ValueType::f32, moving_sphere);
    std::string bytes = read_file(build(field.view(), {.with_tree = true}));
    const FileHeader header = header_of(bytes);
    const Section tree = header.section(SectionKind::tree);
    std::fill_n(bytes.begin() + std::ptrdiff_t(tree.offset), tree.bytes, '\xff');
    put(folder.path() / "b.isochron", bytes);
    const auto file = IndexFile::open(folder.path() / "b.isochron");
    EXPECT_THROW(tree_of(*file), Error);
    EXPECT_THROW(tree_of(*file), Error) << "and again";
}

} // namespace
} // namespace isochron::index
