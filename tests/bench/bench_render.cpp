// `isochron-bench render`: measures whole frames and their stages against VTK and bare quads.
#include "app/command_line/progress_bar.h"
#include "index/error.h"
#include "tests/bench/benchmarks.h"
#include "tests/bench/machine.h"
#include "tests/bench/measures/agreement.h"
#include "tests/bench/measures/child.h"
#include "tests/bench/measures/data_sets.h"
#include "tests/bench/measures/isovalues.h"
#include "tests/bench/measures/render_measure.h"
#include "tests/bench/measures/work_folder.h"
#include "tests/bench/rows/render_rows.h"
#include "tests/bench/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <memory>
#include <sched.h>
#include <stdlib.h>

namespace isochron::bench {
namespace {

namespace fs = std::filesystem;

struct RenderArguments {
    std::vector<fs::path> files;
    fs::path json, work = fs::temp_directory_path();
    std::vector<std::string> data{"sphere-55", "vorticity"};
    std::vector<std::string> footprints;
    std::vector<std::string> pictures{"512", "1024", "2x1024"};
    std::vector<unsigned> threads{1, 2};
    std::vector<std::string> contexts{"egl"};
    std::optional<std::size_t> steps;
    std::optional<double> isovalue;
    unsigned rounds = 3;
    std::optional<std::uint32_t> step;
    bool no_vtk = false, quick = false, agreement_only = false;
};

/// A series to draw, with its index on disk.
struct Subject {
    std::string name;
    fs::path file;
    double isovalue = 0;
};

/// Parses `1024` or `2x1024`; empty for anything else.
std::optional<Picture> picture_from_name(std::string_view name) {
    Picture picture;
    if (name.starts_with("2x")) {
        picture.eyes = 2;
        name.remove_prefix(2);
    }
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), picture.size);
    constexpr int kSmallest = 16, kLargest = 8192;
    if (error != std::errc() || end != name.data() + name.size() || picture.size < kSmallest ||
        picture.size > kLargest)
        return std::nullopt;
    return picture;
}

/// Limits this process to at most `count` processors, and Mesa's software GL to the same number of
/// threads. Mesa reads that number when its first context is made; 0: the calling thread draws.
void use_processors(unsigned count) {
    cpu_set_t allowed, used;
    if (sched_getaffinity(0, sizeof(allowed), &allowed) == 0) {
        CPU_ZERO(&used);
        for (int cpu = 0; cpu < CPU_SETSIZE && CPU_COUNT(&used) < static_cast<int>(count); ++cpu)
            if (CPU_ISSET(cpu, &allowed))
                CPU_SET(cpu, &used);
        sched_setaffinity(0, sizeof(used), &used);
    }
    setenv("LP_NUM_THREADS", count == 1 ? "0" : std::to_string(count).c_str(), 1);
}

RenderOptions options_of(const RenderArguments& arguments) {
    RenderOptions options;
    options.rounds = arguments.rounds;
    if (arguments.quick)
        options.motion_ms = 0;
    options.vtk = !arguments.no_vtk;
    options.pictures.clear();
    for (const std::string& picture : arguments.pictures)
        options.pictures.push_back(*picture_from_name(picture));
    if (!arguments.footprints.empty())
        std::erase_if(options.footprints, [&](const NamedFootprint& footprint) {
            return std::find(arguments.footprints.begin(), arguments.footprints.end(),
                             footprint.name) == arguments.footprints.end();
        });
    return options;
}

std::vector<Subject> make_subjects(const RenderArguments& arguments, const fs::path& folder,
                                   const index::Progress& progress) {
    std::vector<Subject> subjects;
    for (const fs::path& path : arguments.files) {
        constexpr double kShare = 0.005;
        const auto file = index::IndexFile::open(path);
        const double active = kShare * static_cast<double>(file->info().grid.cell_count());
        subjects.push_back(
            {path.stem().string(), path,
             arguments.isovalue ? *arguments.isovalue : isovalue_with(file->values(), active)});
    }
    if (!subjects.empty())
        return subjects;
    for (const std::string& name : arguments.data) {
        const DataSet data = data_set(name, index::ValueType::u8, arguments.steps);
        const fs::path path = folder / (name + ".isochron");
        const auto file = build_file(data, path, progress);
        subjects.push_back({data.name, path,
                            arguments.isovalue ? *arguments.isovalue
                            : data.isovalue    ? *data.isovalue
                                               : isovalue_with(file->values(), data.active_cells)});
    }
    return subjects;
}

/// Compares silhouettes and light of quads and splats with those of the exact surface.
void compare_with_exact(const RenderArguments& arguments, const std::vector<Subject>& subjects) {
    AgreementResults results{this_machine(), {}};
    for (const Subject& subject : subjects) {
        const auto file = index::IndexFile::open(subject.file);
        const auto last = static_cast<std::uint32_t>(file->info().steps() - 1);
        AgreementOptions options{.data = subject.name,
                                 .step = std::min(arguments.step.value_or(last / 3), last),
                                 .isovalues = {subject.isovalue}};
        if (arguments.quick)
            options.pixels_per_voxel = {2.0};
        else if (!arguments.isovalue)
            for (const double share : {0.025, 0.12}) // and where surfaces crowd
                options.isovalues.push_back(isovalue_with(
                    file->values(), share * static_cast<double>(file->info().grid.cell_count())));
        const auto rows = measure_agreement(file, options);
        fmt::print("\n{}", table_of(rows));
        std::fflush(stdout);
        results.rows.insert(results.rows.end(), rows.begin(), rows.end());
        if (!arguments.json.empty())
            write_text(arguments.json, to_json_text(results));
    }
}

void run_bench_render(RenderArguments arguments) {
    if (arguments.quick) {
        arguments.data = {"sphere-25"};
        arguments.steps = 3;
        arguments.rounds = 1;
        arguments.pictures = {"64", "2x48"};
    }
    const app::CancelOnSignal signals;
    const WorkFolder folder(arguments.work);
    const auto report = [&](app::ProgressBar& bar) {
        return [&](std::string_view phase, double fraction) {
            signals.check();
            bar.show(phase, fraction);
        };
    };
    std::vector<Subject> subjects;
    {
        app::ProgressBar bar;
        subjects = make_subjects(arguments, folder.path(), report(bar));
    }
    RenderResults results{this_machine(), {}};
    fmt::print("commit {}, {}, {} threads, {}, {}\n", results.header.commit,
               results.header.processor, results.header.threads, results.header.compiler,
               results.header.date);
    if (arguments.agreement_only) {
        compare_with_exact(arguments, subjects);
        return;
    }
    RenderOptions options = options_of(arguments);
    for (const Subject& subject : subjects)
        for (const std::string& context : arguments.contexts)
            for (const unsigned threads : arguments.threads) {
                options.data = subject.name;
                options.isovalue = subject.isovalue;
                options.context = *stereo::context_kind_from_name(context);
                options.threads = threads;
                const std::string text = in_child(
                    [&] {
                        use_processors(threads);
                        app::ProgressBar bar;
                        return to_json_text({{},
                                             measure_rendering(index::IndexFile::open(subject.file),
                                                               options, report(bar))});
                    },
                    signals);
                const auto rows = render_results_from_json(text, "a child process").rows;
                fmt::print("\n{}", table_of(rows));
                std::fflush(stdout);
                results.rows.insert(results.rows.end(), rows.begin(), rows.end());
                if (!arguments.json.empty())
                    write_text(arguments.json, to_json_text(results));
            }
}

} // namespace

void add_render(app::Command& program) {
    auto arguments = std::make_shared<RenderArguments>();
    std::vector<std::string> footprints;
    for (const NamedFootprint& footprint : all_footprints())
        footprints.emplace_back(footprint.name);
    app::Command command = program.subcommand(
        "render", "Measure whole frames, extraction and drawing, of every footprint, beside VTK's "
                  "flying edges and renderer and beside bare quads in the same GL.");
    command
        .option("files NAME.isochron", arguments->files,
                "Draw these indexes instead of the series that the benchmark makes")
        .existing_file();
    command.option("--json FILE", arguments->json, "Write the rows, with commit and processor");
    command.option("--data", arguments->data, "Series to make and draw, u8")
        .one_of(data_names())
        .comma_separated()
        .shows_default();
    command
        .option("--steps", arguments->steps,
                "Steps of the series (default: 55 sphere, 64 vorticity)")
        .between(1, 100000);
    command.option("--isovalue", arguments->isovalue,
                   "Isovalue (default: 112.5 on the sphere, 3,940 active cells on "
                   "vorticity, 0.5 % of all cells of a file)");
    command.option("--footprints", arguments->footprints, "How to draw (default: all)")
        .one_of(footprints)
        .comma_separated();
    command
        .option("--pictures", arguments->pictures,
                "Pixels of the picture, across and up; 2xN draws both eyes")
        .accepted_by(
            [](const std::string& name) {
                return picture_from_name(name)
                           ? std::string()
                           : name + ": expected 16 to 8192, or the same behind 2x";
            },
            "N|2xN")
        .comma_separated()
        .shows_default();
    command
        .option("--threads", arguments->threads,
                "Processors that may be used, each number in a process of its own")
        .between(1u, 1024u)
        .comma_separated()
        .shows_default();
    command
        .option("--context", arguments->contexts, "GL contexts; VTK cannot draw in that of osmesa")
        .one_of({"egl", "osmesa"})
        .comma_separated()
        .shows_default();
    command.option("--repeat", arguments->rounds, "Rounds through all steps")
        .between(1u, 1000u)
        .shows_default();
    command.flag("--no-vtk", arguments->no_vtk, "Do without VTK");
    command.option("--work DIR", arguments->work, "Folder for the series' files")
        .existing_folder()
        .shows_default();
    command.flag("--agreement-only", arguments->agreement_only,
                 "Instead of speeds: how far quads and splats agree with the exact surface");
    command.option("--step", arguments->step, "Step to compare (default: at a third of the series)")
        .between(0u, 100000u);
    command.flag("--quick", arguments->quick,
                 "Only look that it works: three steps of the sphere, small pictures");
    command.footer(
        "The camera's angle is 45 degrees and the volume's bounding sphere touches the picture. "
        "Every frame is waited\nfor. Times are wall-clock medians over the frames, each in turn "
        "with what it is compared with. Columns: fps of\nwhole frames; vtk: the same steps with "
        "VTK; bare: drawing alone of plain quads as large as the largest cells;\np99: 99th "
        "percentile of frame over static draw while time plays and the isovalue is dragged. `./run "
        "bench results --render FILE -o\nPAGE.md` compares what --json wrote with the goals.");
    command.on_run([arguments] { run_bench_render(*arguments); });
}

} // namespace isochron::bench
