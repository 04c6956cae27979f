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
#include "app/telling.h"
#include "app/text.h"
#include "index/error.h"
#include "index/readers/formats/format.h"
#include "index/system/team.h"
#include "stereo/cluster.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

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
        text += SafeText("{}, values {}\n{}", index::name_of(one.type),
                         exact_range_text(stats.low, stats.high, one), array_sizes(array));
    }
    text += SafeText("\n");
    return text;
}

/// What is to be known of the index that was written.
std::vector<std::string> notes_of(const index::IndexFile& file) {
    const index::SeriesInfo& info = file.info();
    std::vector<std::string> notes = info.notes;
    if (const std::string gaps = gaps_text(info); !gaps.empty())
        notes.push_back("a gap " + gaps);
    if (const std::uint64_t all = info.grid.vertex_count() * info.steps();
        file.stats().nan_values == all)
        notes.push_back(
            fmt::format("all {} values are missing: no surface can be found", grouped(all)));
    return notes;
}

/// Reports the index under the name that was asked for. @param written false: it held every step already
void report(const fs::path& out, const index::IndexFile& file, bool written,
            const std::vector<std::string>& more_notes) {
    std::vector<std::string> notes = written ? notes_of(file) : std::vector<std::string>();
    notes.insert(notes.end(), more_notes.begin(), more_notes.end());
    for (const std::string& note : notes)
        print_note("note: {}", note);
    nlohmann::ordered_json arrays = nlohmann::ordered_json::array();
    for (std::size_t number = 0; number < file.arrays(); ++number)
        arrays.push_back(array_json(file.array(number)));
    tell_result({{"file", out.string()},
                 {"written", written},
                 {"vertices", std::vector<std::size_t>(file.info().grid.vertices.begin(),
                                                       file.info().grid.vertices.end())},
                 {"steps", file.info().steps()},
                 {"arrays", arrays},
                 {"file_bytes", file.stats().file_bytes},
                 {"notes", notes}});
    if (written)
        print_report(summary(out, file));
    else
        print_report("{}: holds every step of these files already\n", out.string());
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
    const bool leads = team.rank() == 0;
    AskedBuild build(asked, team);
    const BuildArguments& arguments = build.arguments();
    if (const std::string note = former_tiers_note(asked.tiers); leads && !note.empty())
        print_note("{}", note);
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
    if (const std::string note = build.reread(); leads && !note.empty())
        print_note("{}", note);
    if (!has_work) {
        if (leads)
            report(arguments.out, build.index(), false, {});
        return;
    }
    std::string anew;
    {
        ProgressBar bar(stderr, build.bytes(), ProgressBar::Of::all);
        anew = build.write([&](std::string_view phase, double fraction) {
            signals.check();
            if (leads)
                bar.show(phase, fraction);
        });
    }
    if (!anew.empty())
        left_out.insert(left_out.begin(), "written anew: " + anew);
    if (leads)
        report(arguments.out, build.index(), true, left_out);
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
    Command command = program.subcommand(
        "build", "Build an index, which is one file, of the volume files of a series.");
    command.examples({"isochron build 'run42/*.vti' -o run42.isochron",
                      "isochron build 'run42/*.vti' -o run42.isochron --append"});
    command
        .option(
            "files FILE", arguments->files,
            "A .pvd file, or the files of all steps in any order; a quoted pattern ('t*.vti') "
            "stands for all files that match. An index, also one of an earlier version, is read "
            "like a file. A dataset within an HDF5 file is run.h5:/fields/rho")
        .required();
    command
        .option(
            "-o,--output,--out INDEX", arguments->out,
            "Index to write, NAME.isochron. An index that exists is replaced once the new one is "
            "complete; any other file needs --force, and files that are read are never replaced")
        .required();
    add_reading_options(command, *arguments);

    const auto [lattice, variation] = add_index_options(command, *arguments);
    command
        .option(
            "--timeout SECONDS", arguments->timeout,
            "In a job of several processes (mpirun): end the job once a process has been silent "
            "for this long")
        .between(0.1, 86400.0)
        .shows_default()
        .group("Index");
    command.flag("--force", arguments->build.replaces_any,
                 "Let --output replace a file that is no index");
    command.footer("A build that ends with an error leaves no file behind, and an older index "
                   "unchanged. `mpirun -n N isochron build ...` spreads the work over N processes "
                   "that share a file system.\n\nExtensions of files that can be read: " +
                   index::known_extensions());
    command.on_run([arguments, lattice = lattice, variation = variation, command] {
        arguments->build.with_tree = lattice.given() || variation.given();
        set_up_readers(*arguments);
        run_build(with_path_within(*arguments), command);
    });
}

} // namespace isochron::app
