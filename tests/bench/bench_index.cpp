// `isochron-bench index`: measures the search structures against their rivals.
#include "app/command_line/cancel.h"
#include "app/command_line/progress_bar.h"
#include "tests/bench/benchmarks.h"
#include "tests/bench/machine.h"
#include "tests/bench/measures/data_sets.h"
#include "tests/bench/measures/isovalues.h"
#include "tests/bench/measures/measure.h"
#include "tests/bench/measures/work_folder.h"
#include "tests/bench/rows/rows.h"
#include "tests/bench/text_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <memory>

namespace isochron::bench {
namespace {

namespace fs = std::filesystem;

struct BenchArguments {
    fs::path file, json, work = fs::temp_directory_path();
    std::vector<std::string> data = data_names();
    std::vector<std::string> types{"u8", "f32"};
    std::optional<std::size_t> steps;
    std::optional<double> isovalue;
    MeasureOptions measure;
    bool quick = false;
};

void append(Results& all, const Results& more) {
    all.rows.insert(all.rows.end(), more.rows.begin(), more.rows.end());
    all.details.insert(all.details.end(), more.details.begin(), more.details.end());
}

Results measure_data(const BenchArguments& arguments, const DataSet& data,
                     const index::Progress& progress) {
    const WorkFolder folder(arguments.work);
    const auto file = build_file(data, folder.path() / "series.isochron", progress);
    MeasureOptions options = arguments.measure;
    options.data = data.name;
    options.isovalue = arguments.isovalue ? *arguments.isovalue
                       : data.isovalue    ? *data.isovalue
                                          : isovalue_with(file->values(), data.active_cells);
    return measure(file, options, progress);
}

Results measure_file(const BenchArguments& arguments, const index::Progress& progress) {
    const auto file = index::IndexFile::open(arguments.file);
    const index::StepValues& values = file->values();
    constexpr double kShare = 0.005;
    MeasureOptions options = arguments.measure;
    options.data = arguments.file.stem().string();
    options.isovalue =
        arguments.isovalue
            ? *arguments.isovalue
            : isovalue_with(values, kShare * static_cast<double>(values.grid.cell_count()));
    return measure(file, options, progress);
}

void run_bench_index(BenchArguments arguments) {
    if (arguments.quick) {
        arguments.data = {"sphere-25"};
        arguments.types = {"u8"};
        arguments.steps = 5;
        arguments.measure.rounds = 1;
        arguments.measure.error_isovalues = 8;
        arguments.measure.structures.lattices = {64};
        arguments.measure.structures.max_variations = {2};
    }
    Results results{this_machine(), {}, {}};
    const app::CancelOnSignal signals;
    // Print each result at once: the whole run takes long and may be interrupted.
    const auto add = [&](const auto& measure_one) {
        app::ProgressBar bar;
        const Results more = measure_one([&](std::string_view phase, double fraction) {
            signals.check();
            bar.show(phase, fraction);
        });
        if (results.rows.empty())
            fmt::print("commit {}, {}, {} threads, {}, {}\n", results.header.commit,
                       results.header.processor, results.header.threads, results.header.compiler,
                       results.header.date);
        fmt::print("{}", table_of(more));
        std::fflush(stdout);
        append(results, more);
        if (!arguments.json.empty())
            write_text(arguments.json, to_json_text(results));
    };
    if (!arguments.file.empty())
        add([&](const index::Progress& progress) { return measure_file(arguments, progress); });
    else
        for (const std::string& name : arguments.data)
            for (const std::string& type : arguments.types)
                add([&](const index::Progress& progress) {
                    return measure_data(
                        arguments,
                        data_set(name, *index::value_type_from_name(type), arguments.steps),
                        progress);
                });
}

} // namespace

void add_index(app::Command& program) {
    auto arguments = std::make_shared<BenchArguments>();
    app::Command command = program.subcommand(
        "index", "Measure size, errors and speed of every search structure, on one thread, beside "
                 "a scan, a T-BON, VTK's flying edges and memcpy.");
    StructureOptions& structures = arguments->measure.structures;
    command.option("file NAME.isochron", arguments->file,
                   "Measure this index instead of the series that the benchmark makes");
    command.option("--json FILE", arguments->json, "Write the rows, with commit and processor");
    command.option("--data", arguments->data, "Series to make and measure (default: all)")
        .one_of(data_names())
        .comma_separated();
    command.option("--types", arguments->types, "Stored types of the series")
        .one_of({"u8", "f32"})
        .comma_separated()
        .shows_default();
    command
        .option("--steps", arguments->steps,
                "Steps of the series (default: 25 and 55 sphere, 64 vorticity, 16 fourier-128, "
                "10 fourier-256)")
        .between(1, 100000);
    command.option("--isovalue", arguments->isovalue,
                   "Isovalue of the times (default: 112.5 on the sphere, 3,940 active cells "
                   "on vorticity, else 0.5 % of all cells)");
    command
        .option("--lattice", structures.lattices,
                "SpanSpaceSize L of the THI trees and their variants, which are built for up "
                "to 150 million cell-steps")
        .between(1u, 4096u)
        .comma_separated()
        .shows_default();
    command
        .option("--max-variation", structures.max_variations,
                "MaxVariation of the THI trees and their variants")
        .between(1u, 64u)
        .comma_separated()
        .shows_default();
    command
        .option("--isovalues", arguments->measure.error_isovalues,
                "Count errors at so many quantiles of the values, at every step")
        .between(0, 1000)
        .shows_default();
    command
        .option("--repeat", arguments->measure.rounds,
                "Rounds of every measurement to take the median of")
        .between(1u, 1000u)
        .shows_default();
    command
        .option("--threads", structures.threads,
                "Threads to build with; 0: as many as there are processors")
        .between(0u, 1024u)
        .shows_default();
    command.option("--work DIR", arguments->work, "Folder for the series' files, a few GB")
        .existing_folder()
        .shows_default();
    command.flag("--quick", arguments->quick,
                 "Only look that it works: five steps of the sphere, one round");
    command.footer("Times are processor time of one thread: medians over the steps, each structure "
                   "in turn with what it is\ncompared with. The full table takes less than half an "
                   "hour on one core.\nIt is printed and written series by series: what is written "
                   "stays when the rest is interrupted.");
    command.on_run([arguments] { run_bench_index(*arguments); });
}

} // namespace isochron::bench
