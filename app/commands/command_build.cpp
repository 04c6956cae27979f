// `isochron build`: reads a series of volume files and writes its index.
#include "app/command_line/cancel.h"
#include "app/command_line/progress_bar.h"
#include "app/command_line/subcommands.h"
#include "app/end_in_time.h"
#include "app/indexing/asked_build.h"
#include "app/indexing/build_sources.h"
#include "app/indexing/file_patterns.h"
#include "app/indexing/index_report.h"
#include "app/indexing/series_report.h"
#include "app/output/guarded_outputs.h"
#include "app/safe_text.h"
#include "app/text.h"
#include "index/error.h"
#include "index/readers/formats/format.h"
#include "index/system/team.h"
#include "stereo/cluster.h"

#include <fmt/format.h>

#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;

SafeText summary(const fs::path& out, const index::IndexFile& file) {
    const index::SeriesInfo& info = file.info();
    const auto& n = info.grid.vertices;
    SafeText text("{}: {} x {} x {} vertices, {} step{}", out.string(), n[0], n[1], n[2],
                  info.steps(), info.steps() == 1 ? "" : "s");
    for (std::size_t number = 0; number < file.arrays(); ++number) {
        const index::IndexFile& array = file.array(number);
        const index::SeriesInfo& one = array.info();
        const index::IndexStats& stats = array.stats();
        text += file.arrays() == 1 ? SafeText(", ") : SafeText("\n{}: ", one.array);
        text += SafeText("{}, values {} to {}{}\n{}", index::name_of(one.type), stats.low,
                         stats.high, with_space(one.value_unit), array_sizes(array));
    }
    text += SafeText("\n");
    for (const std::string& note : info.notes)
        text += SafeText("note: {}\n", note);
    if (const std::string gaps = gaps_text(info); !gaps.empty())
        text += SafeText("note: a gap {}\n", gaps);
    const index::IndexStats& stats = file.stats();
    if (const std::uint64_t all = info.grid.vertex_count() * info.steps(); stats.nan_values == all)
        text += SafeText("note: all {} values are missing: no surface can be "
                         "found\n",
                         grouped(all));
    return text;
}

/// Opens the files. Where they leave the choice among several arrays, tells the command for each.
BuildSources opened(const std::vector<fs::path>& files, const BuildArguments& arguments,
                    const Command& command) {
    try {
        ProgressBar bar;
        return open_sources(files, arguments, bar.progress());
    } catch (const index::Error&) {
        const auto names = arrays_to_choose(files, arguments);
        for (const std::string& name : names)
            print_safely(stderr, "{}\n", command.typed_with({"--array", name}));
        if (!names.empty() && !arguments.read.component && !arguments.read.value_unit)
            print_safely(stderr, "{}\n", command.typed_with({"--all-arrays"}));
        throw;
    }
}

/// @param sources opened from `files`; null: not yet
void guard_index(const BuildArguments& arguments, std::vector<fs::path> files,
                 const BuildSources* sources) {
    const auto add = [&](const index::VolumeSeries& series) {
        const std::vector<fs::path> more = series.files();
        files.insert(files.end(), more.begin(), more.end());
    };
    if (sources) {
        add(*sources->volume);
        if (sources->colors)
            add(*sources->colors);
        for (const ArraySource& further : sources->further)
            add(*further.series);
    }
    guard_outputs({{arguments.out, OutputKind::index}}, {std::move(files)},
                  arguments.build.replaces_any || arguments.append);
}

void build_with(index::Team& team, const BuildArguments& asked, const Command& command,
                const CancelOnSignal& signals) {
    const bool reports = team.rank() == 0 && !asked.quiet;
    AskedBuild build(asked, team);
    const BuildArguments& arguments = build.arguments();
    if (const std::string note = former_tiers_note(asked.tiers); reports && !note.empty())
        print_safely(stderr, "isochron: {}\n", note);
    bool has_work = false;
    std::vector<std::string> left_out;
    team.together([&] {
        const std::vector<fs::path> files = expand_patterns(arguments.files);
        guard_index(arguments, files, nullptr); // at once, as opening may take long
        BuildSources sources = opened(files, arguments, command);
        guard_index(arguments, files, &sources);
        left_out = sources.notes;
        has_work = build.take(std::move(sources), files);
    });
    if (const std::string note = build.reread(); reports && !note.empty())
        print_safely(stderr, "isochron: {}\n", note);
    if (!has_work) {
        if (reports)
            print_safely("{}: holds every step of these files already\n", arguments.out.string());
        return;
    }
    std::string anew;
    {
        ProgressBar bar(stderr, build.bytes(), ProgressBar::Of::all);
        anew = build.write([&](std::string_view phase, double fraction) {
            signals.check();
            if (reports)
                bar.show(phase, fraction);
        });
    }
    if (reports)
        print_safely("{}{}", summary(arguments.out, *index::IndexFile::open(arguments.out)),
                     anew.empty() ? SafeText() : SafeText("note: written anew: {}\n", anew));
    if (reports)
        for (const std::string& array : left_out)
            print_safely("note: {}\n", array);
}

/// Prints `what` and ends the job. Not all processes know of the error, so none can be waited for.
void end_job(stereo::Cluster& cluster, const std::string& what, int status) {
    if (cluster.size() == 1)
        return;
    print_safely(stderr, "isochron: {}\n", what);
    cluster.abandon(status);
}

void run_build(const BuildArguments& arguments, const Command& command) {
    const CancelOnSignal signals;
    const auto team = index::join_team();
    if (team->size() > 1)
        EndInTime::leave_to_the_job();
    // A step may take as long as its disk needs; only a process that does not respond is lost.
    using Duration = stereo::ClusterLimits::Duration;
    constexpr Duration kForEver(std::numeric_limits<double>::infinity());
    stereo::Cluster cluster(*team, {.silence = Duration(arguments.timeout), .stall = kForEver});
    cluster.while_waiting([&] { signals.check(); });
    try {
        build_with(cluster, arguments, command, signals);
    } catch (const stereo::ProcessLost& lost) {
        end_job(cluster, lost.what(), 1);
        throw;
    } catch (const Canceled& canceled) {
        // mpirun sends this signal to all processes also when one of them has died.
        if (cluster.rank() > 0)
            throw ReportedElsewhere();
        end_job(cluster, "canceled, or another process of the job has ended", canceled.status);
        throw;
    } catch (const std::exception&) {
        if (cluster.rank() > 0)
            throw ReportedElsewhere();
        throw;
    }
}

} // namespace

void add_build(Command& program) {
    auto arguments = std::make_shared<BuildArguments>();
    Command command =
        program.subcommand("build", "Build an index of a series of volume files: one file.");
    command.examples({"isochron build 'run42/*.vti' -o run42.isochron",
                      "isochron build 'run42/*.vti' -o run42.isochron --append"});
    command
        .option(
            "files", arguments->files,
            "A .pvd, or the files of the steps in any order, also as quoted patterns ('t*.vti'); "
            "or an index, also one of the previous file version. The path of an HDF5 dataset "
            "may follow the file (run.h5:/fields/rho). Known are " +
                index::known_extensions())
        .required()
        .type_name("FILES");
    command
        .option("-o,--out", arguments->out,
                "Index to write. An existing one is replaced when the new one is complete; another "
                "file only with --force, and never one that is read")
        .required()
        .type_name("NAME.isochron");
    add_reading_options(command, *arguments);

    const auto [lattice, variation] = add_index_options(command, *arguments);
    command
        .option("--timeout", arguments->timeout,
                "In an MPI job: end the job when a process is silent for this many seconds")
        .between(0.1, 86400.0)
        .shows_default()
        .group("Index");
    command.flag("--force", arguments->build.replaces_any,
                 "Let --out replace a file that is no index");
    command.flag("--quiet", arguments->quiet, "Print errors only");
    command.footer(
        "Exit status: 0 done, 1 bad input, 2 bad usage, 130 interrupted. Unless it is "
        "0, no file is left behind\nand an older index is unchanged. mpirun -n N isochron "
        "build ... spreads the work over N processes that\nshare a file system.");
    command.on_run([arguments, lattice = lattice, variation = variation, command] {
        arguments->build.with_tree = lattice.given() || variation.given();
        set_up_readers(*arguments);
        run_build(with_path_within(*arguments), command);
    });
}

} // namespace isochron::app
