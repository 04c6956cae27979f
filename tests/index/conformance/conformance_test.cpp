// Files that other libraries wrote, compared with their own readings: scripts in this folder make
// both.
#include "index/readers/formats/foreign_file.h"
#include "index/readers/formats/open_series.h"
#include "index/volume/time_unit.h"
#include "tests/support/paths.h"
#include "tests/support/reader_fixtures.h"
#include "tests/support/test_seed.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <map>
#include <random>
#include <set>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

ReadOptions options_in(const json& given) {
    ReadOptions options;
    if (given.contains("array"))
        options.array = given["array"];
    if (given.contains("component"))
        options.component = given["component"];
    if (given.contains("resample"))
        options.resample = given["resample"].get<std::array<std::uint32_t, 3>>();
    if (given.contains("dims"))
        options.dims = given["dims"].get<std::array<std::uint32_t, 3>>();
    if (given.contains("type"))
        options.type = value_type_from_name(given["type"].get<std::string>());
    if (given.contains("spacing_given"))
        options.spacing =
            glm::dvec3(double(given["spacing_given"][0]), double(given["spacing_given"][1]),
                       double(given["spacing_given"][2]));
    if (given.contains("origin_given"))
        options.origin =
            glm::dvec3(double(given["origin_given"][0]), double(given["origin_given"][1]),
                       double(given["origin_given"][2]));
    if (given.value("first_step", false))
        options.steps = {0, 0, 1};
    options.allow_surplus = given.value("allow_surplus", false);
    options.header_bytes = given.value("header_bytes", std::uint64_t{0});
    options.big_endian = given.value("big_endian", false);
    options.extra_axis_is_time = given.value("extra_axis_is_time", false);
    return options;
}

std::vector<double> doubles_in(const fs::path& file) {
    const std::string bytes = read_file(file);
    std::vector<double> values(bytes.size() / sizeof(double));
    std::memcpy(values.data(), bytes.data(), values.size() * sizeof(double));
    return values;
}

std::vector<double> scaled_values(VolumeSeries& series) {
    const SeriesInfo& info = series.info();
    std::vector<double> all;
    std::vector<std::byte> bytes(info.step_bytes());
    for (std::size_t step = 0; step < info.steps(); ++step) {
        series.read(step, bytes);
        visit_value_type(info.type, [&]<class T>(std::type_identity<T>) {
            const auto* values = reinterpret_cast<const T*>(bytes.data());
            for (std::size_t i = 0; i < info.grid.vertex_count(); ++i)
                all.push_back(info.scaling(static_cast<double>(values[i])));
        });
    }
    return all;
}

void expect_places(const SeriesInfo& info, const json& expected) {
    for (int axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<std::size_t>(axis);
        const double spacing = expected["spacing"][i], origin = expected["origin"][i];
        EXPECT_NEAR(info.grid.spacing[axis], spacing, 1e-5 * spacing);
        EXPECT_NEAR(info.grid.origin[axis], origin, 1e-5 * std::max(spacing, std::abs(origin)));
        const std::size_t given = expected["positions"].is_null() ? 0 : info.grid.vertices[i];
        for (std::size_t n = 0; n < given; ++n)
            EXPECT_NEAR(origin + info.grid.direction[axis][axis] *
                                     info.grid.distance(axis, static_cast<double>(n)),
                        double(expected["positions"][i][n]), 1e-5 * spacing);
        for (int row = 0; row < 3; ++row) {
            const double wanted = expected["direction"][i][static_cast<std::size_t>(row)];
            EXPECT_NEAR(info.grid.direction[axis][row], wanted, 1e-6);
        }
    }
}

/// Dates that the library gives, and what a note says.
void expect_said(const SeriesInfo& info, const json& options) {
    const json dates = options.value("dates", json());
    for (std::size_t i = 0; i < dates.size(); ++i) {
        // A text is as short as tells times apart.
        const std::string text = time_text(info.times, i, info.time_unit);
        const std::string got = text.substr(0, text.find(" (")), wanted = dates[i];
        EXPECT_EQ(got, wanted.substr(0, got.size())) << text;
        EXPECT_GE(got.size(), 10u) << text;
        for (std::size_t rest = got.size(); rest < wanted.size(); ++rest)
            EXPECT_THAT(wanted[rest], testing::AnyOf('0', ':', ' ')) << text << ", " << wanted;
    }
    if (options.contains("time_unit"))
        EXPECT_EQ(info.time_unit, options["time_unit"].get<std::string>());
    if (options.contains("note"))
        EXPECT_THAT(info.notes,
                    testing::Contains(testing::HasSubstr(options["note"].get<std::string>())));
}

void expect_values(const std::vector<double>& got, const std::vector<double>& wanted,
                   double slack) {
    ASSERT_EQ(got.size(), wanted.size());
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < got.size(); ++i) {
        const double off = slack * std::abs(wanted[i]) + slack / 10;
        const bool same =
            std::isnan(wanted[i])
                ? std::isnan(got[i])
                : got[i] == wanted[i] || std::abs(got[i] - wanted[i]) <= off; // infinities, too
        if (!same && ++wrong <= 3)
            ADD_FAILURE() << "value " << i << " is " << got[i] << ", expected " << wanted[i];
    }
    EXPECT_EQ(wrong, 0u);
}

/// Values that were computed: of f32 mostly, and, a bit more than VTK puts an image within a mesh,
/// of meshes.
double slack_of(const json& kind) {
    return kind == "rounded" ? 1e-6 : kind == "within" ? 1e-4 : 0;
}

/// What a library wrote into a folder, and what is to be found in it.
struct Written {
    explicit Written(const std::string& script) {
        const std::string command = fmt::format(
            "PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 {}/tests/index/conformance/{} {}",
            test_support::source_root(), script, folder.path().string());
        EXPECT_EQ(std::system(command.c_str()), 0);
        entries = json::parse(folder.read("manifest.json"));
    }
    TestFolder folder;
    json entries;
};

/// Each library writes once; its tests leave the files as they are.
class Conformance : public testing::TestWithParam<const char*> {
  protected:
    static const Written& written() {
        static std::map<std::string, Written> all;
        return all.try_emplace(GetParam(), GetParam()).first->second;
    }

    const json& entries_ = written().entries;
    const TestFolder& folder_ = written().folder;
};
class DamagedFiles : public Conformance {};
class DamagedFolders : public Conformance {};

TEST_P(Conformance, ValuesPlacesAndTimesAreTheLibrarys) {
    for (const json& entry : entries_) {
        std::vector<fs::path> files;
        for (const std::string name : entry["files"])
            files.push_back(folder_.path() / name);
        const ReadOptions options = options_in(entry["options"]);
        SCOPED_TRACE(fmt::format("{} {}", entry["files"].dump(), entry["options"].dump()));
        if (entry.contains("message")) {
            EXPECT_THAT(error_of([&] {
                            const auto series = open_series(files, options);
                            if (entry["options"].value("reads", false))
                                scaled_values(*series);
                        }),
                        testing::HasSubstr(std::string(entry["message"])));
            continue;
        }
        try {
            const auto series = open_series(files, options);
            const SeriesInfo& info = series->info();
            ASSERT_EQ(info.grid.vertices, (entry["vertices"].get<std::array<std::uint32_t, 3>>()));
            ASSERT_EQ(info.steps(), entry["steps"].get<std::size_t>());
            expect_places(info, entry);
            for (std::size_t i = 0; i < entry["times"].size(); ++i)
                EXPECT_NEAR(info.times[i], double(entry["times"][i]), 1e-9);
            if (!entry["unit"].is_null()) {
                EXPECT_EQ(info.time_unit, entry["unit"]);
            }
            if (!entry["note"].is_null()) {
                EXPECT_THAT(info.notes,
                            testing::Contains(testing::HasSubstr(std::string(entry["note"]))));
            }
            expect_said(info, entry["options"]);
            expect_values(scaled_values(*series), doubles_in(folder_.path() / entry["values"]),
                          slack_of(entry["kind"]));
        } catch (const Error& error) {
            ADD_FAILURE() << error.what();
        }
    }
}

/// As `open_series`, but with readers that are waited for no longer than a moment: HDF5 1.10 goes
/// round in circles for ever in some damaged files.
void read_impatiently(const fs::path& file, const ReadOptions& options) {
    static ReaderPool readers({.patience = std::chrono::milliseconds(1500)});
    static const std::map<std::string, std::string_view> formats{
        {".h5", "hdf5"},  {".hdf5", "hdf5"}, {".vtkhdf", "hdf5"},
        {".tif", "tiff"}, {".tiff", "tiff"}, {".btf", "tiff"}};
    const auto format = formats.find(file.extension());
    if (format == formats.end()) {
        // VTK's reader of EnSight goes on for very long in some damaged lists of times.
        const bool is_case = file.extension() == ".case";
        readers_of_this_process().set_patience(std::chrono::milliseconds(is_case ? 1500 : 60'000));
        scaled_values(*open_series({file}, options));
        return;
    }
    const auto volume = open_foreign(readers, format_named(format->second), file, options);
    std::vector<std::byte> bytes(volume->info().step_bytes());
    for (std::size_t step = 0; step < volume->steps(); ++step)
        volume->read(step, bytes);
}

/// Reads all of a file. @return whether it could be read; else it is one line that names the file
bool reads(const fs::path& file, const ReadOptions& options) {
    try {
        read_impatiently(file, options);
        return true;
    } catch (const Error& error) {
        const std::string line = error.what();
        // A damaged header may name another file, whose lack is what is wrong then.
        EXPECT_THAT(line, testing::AnyOf(testing::HasSubstr(file.filename().string()),
                                         testing::HasSubstr(file.parent_path().string())));
        EXPECT_EQ(line.find('\n'), std::string::npos) << line;
        return false;
    }
}

// Where a file of these formats is cut short, what is left may still be a whole file, or its values
// may all be there: no test can tell these apart, but none may crash or hang.
TEST_P(DamagedFiles, AreReadOrRefusedInOneLine) {
    std::set<std::string> seen;
    std::mt19937 random(test_seed());
    std::size_t refused = 0, cut = 0;
    for (const json& entry : entries_) {
        const std::string name = entry["files"].front();
        if (entry.contains("message") || entry["files"].size() > 1 ||
            !fs::is_regular_file(folder_.path() / name) ||
            fs::file_size(folder_.path() / name) == 0 || !seen.insert(name).second)
            continue;
        const std::string whole = read_file(folder_.path() / name);
        const std::string last = fs::path(name).filename().string();
        const ReadOptions options = options_in(entry["options"]);
        constexpr std::size_t kCuts = 6;
        for (std::size_t i = 0; i < kCuts; ++i, ++cut)
            refused += !reads(
                folder_.write("cut_" + last, whole.substr(0, whole.size() * i / kCuts)), options);
        for (int i = 0; i < std::max(2, tries(6)); ++i) {
            std::string changed = whole;
            for (int bit = 0; bit < 4; ++bit)
                changed[random() % std::min<std::size_t>(changed.size(), 4096)] ^=
                    static_cast<char>(1 << random() % 8);
            reads(folder_.write("flipped_" + last, changed), options);
        }
        for (const char* made : {"cut_", "flipped_"})
            fs::remove(folder_.path() / (made + last));
    }
    EXPECT_GT(cut, 0u);
    EXPECT_GE(refused * 10, cut * 9) << refused << " of " << cut << " cut files refused";
}

/// Formats that are folders: one file after the other is damaged where it is.
TEST_P(DamagedFolders, AreReadOrRefusedInOneLine) {
    std::set<std::string> seen;
    std::mt19937 random(test_seed());
    for (const json& entry : entries_) {
        const fs::path folder = folder_.path() / std::string(entry["files"].front());
        if (entry.contains("message") || entry["files"].size() > 1 || !fs::is_directory(folder) ||
            !seen.insert(folder).second)
            continue;
        std::vector<fs::path> files;
        for (const auto& file : fs::recursive_directory_iterator(folder))
            if (file.is_regular_file() && file.file_size() > 0)
                files.push_back(file.path());
        std::ranges::shuffle(files, random);
        files.resize(std::min(files.size(), static_cast<std::size_t>(std::max(4, tries(12)))));
        for (const fs::path& file : files) {
            const std::string whole = read_file(file);
            const std::string name = file.lexically_relative(folder_.path());
            SCOPED_TRACE(name);
            for (const std::size_t part : {0u, 1u, 2u}) {
                folder_.write(name, whole.substr(0, whole.size() * part / 3));
                reads(folder, options_in(entry["options"]));
            }
            std::string changed = whole;
            for (int bit = 0; bit < 4; ++bit)
                changed[random() % changed.size()] ^= static_cast<char>(1 << random() % 8);
            folder_.write(name, changed);
            reads(folder, options_in(entry["options"]));
            folder_.write(name, whole);
        }
        EXPECT_TRUE(reads(folder, options_in(entry["options"]))) << "whole again";
    }
    EXPECT_FALSE(seen.empty());
}

const auto kOfFiles = testing::Values(
    "with_bytes.py", "with_files.py", "with_foreign.py", "with_h5py.py", "with_meshes.py",
    "with_netcdf4.py", "with_nibabel.py", "with_numpy.py", "with_pydicom.py", "with_tifffile.py",
    "with_times.py", "with_vtk.py", "with_xdmf.py", "with_zarr.py");
const auto kOfFolders = testing::Values("with_meshes.py", "with_tifffile.py", "with_zarr.py");
std::string library_name(const testing::TestParamInfo<const char*>& script) {
    const std::string name = script.param;
    return name.substr(5, name.size() - 8);
}
INSTANTIATE_TEST_SUITE_P(Libraries, Conformance, kOfFiles, library_name);
INSTANTIATE_TEST_SUITE_P(Matrices, Conformance,
                         testing::Values("with_dicom_frames.py", "with_names.py", "with_times.py"),
                         library_name);
INSTANTIATE_TEST_SUITE_P(Libraries, DamagedFiles, kOfFiles, library_name);
INSTANTIATE_TEST_SUITE_P(Libraries, DamagedFolders, kOfFolders, library_name);

} // namespace
} // namespace isochron::index
