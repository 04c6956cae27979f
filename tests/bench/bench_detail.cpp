// `isochron-bench detail`: levels of detail of large volumes, beside all cells.
#include "app/command_line/cancel.h"
#include "app/command_line/progress_bar.h"
#include "stereo/context/gl_context.h"
#include "tests/bench/benchmarks.h"
#include "tests/bench/machine.h"
#include "tests/bench/measures/data_sets.h"
#include "tests/bench/measures/detail_minute.h"
#include "tests/bench/measures/detail_pictures.h"
#include "tests/bench/measures/isovalues.h"
#include "tests/bench/measures/work_folder.h"
#include "tests/bench/text_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>

namespace isochron::bench {
namespace {

namespace fs = std::filesystem;

struct DetailArguments {
    fs::path file, json, report, work = fs::temp_directory_path();
    double isovalue = 0;
    std::optional<double> dragged_to;
    int picture = 480, settled = 1024;
    double budget = 100, seconds = 60;
    bool no_minute = false, quick = false;
};

/// A measured figure, with what it should be at most.
struct Figure {
    std::string what, unit;
    double value = 0;
    double goal = 0, floor = 0;
};

std::string table_of(const std::vector<Figure>& figures) {
    std::string text = fmt::format("{:<72} {:>10} {:>8} {:>8}\n", "", "measured", "goal", "floor");
    for (const Figure& figure : figures)
        text += fmt::format("{:<72} {:>10} {:>8.3g} {:>8.3g}{}\n", figure.what,
                            fmt::format("{:.3g} {}", figure.value, figure.unit), figure.goal,
                            figure.floor,
                            figure.value <= figure.goal    ? ""
                            : figure.value <= figure.floor ? "  (floor)"
                                                           : "  (missed)");
    return text;
}

void write_figures(const fs::path& path, const std::vector<Figure>& figures) {
    const auto header = this_machine();
    nlohmann::json rows = nlohmann::json::array();
    for (const Figure& figure : figures)
        rows.push_back({{"what", figure.what},
                        {"value", figure.value},
                        {"unit", figure.unit},
                        {"goal", figure.goal},
                        {"floor", figure.floor}});
    write_text(
        path,
        nlohmann::json{{"commit", header.commit}, {"processor", header.processor}, {"rows", rows}}
                .dump(1) +
            "\n");
}

void say(const char* of, const MovingDetail& moving) {
    fmt::print("{}: {} cells, drawn {} of levels {} to {}; draw {:.1f} ms, extract {:.0f} ms; area "
               "extra {:.2f} %, missed {:.2f} %\n",
               of, moving.all_cells, moving.cells, moving.finest, moving.coarsest, moving.draw_ms,
               moving.extract_ms, moving.extra_percent, moving.missed_percent);
    std::fflush(stdout);
}

void say(const char* of, const MinuteFrames& frames) {
    fmt::print("{}: {} frames, {} redrawn, of which the median took {:.1f} ms and the worst {:.1f} "
               "ms; {} over two budgets, {} over three\n",
               of, frames.frames, frames.redrawn, frames.median_ms, frames.worst_ms,
               frames.over_two, frames.over_three);
}

void run_bench_detail(const DetailArguments& arguments) {
    const app::CancelOnSignal signals;
    const WorkFolder folder(arguments.work);
    const auto file = index::IndexFile::open(arguments.file);
    std::vector<Figure> figures;
    {
        const auto context =
            stereo::make_context(stereo::ContextKind::egl, {.size = {16, 16}, .vsync = false});
        const render::Gl gl(context->loader());
        DetailOptions options{.isovalue = arguments.isovalue,
                              .picture = arguments.picture,
                              .budget_ms = arguments.budget};
        const MovingDetail large = measure_moving_detail(gl, file, options);
        say("large", large);
        const auto small_file =
            arguments.quick ? file
                            : build_file(data_set("fourier256", index::ValueType::u8, 1),
                                         folder.path() / "small.isochron",
                                         [&](std::string_view, double) { signals.check(); });
        constexpr double kCells = 50'000;
        options.isovalue = isovalue_with(small_file->values(), kCells);
        const MovingDetail of_small = measure_moving_detail(gl, small_file, options);
        say("256^3", of_small);
        options.isovalue = arguments.isovalue;
        options.picture = arguments.settled;
        const double off = measure_settled_detail(gl, file, options);
        figures = {{"moving: frame time over that of 256^3 with 50 k cells", "x",
                    large.draw_ms / of_small.draw_ms, 1.5, 3},
                   {"moving: extra area", "%", large.extra_percent, 20, 20},
                   {"moving: missed area", "%", large.missed_percent, 2, 2},
                   {"settled: pixels off by more than 8/255", "%", off, 0.1, 1}};
    }
    if (!arguments.no_minute) {
        app::ProgressBar bar;
        const Minute minute =
            measure_minute(file,
                           {.seconds = arguments.seconds,
                            .low = arguments.isovalue,
                            .high = arguments.dragged_to.value_or(1.1 * arguments.isovalue),
                            .picture = arguments.picture,
                            .budget_ms = arguments.budget,
                            .report = arguments.report},
                           [&](std::string_view phase, double fraction) {
                               signals.check();
                               bar.show(phase, fraction);
                           });
        say("scripted", minute.scripted);
        say("control", minute.control);
        for (const std::string& line : minute.late)
            fmt::print("  late at {}\n", line);
        const auto beyond = [&](std::size_t MinuteFrames::* over) {
            return std::max(0.0, minute.scripted.percent(minute.scripted.*over) -
                                     minute.control.percent(minute.control.*over));
        };
        figures.push_back(
            {fmt::format("scripted: frames over two budgets ({}), beyond the control's ({})",
                         minute.scripted.over_two, minute.control.over_two),
             "%", beyond(&MinuteFrames::over_two), 0.1, 1});
        figures.push_back(
            {fmt::format("scripted: frames over three budgets ({}), beyond the control's ({})",
                         minute.scripted.over_three, minute.control.over_three),
             "%", beyond(&MinuteFrames::over_three), 0, 0.1});
    }
    fmt::print("\n{}", table_of(figures));
    if (!arguments.json.empty())
        write_figures(arguments.json, figures);
}

} // namespace

void add_detail(app::Command& program) {
    auto arguments = std::make_shared<DetailArguments>();
    app::Command command = program.subcommand(
        "detail",
        "Measure levels of detail of a large volume: moving pictures beside all cells and "
        "beside 256^3, settled ones, and frames of a scripted session.");
    command.option("file", arguments->file, "Index to draw")
        .existing_file()
        .type_name("NAME.isochron")
        .required();
    command.option("--isovalue", arguments->isovalue, "Isovalue to draw").required();
    command.option("--dragged-to", arguments->dragged_to,
                   "Where the scripted session drags it (default: 1.1 times as much)");
    command.option("--picture", arguments->picture, "Pixels of moving pictures, for each eye")
        .between(16, 4096)
        .shows_default();
    command.option("--settled", arguments->settled, "Pixels of the settled picture, for each eye")
        .between(16, 4096)
        .shows_default();
    command.option("--budget", arguments->budget, "Budget of a frame, milliseconds")
        .between(1.0, 1000.0)
        .shows_default();
    command.option("--seconds", arguments->seconds, "Length of the scripted session")
        .between(0.5, 3600.0)
        .shows_default();
    command.flag("--quick", arguments->quick, "Only look that it works: beside itself");
    command.flag("--no-minute", arguments->no_minute, "Do without the scripted session");
    command.option("--json", arguments->json, "Write the figures, with commit and processor")
        .type_name("FILE");
    command.option("--report", arguments->report, "Write the log of the scripted session's frames")
        .type_name("FILE");
    command.option("--work", arguments->work, "Folder for the small series")
        .existing_folder()
        .type_name("DIR")
        .shows_default();
    command.footer("A large series: isochron generate fourier --size 1024 --steps 3 --type u8 -o "
                   "FOLDER. The script repeats every\n20 seconds: rest, a drag of the isovalue, "
                   "jumps between steps, a walk into the volume and back. After each, 10 seconds\n"
                   "follow in which only the head sways: the control.");
    command.on_run([arguments] { run_bench_detail(*arguments); });
}

} // namespace isochron::bench
