// `isochron-bench building`: what an index of each type costs to build, beside `zstd -1`.
#include "app/command_line/cancel.h"
#include "app/command_line/progress_bar.h"
#include "app/generate/fourier_modes.h"
#include "index/indexing/index_build.h"
#include "tests/bench/benchmarks.h"
#include "tests/bench/machine.h"
#include "tests/bench/measures/stopwatch.h"
#include "tests/bench/measures/timing.h"
#include "tests/bench/measures/work_folder.h"
#include "tests/bench/text_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <zstd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <random>

namespace isochron::bench {
namespace {

namespace fs = std::filesystem;

struct BuildingArguments {
    fs::path json, work = fs::temp_directory_path();
    std::size_t size = 256;
    unsigned repeats = 5;
    std::string only; ///< a part of the names of what is measured
};

/// One step of some values in memory.
class OneStep final : public index::VolumeSeries {
  public:
    OneStep(std::size_t size, index::ValueType type, std::vector<std::byte> values)
        : values_(std::move(values)) {
        const auto n = static_cast<std::uint32_t>(size);
        info_.array = "values";
        info_.grid.vertices = {n, n, n};
        info_.type = type;
        info_.times = {0};
        info_.sources = {"in memory"};
    }
    const index::SeriesInfo& info() const override { return info_; }
    void read(std::size_t, std::span<std::byte> out) override {
        std::memcpy(out.data(), values_.data(), out.size());
    }
    void stream(std::size_t, const index::TakePiece& take) override { take(values_); }
    std::span<const std::byte> values() const { return values_; }

  private:
    std::vector<std::byte> values_;
    index::SeriesInfo info_;
};

template <class T, class F>
std::vector<std::byte> stored(std::span<const float> field, F&& value_of) {
    std::vector<std::byte> bytes(field.size() * sizeof(T));
    for (std::size_t i = 0; i < field.size(); ++i) {
        const T value = value_of(field[i]);
        std::memcpy(bytes.data() + i * sizeof value, &value, sizeof value);
    }
    return bytes;
}

struct BuildingRow {
    std::string what;
    double index_over_data = 0, zstd_over_data = 0;
    double build_seconds = 0, zstd_seconds = 0; ///< seconds of processor time
    double over_zstd() const { return build_seconds / zstd_seconds; }
};

BuildingRow measure(const std::string& what, OneStep& series, const fs::path& path,
                    unsigned repeats) {
    const auto data = series.values();
    std::vector<std::byte> out(ZSTD_compressBound(data.size()));
    std::size_t pressed = 0;
    std::vector<double> build, zstd;
    for (unsigned i = 0; i < repeats; ++i) {
        const Stopwatch watch(Stopwatch::Of::all_threads);
        pressed = ZSTD_compress(out.data(), out.size(), data.data(), data.size(), 1);
        zstd.push_back(watch.seconds());
        const Stopwatch own(Stopwatch::Of::all_threads);
        index::build_index(series, path, {.tiers = index::TierSet().with(index::Tier::bricks)}, {});
        build.push_back(own.seconds());
    }
    const auto bytes = static_cast<double>(data.size());
    return {what, static_cast<double>(fs::file_size(path)) / bytes,
            static_cast<double>(pressed) / bytes, median(build), median(zstd)};
}

void run_bench_building(const BuildingArguments& arguments) {
    const app::CancelOnSignal signals;
    const WorkFolder folder(arguments.work);
    const std::size_t n = arguments.size;
    std::vector<float> smooth(n * n * n), rough(smooth.size());
    app::FourierModes(12345, 64, 10).vorticity_magnitude(n, 0, smooth);
    app::FourierModes(12345, 64, static_cast<int>(n / 4)).vorticity_magnitude(n, 0, rough);
    const float highest = *std::ranges::max_element(smooth);
    std::mt19937 random(1);
    std::normal_distribution<double> noise(0, 8);
    std::vector<BuildingRow> rows;
    fmt::print("{:<24} {:>10} {:>10} {:>10} {:>10} {:>10}\n", "", "index/data", "zstd/data",
               "build ms", "zstd ms", "build/zstd");
    const auto row = [&](const char* what, index::ValueType type, auto&& values) {
        if (std::string_view(what).find(arguments.only) == std::string_view::npos)
            return;
        signals.check();
        OneStep series(n, type, values());
        rows.push_back(measure(what, series, folder.path() / "a.isochron", arguments.repeats));
        const BuildingRow& last = rows.back();
        fmt::print("{:<24} {:>10.3f} {:>10.3f} {:>10.1f} {:>10.1f} {:>10.2f}\n", last.what,
                   last.index_over_data, last.zstd_over_data, 1e3 * last.build_seconds,
                   1e3 * last.zstd_seconds, last.over_zstd());
        std::fflush(stdout);
    };
    using index::ValueType;
    row("u8, smooth", ValueType::u8, [&] {
        return stored<std::uint8_t>(
            smooth, [&](float v) { return static_cast<std::uint8_t>(255 * v / highest); });
    });
    row("i16, smooth and noise", ValueType::i16, [&] {
        return stored<std::int16_t>(smooth, [&](float v) {
            return static_cast<std::int16_t>(2000 * v / highest + noise(random));
        });
    });
    row("f32, smooth", ValueType::f32,
        [&] { return stored<float>(smooth, [](float v) { return v; }); });
    row("f32, rough", ValueType::f32,
        [&] { return stored<float>(rough, [](float v) { return v; }); });
    row("u16, noise of 12 bits", ValueType::u16, [&] {
        return stored<std::uint16_t>(
            smooth, [&](float) { return static_cast<std::uint16_t>(random() & 4095); });
    });
    row("u16, noise of 16 bits", ValueType::u16, [&] {
        return stored<std::uint16_t>(smooth,
                                     [&](float) { return static_cast<std::uint16_t>(random()); });
    });
    if (arguments.json.empty())
        return;
    const Header header = this_machine();
    nlohmann::json list = nlohmann::json::array();
    for (const BuildingRow& it : rows)
        list.push_back({{"what", it.what},
                        {"index_over_data", it.index_over_data},
                        {"zstd_over_data", it.zstd_over_data},
                        {"build_seconds", it.build_seconds},
                        {"zstd_seconds", it.zstd_seconds},
                        {"over_zstd", it.over_zstd()}});
    write_text(arguments.json, nlohmann::json{{"commit", header.commit},
                                              {"processor", header.processor},
                                              {"size", n},
                                              {"rows", list}}
                                       .dump(1) +
                                   "\n");
}

} // namespace

void add_building(app::Command& program) {
    auto arguments = std::make_shared<BuildingArguments>();
    app::Command command = program.subcommand(
        "building", "Measure what building an index costs for each type of values, beside zstd.");
    command.option("--size", arguments->size, "Vertices along each axis")
        .between(std::size_t{32}, std::size_t{1024})
        .shows_default();
    command.option("--repeats", arguments->repeats, "Times that each is measured")
        .between(1, 100)
        .shows_default();
    command.option("--only TEXT", arguments->only, "Measure only what has this in its name");
    command.option("--json FILE", arguments->json, "Write the rows, with commit and processor");
    command.option("--work DIR", arguments->work, "Folder for the index")
        .existing_folder()
        .shows_default();
    command.footer("One step in memory, with bricks. Times are processor times of all threads, "
                   "medians, in turn; zstd compresses the\nsame bytes in memory at level 1.");
    command.on_run([arguments] { run_bench_building(*arguments); });
}

} // namespace isochron::bench
