// `isochron build`: reads a series of volume files and writes its index.
#include "app/command_line/cancel.h"
#include "app/command_line/progress_bar.h"
#include "app/command_line/subcommands.h"
#include "app/indexing/build_sources.h"
#include "app/indexing/file_patterns.h"
#include "app/indexing/index_report.h"
#include "app/indexing/series_report.h"
#include "app/output/guarded_outputs.h"
#include "app/safe_text.h"
#include "app/text.h"
#include "index/error.h"
#include "index/file/index_states.h"
#include "index/indexing/appended_series.h"
#include "index/indexing/index_build.h"
#include "index/readers/formats/format.h"
#include "index/system/growing_file.h"
#include "index/system/team.h"
#include "stereo/cluster.h"

#include <fmt/format.h>

#include <limits>
#include <memory>
#include <new>
#include <optional>
#include <string_view>

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

/// Appends in place where that can be, else builds anew.
/// @param file the index that grows; null where a new one is built
/// @return what a user should know, or nothing
SafeText write_index(const BuildSources& sources, const BuildArguments& arguments,
                     const index::BuildOptions& options, const index::IndexFile* held,
                     index::GrowingFile* file, const index::Progress& progress, index::Team& team) {
    const std::string reason = held ? reason_to_rewrite(*held, options) : std::string();
    if (held && reason.empty()) {
        index::append_index(*sources.volume, *held, *file, arguments.out, options, progress, team);
        return {};
    }
    index::build_index(*sources.volume, arguments.out, options, progress, team);
    return held ? SafeText("note: written anew: {}\n", reason) : SafeText();
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
    BuildArguments arguments = asked;
    std::optional<index::GrowingFile> file;
    std::shared_ptr<const index::IndexFile> held;
    if (asked.append) {
        std::error_code ignored;
        if (!fs::exists(asked.out, ignored))
            throw index::Error(fmt::format(
                "{}: there is no index to append to yet; build it once without --append",
                asked.out.string()));
        team.together([&] { file.emplace(asked.out, team.rank() == 0); });
        team.together([&] {
            held = index::IndexFile::open(asked.out);
            if (const auto lost = index::lost_state(*held))
                throw index::Error(*lost); // appending would overwrite what is left of it
            arguments = with_held(asked, *held);
        });
    }
    if (const std::string note = former_tiers_note(asked.tiers); reports && !note.empty())
        print_safely(stderr, "isochron: {}\n", note);
    BuildSources sources;
    index::BuildOptions options;
    team.together([&] {
        const std::vector<fs::path> files = expand_patterns(arguments.files);
        guard_index(arguments, files, nullptr); // at once, as opening may take long
        sources = opened(files, arguments, command);
        guard_index(arguments, files, &sources);
        if (held)
            append_sources(sources, held, arguments.out.string());
        options = build_options(arguments, sources);
        for (std::size_t i = 0; held && arguments.tiers.empty() && i < options.further.size(); ++i)
            options.further[i].plan = held->array(i + 1).plan();
        if (arguments.refer) {
            options.referral = referral_to(files, arguments);
            options.referral->options.array = sources.array;
            options.referral->options.component = sources.component;
        }
    });
    if (!sources.volume) { // nothing to append
        if (reports)
            print_safely("{}: holds every step of these files already\n", arguments.out.string());
        return;
    }
    const index::SeriesInfo& info = sources.volume->info();
    const std::size_t known = held ? held->info().steps() : 0;
    SafeText note;
    try {
        ProgressBar bar(stderr,
                        static_cast<double>(info.step_bytes()) *
                            static_cast<double>(info.steps() - known),
                        ProgressBar::Of::all);
        note = write_index(
            sources, arguments, options, held.get(), file ? &*file : nullptr,
            [&](std::string_view phase, double fraction) {
                signals.check();
                if (reports)
                    bar.show(phase, fraction);
            },
            team);
    } catch (const std::bad_alloc&) {
        throw index::Error(
            fmt::format("{}: there is not enough memory to build it", arguments.out.string()));
    }
    if (reports)
        print_safely("{}{}", summary(arguments.out, *index::IndexFile::open(arguments.out)), note);
    if (reports)
        for (const std::string& left_out : sources.notes)
            print_safely("note: {}\n", left_out);
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

    const char* index_group = "Index";
    command
        .option("--tiers", arguments->tiers,
                "Search structures to build: bricks, tree (the paper's), both with a comma between "
                "them, or `none` (default: bricks)")
        .type_name("LIST")
        .group(index_group);
    command
        .option("--codec", arguments->codec,
                "How values are compressed (default: what suits each chunk best)")
        .one_of({"none", "lz4", "zstd"})
        .group(index_group);
    command
        .flag("--append", arguments->append,
              "Add the steps that NAME.isochron does not hold yet. FILES are all steps, the held "
              "ones first. Options that are not given stay as they were")
        .group(index_group);
    command
        .flag("--refer", arguments->refer,
              "Store references to FILES instead of a copy of their values")
        .group(index_group);
    command
        .option("--threads", arguments->build.threads,
                "Threads to build with (0: one for each processor)")
        .between(0u, 1024u)
        .group(index_group);
    command
        .option("--timeout", arguments->timeout,
                "In an MPI job: end the job when a process is silent for this many seconds")
        .between(0.1, 86400.0)
        .shows_default()
        .group(index_group);
    const Option lattice =
        command
            .option(
                "--lattice", arguments->build.tree.lattice,
                "Add the paper's tree; its lattice has L x L elements (the paper's SpanSpaceSize)")
            .between(1u, 4096u)
            .shows_default()
            .group(index_group);
    const Option variation = command
                                 .option("--max-variation", arguments->build.tree.max_variation,
                                         "Add the paper's tree; a cell is stored once for a time "
                                         "span in which it has at most this many lattice elements")
                                 .between(1u, 64u)
                                 .shows_default()
                                 .group(index_group);
    command.flag("--force", arguments->build.replaces_any,
                 "Let --out replace a file that is no index");
    command.flag("--quiet", arguments->quiet, "Print errors only");
    command.footer(
        "Exit status: 0 done, 1 bad input, 2 bad usage, 130 interrupted. Unless it is "
        "0, no file is left behind\nand an older index is unchanged. mpirun -n N isochron "
        "build ... spreads the work over N processes that\nshare a file system.");
    command.on_run([arguments, lattice, variation, command] {
        arguments->build.with_tree = lattice.given() || variation.given();
        set_up_readers(*arguments);
        run_build(with_path_within(*arguments), command);
    });
}

} // namespace isochron::app
