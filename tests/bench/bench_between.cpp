// `isochron-bench between`: the surface between two steps beside that of a step, and beside VTK's
// temporal interpolator.
#include "app/command_line/cancel.h"
#include "app/command_line/progress_bar.h"
#include "index/extraction/extraction.h"
#include "index/file/named_index.h"
#include "index/search/index_search.h"
#include "tests/bench/benchmarks.h"
#include "tests/bench/machine.h"
#include "tests/bench/measures/between_steps.h"
#include "tests/bench/measures/data_sets.h"
#include "tests/bench/measures/isovalues.h"
#include "tests/bench/measures/work_folder.h"
#include "tests/bench/motion/step_jumps.h"
#include "tests/bench/text_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace isochron::bench {
namespace {

namespace fs = std::filesystem;

struct BetweenArguments {
    fs::path json, work = fs::temp_directory_path();
    std::string data = "fourier-256", bytes = "fourier-128";
    unsigned repeats = 15;
    std::vector<std::string> played; ///< indices besides the demo's series and `data`
};

/// A figure, and the ones that it should reach.
struct BetweenRow {
    std::string what;
    double figure = 0, goal = 0, floor = 0;
    bool more = false; ///< whether more is better
    bool missed() const { return more ? figure < floor : figure > floor; }
};

void print(const BetweenRow& row) {
    fmt::print("{:<68} {:>9.4g} {:>8} {:>8}{}\n", row.what, row.figure,
               row.goal == row.floor && row.goal == 0 ? "" : fmt::format("{:g}", row.goal),
               row.goal == row.floor && row.goal == 0 ? "" : fmt::format("{:g}", row.floor),
               row.floor > 0 && row.missed() ? "  missed" : "");
    std::fflush(stdout);
}

/// Load of the last minute: other work on the machine.
double load_of_minute() {
    double load = NAN;
    return getloadavg(&load, 1) == 1 ? load : NAN;
}

void run_bench_between(const BetweenArguments& arguments) {
    const app::CancelOnSignal signals;
    const WorkFolder folder(arguments.work);
    std::vector<BetweenRow> rows;
    const auto add = [&](const BetweenRow& row) {
        rows.push_back(row);
        print(row);
    };
    const auto built = [&](const std::string& name, index::ValueType type, double& isovalue,
                           std::optional<std::size_t> steps) {
        const DataSet data = data_set(name, type, steps);
        app::ProgressBar bar;
        const auto file = build_file(data, folder.path() / (name + ".isochron"),
                                     [&](std::string_view phase, double done) {
                                         signals.check();
                                         bar.show(phase, done);
                                     });
        isovalue =
            data.isovalue ? *data.isovalue : isovalue_with(file->values(), data.active_cells);
        return file;
    };
    fmt::print("{:<68} {:>9} {:>8} {:>8}\n", "", "figure", "goal", "floor");
    double isovalue = 0;
    {
        const auto file = built(arguments.bytes, index::ValueType::u8, isovalue, 3);
        const Difference of = difference_from_vtk(file, isovalue);
        add({"u8: percent of the cells that differ from VTK's blend, mean", of.mean_percent});
        add({"u8: the same, most", of.most_percent});
        add({"values that are missing in VTK's blend at a step, of one that has none",
             static_cast<double>(of.spoiled_values)});
    }
    const auto file = built(arguments.data, index::ValueType::f32, isovalue, 3);
    const BetweenTimes times = time_between(file, isovalue, arguments.repeats);
    add({"cells", static_cast<double>(times.cells)});
    add({"moment between steps, ms of processor time", 1e3 * times.moment});
    add({"whole step, ms of processor time", 1e3 * times.step});
    add({"VTK's blend and flying edges with normals, ms", 1e3 * times.vtk});
    add({"VTK's processor time over that of a moment", times.vtk / times.moment});
    add({"VTK's elapsed time, on one thread, over that of a moment", times.vtk_elapsed, 20, 8,
         true});
    add({"a moment over a whole step", times.moment / times.step, 1.5, 2.5});
    add({"the same over a step that is worked on by chunks, as larger ones are",
         times.moment / times.step_by_chunks});
    add({"the same over a whole step, with the volume around the cells",
         times.drawn_moment / times.drawn_step});
    add({"cold: bytes read for a moment over those of a step", times.cold_bytes, 2.05, 2.3});
    const auto add_jumps = [&](const std::string& name,
                               const std::shared_ptr<const index::IndexFile>& played,
                               std::optional<double> at) {
        const StepJumps jumps = jumps_at_steps(played, at, [&] { signals.check(); });
        add({fmt::format("{}: change of pixels at a step over a frame's, of {} steps the worst",
                         name, jumps.steps),
             jumps.worst, 1.5, 2});
        add({fmt::format("{}: the same, median", name), jumps.median, 1.5, 2});
    };
    add_jumps(arguments.data, file, isovalue);
    {
        double own = 0;
        const auto demo = built("vorticity", index::ValueType::f32, own, std::nullopt);
        add_jumps("demo", demo, std::nullopt);
    }
    const auto add_building = [&](const std::string& name, const std::string& data,
                                  std::optional<std::size_t> steps) {
        constexpr unsigned kMost = 7;
        const auto series = made_series(data_set(data, index::ValueType::f32, steps),
                                        [&](std::string_view, double) { signals.check(); });
        add({fmt::format("{}: building, with what blends are worth measured over without", name),
             time_of_measuring(*series, folder.path() / "again.isochron",
                               std::min(arguments.repeats, kMost), [&] { signals.check(); }),
             1.05, 1.15});
    };
    add_building("demo", "vorticity", std::nullopt);
    add_building(arguments.data, arguments.data, 3);
    for (const std::string& path : arguments.played)
        add_jumps(fs::path(path).stem().string(), index::open_named_index(path), std::nullopt);
    const double load = load_of_minute();
    fmt::print("load of the machine: {:.1f}\n", load);
    if (arguments.json.empty())
        return;
    const Header header = this_machine();
    nlohmann::json list = nlohmann::json::array();
    for (const BetweenRow& row : rows)
        list.push_back(
            {{"what", row.what}, {"figure", row.figure}, {"goal", row.goal}, {"floor", row.floor}});
    write_text(arguments.json, nlohmann::json{{"commit", header.commit},
                                              {"processor", header.processor},
                                              {"load", load},
                                              {"data", arguments.data},
                                              {"rows", list}}
                                       .dump(1) +
                                   "\n");
}

} // namespace

void add_between(app::Command& program) {
    auto arguments = std::make_shared<BetweenArguments>();
    app::Command command = program.subcommand(
        "between", "Measure the surface between two steps beside that of a step, and beside VTK's "
                   "temporal interpolator.");
    command.option("--data", arguments->data, "Series whose times are measured")
        .one_of(data_names())
        .shows_default();
    command.option("--bytes", arguments->bytes, "Series of bytes whose cells are compared")
        .one_of(data_names())
        .shows_default();
    command.option("--played FILE.isochron", arguments->played,
                   "Index that is played, too, to see whether its picture jumps at steps");
    command.option("--repeats", arguments->repeats, "Moments that are measured")
        .between(1, 1000)
        .shows_default();
    command.option("--json FILE", arguments->json, "Write the figures, with commit and processor");
    command.option("--work DIR", arguments->work, "Folder for the series")
        .existing_folder()
        .shows_default();
    command.footer(
        "Times are processor times of all threads, medians, in turn: cells with their planes and "
        "normals, both steps decoded before;\nVTK blends all values on one thread and contours "
        "them with normals. Pictures are those of the series that play at a tenth of the speed.");
    command.on_run([arguments] { run_bench_between(*arguments); });
}

} // namespace isochron::bench
