// `isochron-bench change`: the next step, or the next isovalue, from a set that is at hand beside the
// same set made anew.
#include "app/command_line/cancel.h"
#include "app/command_line/progress_bar.h"
#include "index/extraction/extraction.h"
#include "index/indexing/index_build.h"
#include "render/cells/cell_buffers.h"
#include "stereo/context/gl_context.h"
#include "tests/bench/benchmarks.h"
#include "tests/bench/machine.h"
#include "tests/bench/measures/changing_series.h"
#include "tests/bench/measures/stopwatch.h"
#include "tests/bench/measures/timing.h"
#include "tests/bench/measures/work_folder.h"
#include "tests/bench/text_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cstdlib>
#include <limits>
#include <memory>

namespace isochron::bench {
namespace {

namespace fs = std::filesystem;

struct ChangeArguments {
    fs::path json, work = fs::temp_directory_path();
    unsigned size = 256, cells = 90'000, repeats = 3;
    std::string only; ///< a part of the names of what is measured
};

/// What is asked after what, and the floor of its ratio.
struct ChangeCase {
    std::string what;
    index::SurfacesQuery before, after;
    double floor = 0;
};

/// What the sets are for: cells for a GPU, cells with planes, and the same with a mesh.
struct ChangeUse {
    const char* name;
    index::Shading shading;
    std::uint64_t mesh_room;
    index::CellColoring coloring = index::CellColoring::none;
};
constexpr std::array kUses{
    ChangeUse{"cells and volume", index::Shading::none, 0},
    ChangeUse{"with planes", index::Shading::cells, 0},
    ChangeUse{"with planes and mesh", index::Shading::cells, std::uint64_t{1} << 32},
    ChangeUse{"colored, with planes", index::Shading::cells, 0, index::CellColoring::value},
    ChangeUse{"colored, with mesh", index::Shading::cells, std::uint64_t{1} << 32,
              index::CellColoring::value}};

/// Processor time of all threads, milliseconds.
struct ChangeRow {
    std::string what, use;
    bool again = false; ///< both sets have been looked at before
    std::size_t cells = 0;
    double kept_ms = 0;  ///< from the set at hand
    double sent_ms = 0;  ///< part of it: sending the set to the GPU
    double anew_ms = 0;  ///< made anew, right after the other set
    double alone_ms = 0; ///< made anew, where nothing of the step before has been decoded
    double over_anew = 0, over_alone = 0, floor = 0;
};

enum class How { kept, anew, alone };

constexpr int kDragged = 20; ///< times that an isovalue is moved to and fro before it is measured

/// Sends a set to the GPU, but does not show it: for that, a GPU computes normals of cells without
/// planes, which software GL does for longer than all else takes.
void send_to_gpu(const render::Gl& gl, render::CellBuffers& cells,
                 const index::ExtractionPtr& set) {
    while (!cells.stage(set, std::numeric_limits<std::size_t>::max()))
        ;
    gl.Finish();
}

/// Milliseconds of all threads.
struct ChangeTime {
    double all = 0, sending = 0;
};

/// From a file that is opened anew, whose bytes are in memory.
ChangeTime time_change(const render::Gl& gl, const fs::path& path, const ChangeUse& use,
                       const ChangeCase& of, How how, bool again, std::size_t& cells) {
    const auto file = index::IndexFile::open(path);
    // A method that is asked for takes nothing over.
    const index::Extract extract = index::extract_from(
        file, how == How::kept ? std::nullopt : std::optional(index::SearchMethod::bricks),
        use.shading);
    index::SurfacesQuery before = of.before, after = of.after;
    before.mesh_room = after.mesh_room = use.mesh_room;
    before.coloring = after.coloring = use.coloring;
    // A step that is looked at again, or often with other isovalues, may be decoded as a whole; that
    // is not measured.
    const int looks = of.before.instant == of.after.instant ? kDragged : 2;
    for (int i = 0; again && i < looks; ++i)
        for (const index::SurfacesQuery& query : {before, after})
            extract(query, {});
    const index::ExtractionPtr shown =
        again || how != How::alone
            ? extract(before, {})
            : index::extract_from(index::IndexFile::open(path), {}, use.shading)(before, {});
    render::CellBuffers buffers(gl, file->info().grid);
    while (buffers.shown() != shown)
        buffers.upload(shown, std::numeric_limits<std::size_t>::max());
    gl.Finish();
    const Stopwatch watch(Stopwatch::Of::all_threads);
    const index::ExtractionPtr set = extract(after, {});
    const double extracted = watch.seconds();
    send_to_gpu(gl, buffers, set);
    const double seconds = watch.seconds();
    cells = set->cells();
    return {1e3 * seconds, 1e3 * (seconds - extracted)};
}

ChangeRow measure(const render::Gl& gl, const fs::path& path, const ChangeUse& use,
                  const std::vector<ChangeCase>& alike, bool again) {
    ChangeRow row{
        .what = alike.front().what, .use = use.name, .again = again, .floor = alike.front().floor};
    constexpr std::array kTurns{How::kept, How::anew, How::alone};
    std::array<std::vector<double>, kTurns.size()> times;
    std::vector<double> sending;
    for (const ChangeCase& of : alike)
        for (std::size_t first = 0; first < kTurns.size(); ++first) // each comes first once
            for (std::size_t i = 0; i < kTurns.size(); ++i) {
                const std::size_t turn = (first + i) % kTurns.size();
                const ChangeTime time =
                    time_change(gl, path, use, of, kTurns[turn], again, row.cells);
                times[turn].push_back(time.all);
                if (kTurns[turn] == How::kept)
                    sending.push_back(time.sending);
            }
    row.kept_ms = median(times[0]);
    row.sent_ms = median(sending);
    row.anew_ms = median(times[1]);
    row.alone_ms = median(times[2]);
    row.over_anew = row.kept_ms / row.anew_ms;
    row.over_alone = row.kept_ms / row.alone_ms;
    return row;
}

std::string table_line(const ChangeRow& row) {
    return fmt::format("{:<28} {:<20} {:<6} {:>8} {:>8.2f} {:>8.2f} {:>8.2f} {:>8.2f} {:>6.2f} "
                       "{:>6.2f} {:>6.2f}{}\n",
                       row.what, row.use, row.again ? "again" : "first", row.cells, row.kept_ms,
                       row.sent_ms, row.anew_ms, row.alone_ms, row.over_anew, row.over_alone,
                       row.floor,
                       row.over_anew <= row.floor    ? ""
                       : row.over_alone <= row.floor ? "  over alone"
                                                     : "  missed");
}

void write_rows(const fs::path& path, const std::vector<ChangeRow>& rows, const std::string& load) {
    const Header header = this_machine();
    nlohmann::json list = nlohmann::json::array();
    for (const ChangeRow& row : rows)
        list.push_back({{"what", row.what},
                        {"use", row.use},
                        {"again", row.again},
                        {"cells", row.cells},
                        {"kept_ms", row.kept_ms},
                        {"sent_ms", row.sent_ms},
                        {"anew_ms", row.anew_ms},
                        {"alone_ms", row.alone_ms},
                        {"over_anew", row.over_anew},
                        {"over_alone", row.over_alone},
                        {"floor", row.floor}});
    write_text(path, nlohmann::json{{"commit", header.commit},
                                    {"processor", header.processor},
                                    {"load", load},
                                    {"until", "is on the GPU"},
                                    {"rows", list}}
                             .dump(1) +
                         "\n");
}

/// Load of the last minute: other work on the machine.
std::string load_now() {
    double load = 0;
    return getloadavg(&load, 1) == 1 ? fmt::format("{:.1f}", load) : "unknown";
}

void run_bench_change(const ChangeArguments& arguments) {
    const app::CancelOnSignal signals;
    const WorkFolder folder(arguments.work);
    const auto context =
        stereo::make_context(stereo::ContextKind::egl, {.size = {16, 16}, .vsync = false});
    const render::Gl gl(context->loader());
    const struct { double stay, floor; } shares[]{{0, 1.05}, {0.5, 0.7}, {0.9, 0.35}, {0.99, 0.35}};
    std::vector<double> stay;
    for (const auto& share : shares)
        for (unsigned i = 0; i < arguments.repeats; ++i)
            stay.push_back(share.stay);
    std::vector<ChangeRow> rows;
    fmt::print("{:<28} {:<20} {:<6} {:>8} {:>8} {:>8} {:>8} {:>8} {:>6} {:>6} {:>6}\n", "", "",
               "look", "cells", "kept ms", "sent ms", "anew ms", "alone ms", "/anew", "/alone",
               "floor");
    const auto measure_cases = [&](const fs::path& path,
                                   const std::vector<std::vector<ChangeCase>>& cases) {
        for (const ChangeUse& use : kUses)
            for (const std::vector<ChangeCase>& alike : cases)
                for (const bool again : {false, true}) {
                    const bool wanted =
                        alike.front().what.find(arguments.only) != std::string::npos;
                    if (!wanted)
                        continue;
                    signals.check();
                    rows.push_back(measure(gl, path, use, alike, again));
                    fmt::print("{}", table_line(rows.back()));
                    std::fflush(stdout);
                }
    };
    for (const Changing changing : {Changing::together, Changing::scattered}) {
        ChangingSeries series(arguments.size, arguments.cells, stay, changing);
        ChangingSeries colors(arguments.size, arguments.cells, stay, changing);
        colors.call("color");
        const fs::path path = folder.path() / "change.isochron";
        app::ProgressBar bar;
        index::build_index(series, path,
                           {.tiers = index::TierSet().with(index::Tier::bricks), .color = &colors},
                           [&](std::string_view phase, double done) {
                               signals.check();
                               bar.show(phase, done);
                           });
        const char* const how = changing == Changing::together ? "in one place" : "scattered";
        std::vector<std::vector<ChangeCase>> cases;
        std::uint32_t step = 0;
        for (const auto& share : shares) {
            std::vector<ChangeCase>& alike = cases.emplace_back();
            for (unsigned i = 0; i < arguments.repeats; ++i, ++step)
                alike.push_back({fmt::format("{:.0f} % stay, {}", 100 * share.stay, how),
                                 {.instant = index::Instant(step), .isovalues = {0.0}},
                                 {.instant = index::Instant(step + 1), .isovalues = {0.0}},
                                 share.floor});
        }
        if (changing == Changing::together) {
            const auto file = index::IndexFile::open(path);
            const double moved = 0.005 * (file->stats().high - file->stats().low);
            std::vector<ChangeCase>& alike = cases.emplace_back();
            for (unsigned i = 0; i < arguments.repeats; ++i)
                alike.push_back({"isovalue moved by 0.5 %",
                                 {.instant = index::Instant(i), .isovalues = {0.0}},
                                 {.instant = index::Instant(i), .isovalues = {moved}},
                                 0.8});
        }
        measure_cases(path, cases);
    }
    const std::string load = load_now();
    fmt::print("load of the machine: {}\n", load);
    if (!arguments.json.empty())
        write_rows(arguments.json, rows, load);
}

} // namespace

void add_change(app::Command& program) {
    auto arguments = std::make_shared<ChangeArguments>();
    app::Command command = program.subcommand(
        "change", "Measure the next step, and a moved isovalue, from a set that is at hand beside "
                  "the same set made anew.");
    command.option("--size", arguments->size, "Vertices along each axis")
        .between(32, 1024)
        .shows_default();
    command.option("--cells", arguments->cells, "Cells of the surface, about")
        .between(100, 10'000'000)
        .shows_default();
    command.option("--repeats", arguments->repeats, "Steps that are measured of each kind")
        .between(1, 100)
        .shows_default();
    command.option("--only TEXT", arguments->only, "Measure only what has this in its name");
    command.option("--json FILE", arguments->json, "Write the rows, with commit and processor");
    command.option("--work DIR", arguments->work, "Folder for the series")
        .existing_folder()
        .shows_default();
    command.footer(
        "Ratios are of two times in turn. A set is timed from the question to the set that "
        "is on the GPU. `first`: nothing of\nthe step is decoded yet, its bytes are in "
        "memory; `again`: it has been looked at before, with both isovalues twenty times where "
        "these move.");
    command.on_run([arguments] { run_bench_change(*arguments); });
}

} // namespace isochron::bench
