// `isochron bench`: measures the search structures against their rivals.
#include "app/bench/commands.h"
#include "app/bench/data_sets.h"
#include "app/bench/isovalues.h"
#include "app/bench/machine.h"
#include "app/bench/measure.h"
#include "app/bench/results_page.h"
#include "app/bench/work_folder.h"
#include "app/cancel.h"
#include "app/commands.h"
#include "app/progress_bar.h"
#include "index/error.h"
#include "index/new_file.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <fstream>
#include <iterator>
#include <memory>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;

struct BenchArguments {
    fs::path file, json, work = fs::temp_directory_path();
    std::vector<std::string> data = bench::data_names();
    std::vector<std::string> types{"u8", "f32"};
    std::optional<std::size_t> steps;
    std::optional<double> isovalue;
    bench::MeasureOptions measure;
    bool quick = false;
};

void append(bench::Results& all, const bench::Results& more) {
    all.rows.insert(all.rows.end(), more.rows.begin(), more.rows.end());
    all.details.insert(all.details.end(), more.details.begin(), more.details.end());
}

bench::Results measure_data(const BenchArguments& arguments, const bench::DataSet& data,
                            const index::Progress& progress) {
    const bench::WorkFolder folder(arguments.work);
    const auto file = bench::build_file(data, folder.path() / "series.isochron", progress);
    bench::MeasureOptions options = arguments.measure;
    options.data = data.name;
    options.isovalue = arguments.isovalue ? *arguments.isovalue
                       : data.isovalue    ? *data.isovalue
                                          : bench::isovalue_with(file->values(), data.active_cells);
    return bench::measure(file, options, progress);
}

bench::Results measure_file(const BenchArguments& arguments, const index::Progress& progress) {
    const auto file = index::IndexFile::open(arguments.file);
    const index::StepValues& values = file->values();
    constexpr double kShare = 0.005;
    bench::MeasureOptions options = arguments.measure;
    options.data = arguments.file.stem().string();
    options.isovalue =
        arguments.isovalue
            ? *arguments.isovalue
            : bench::isovalue_with(values, kShare * static_cast<double>(values.grid.cell_count()));
    return bench::measure(file, options, progress);
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
    bench::Results results{bench::this_machine(), {}, {}};
    const CancelOnSignal signals;
    // What is measured is told at once: an hour is long, and the rest may be interrupted.
    const auto add = [&](const auto& measure_one) {
        ProgressBar bar;
        const bench::Results more = measure_one([&](std::string_view phase, double fraction) {
            signals.check();
            bar.show(phase, fraction);
        });
        if (results.rows.empty())
            fmt::print("commit {}, {}, {} threads, {}, {}\n", results.header.commit,
                       results.header.processor, results.header.threads, results.header.compiler,
                       results.header.date);
        fmt::print("{}", bench::table_of(more));
        std::fflush(stdout);
        append(results, more);
        if (!arguments.json.empty())
            bench::write_text(arguments.json, bench::to_json_text(results));
    };
    if (!arguments.file.empty())
        add([&](const index::Progress& progress) { return measure_file(arguments, progress); });
    else
        for (const std::string& name : arguments.data)
            for (const std::string& type : arguments.types)
                add([&](const index::Progress& progress) {
                    return measure_data(
                        arguments,
                        bench::data_set(name, *index::value_type_from_name(type), arguments.steps),
                        progress);
                });
}

void add_bench_index(CLI::App& bench_command) {
    auto arguments = std::make_shared<BenchArguments>();
    CLI::App* command = bench_command.add_subcommand(
        "index", "Measure size, errors and speed of every search structure, on one thread, beside "
                 "a scan, a T-BON, VTK's flying edges and memcpy.");
    bench::StructureOptions& structures = arguments->measure.structures;
    command
        ->add_option("file", arguments->file,
                     "Measure this index instead of the series that the benchmark makes")
        ->type_name("NAME.isochron");
    command->add_option("--json", arguments->json, "Write the rows, with commit and processor")
        ->type_name("FILE");
    command->add_option("--data", arguments->data, "Series to make and measure (default: all)")
        ->check(CLI::IsMember(bench::data_names()))
        ->delimiter(',');
    command->add_option("--types", arguments->types, "Stored types of the series")
        ->check(CLI::IsMember({"u8", "f32"}))
        ->delimiter(',')
        ->capture_default_str();
    command
        ->add_option("--steps", arguments->steps,
                     "Steps of the series (default: 25 and 55 sphere, 64 vorticity and "
                     "fourier-128, 16 fourier-256)")
        ->check(CLI::Range(1, 100000));
    command->add_option("--isovalue", arguments->isovalue,
                        "Isovalue of the times (default: 112.5 on the sphere, 3,940 active cells "
                        "on vorticity, else 0.5 % of all cells)");
    command
        ->add_option("--lattice", structures.lattices,
                     "SpanSpaceSize L of the THI trees and their variants, which are built for up "
                     "to 150 million cell-steps")
        ->check(CLI::Range(1u, 4096u))
        ->delimiter(',')
        ->capture_default_str();
    command
        ->add_option("--max-variation", structures.max_variations,
                     "MaxVariation of the THI trees and their variants")
        ->check(CLI::Range(1u, 64u))
        ->delimiter(',')
        ->capture_default_str();
    command
        ->add_option("--isovalues", arguments->measure.error_isovalues,
                     "Count errors at so many quantiles of the values, at every step")
        ->check(CLI::Range(0, 1000))
        ->capture_default_str();
    command
        ->add_option("--repeat", arguments->measure.rounds,
                     "Rounds of every measurement to take the median of")
        ->check(CLI::Range(1u, 1000u))
        ->capture_default_str();
    command
        ->add_option("--threads", structures.threads,
                     "Threads to build with; 0: as many as there are processors")
        ->check(CLI::Range(0u, 1024u))
        ->capture_default_str();
    command->add_option("--work", arguments->work, "Folder for the series' files, a few GB")
        ->check(CLI::ExistingDirectory)
        ->type_name("DIR")
        ->capture_default_str();
    command->add_flag("--quick", arguments->quick,
                      "Only look that it works: five steps of the sphere, one round");
    command->footer(
        "Times are processor time of one thread: medians over the steps, each structure "
        "in turn with what it is\ncompared with. The full table takes hours. It is "
        "printed and written series by series: what is written\nstays when the rest is "
        "interrupted.");
    command->callback([arguments] { run_bench_index(*arguments); });
}

std::string read_text(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file)
        throw index::Error(fmt::format("{}: cannot be read", path.string()));
    return {std::istreambuf_iterator<char>(file), {}};
}

struct ResultFiles {
    fs::path index, render, artefacts, out;
};

void run_bench_results(const ResultFiles& files) {
    const std::string page = bench::whole_page({.index = files.index.string(),
                                                .render = files.render.string(),
                                                .artefacts = files.artefacts.string()},
                                               read_text);
    if (files.out.empty())
        fmt::print("{}", page);
    else
        bench::write_text(files.out, page);
}

void add_bench_results(CLI::App& bench_command) {
    auto files = std::make_shared<ResultFiles>();
    CLI::App* command = bench_command.add_subcommand(
        "results", "Render what the other benchmarks wrote as a page next to the paper's tables.");
    command->add_option("json", files->index, "Results of `bench index --json`")
        ->required()
        ->type_name("FILE.json");
    command->add_option("--render", files->render, "Results of `bench render --json`")
        ->type_name("FILE.json");
    command->add_option("--artefacts", files->artefacts, "Results of `bench artefacts --json`")
        ->type_name("FILE.json");
    command->add_option("-o,--out", files->out, "Markdown to write (default: print it)")
        ->type_name("FILE.md");
    command->callback([files] { run_bench_results(*files); });
}

} // namespace

void bench::write_text(const fs::path& path, const std::string& text) {
    index::NewFile file(path);
    file.write_at(0, std::as_bytes(std::span(text)));
    file.commit();
}

void add_bench(CLI::App& program) {
    CLI::App* command =
        program.add_subcommand("bench", "Measure the program's own parts against their rivals.");
    command->require_subcommand(1);
    add_bench_index(*command);
    bench::add_bench_render(*command);
    bench::add_bench_artefacts(*command);
    add_bench_results(*command);
}

} // namespace isochron::app
