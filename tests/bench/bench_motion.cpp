// `isochron-bench motion`: moving pictures beside the settled pictures of the same views.
#include "app/command_line/cancel.h"
#include "app/command_line/progress_bar.h"
#include "stereo/image_file.h"
#include "tests/bench/benchmarks.h"
#include "tests/bench/machine.h"
#include "tests/bench/motion/cases.h"
#include "tests/bench/motion/rows.h"
#include "tests/bench/text_file.h"

#include <fmt/format.h>

#include <cstdio>
#include <memory>

namespace isochron::bench {
namespace {

namespace fs = std::filesystem;

struct MotionArguments {
    fs::path json, sheet, kept = fs::temp_directory_path();
    std::vector<std::string> data = moved_names(), motions;
    std::vector<double> budgets;
    PlayOptions play;
    bool full = false;
};

constexpr int kSheetWidth = 400, kSmallWidth = 240; ///< widths of a picture

void run_bench_motion(const MotionArguments& arguments) {
    const app::CancelOnSignal signals;
    MotionResults results{this_machine(), {}};
    CaseOptions options{.data = arguments.data,
                        .motions = {},
                        .budgets = arguments.budgets,
                        .full = arguments.full};
    for (const std::string& name : arguments.motions)
        options.motions.push_back(motion_from_name(name));
    std::vector<render::Image> sheets; ///< one of all data
    app::ProgressBar bar;
    const auto check = [&] { signals.check(); };
    const index::Progress progress = [&](std::string_view phase, double fraction) {
        signals.check();
        bar.show(phase, fraction);
    };
    fmt::print("{}", motion_table_head());
    for (const MotionCase& of : cases_of(options)) {
        const auto motions = play_case(of, arguments.kept, arguments.play, check, progress);
        for (const ComparedMotion& each : motions) {
            fmt::print("{}", motion_table_line(each.row));
            results.rows.push_back(each.row);
        }
        std::fflush(stdout);
        if (!arguments.sheet.empty()) {
            stereo::write_image(sheet_of(motions, kSheetWidth),
                                arguments.sheet / fmt::format("motion_{}_{}x{}{}.png", of.data.name,
                                                              of.size.x, of.size.y,
                                                              of.window ? "_window" : ""));
            if (!motions.empty() && is_on_sheet(motions.front().row))
                sheets.push_back(sheet_of(motions, kSmallWidth));
            if (!sheets.empty())
                stereo::write_image(stacked(sheets), arguments.sheet / "motion.jpg");
        }
        if (!arguments.json.empty())
            write_text(arguments.json, to_json_text(results));
    }
}

} // namespace

void add_motion(app::Command& program) {
    auto arguments = std::make_shared<MotionArguments>();
    app::Command command = program.subcommand(
        "motion", "Play motions in real time, and measure how like the moving pictures are to the "
                  "settled pictures of the same views.");
    command.option("--data", arguments->data, "Data to show")
        .one_of(moved_names())
        .comma_separated();
    command.option("--motions", arguments->motions, "Motions (default: all that belong to a case)")
        .one_of({kMotionNames.begin(), kMotionNames.end()})
        .comma_separated();
    command
        .option("--budgets", arguments->budgets,
                "Budgets of a frame, milliseconds; 0: what a window has (default: all that belong "
                "to a case)")
        .comma_separated();
    command.flag("--full", arguments->full, "Measure 1024^3, too");
    command.option("--seconds", arguments->play.seconds, "Length of a motion")
        .between(0.1, 600.0)
        .shows_default();
    command.option("--json FILE", arguments->json, "Write the rows, with commit and processor");
    command
        .option("--out DIR", arguments->sheet,
                "Folder for sheets of pictures: of each motion the least alike, moving above "
                "settled; motion.jpg has all data at 1280 x 720")
        .existing_folder();
    command
        .option("--indices DIR", arguments->kept,
                "Folder in which the indices of the data are kept for the next time")
        .existing_folder()
        .shows_default();
    command.on_run([arguments] { run_bench_motion(*arguments); });
}

} // namespace isochron::bench
