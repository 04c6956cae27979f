// `isochron build`: reads a series of volume files and writes its index.
#include "app/commands/cancel.h"
#include "app/commands/file_patterns.h"
#include "app/commands/index_report.h"
#include "app/commands/progress_bar.h"
#include "app/commands/subcommands.h"
#include "app/text.h"
#include "index/build/appended_series.h"
#include "index/build/index_build.h"
#include "index/error.h"
#include "index/file/index_series.h"
#include "index/system/team.h"
#include "stereo/cluster.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <limits>
#include <memory>
#include <new>
#include <sstream>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;

struct BuildArguments {
    std::vector<std::string> files;
    fs::path out;
    index::ReadOptions read;
    std::string type;
    std::vector<std::uint32_t> dims;
    std::vector<double> spacing, origin;
    index::BuildOptions build;
    std::string tiers, codec;
    std::optional<std::string> color, color_component, color_unit;
    bool quiet = false, append = false, refer = false;
    double timeout = 30; ///< [s]
};

std::optional<glm::dvec3> vector_of(const std::vector<double>& numbers) {
    if (numbers.empty())
        return std::nullopt;
    return glm::dvec3(numbers[0], numbers[1], numbers[2]);
}

index::ReadOptions read_options(const BuildArguments& arguments) {
    index::ReadOptions read = arguments.read;
    if (!arguments.dims.empty())
        read.dims = {arguments.dims[0], arguments.dims[1], arguments.dims[2]};
    if (!arguments.type.empty())
        read.type = index::value_type_from_name(arguments.type);
    read.spacing = vector_of(arguments.spacing);
    read.origin = vector_of(arguments.origin);
    return read;
}

/// Of the second array: the same files, and all that was said of them, but another array.
index::ReadOptions color_options(const BuildArguments& arguments) {
    index::ReadOptions read = read_options(arguments);
    read.array = arguments.color;
    read.component = arguments.color_component;
    read.value_unit = arguments.color_unit;
    return read;
}

/// `bricks,cells`; `none` for an index that only scans.
index::TierSet tiers_of(const std::string& list) {
    index::TierSet tiers;
    if (list == "none")
        return tiers;
    std::istringstream names(list);
    for (std::string name; std::getline(names, name, ',');) {
        const auto tier = index::tier_from_name(name);
        if (!tier)
            throw UsageError(fmt::format("--tiers: {}: expected none, or some of {}", name,
                                         fmt::join(index::kTierNames, ",")));
        tiers = tiers.with(*tier);
    }
    return tiers;
}

/// The files as the index will look for them: from its own folder.
index::Referral referral_to(const std::vector<fs::path>& files, const BuildArguments& arguments) {
    index::Referral referral{.files = {}, .options = read_options(arguments)};
    const fs::path folder = fs::absolute(arguments.out).parent_path();
    for (const fs::path& file : files)
        referral.files.push_back(fs::absolute(file).lexically_relative(folder));
    return referral;
}

/// An index is a series too: of an older file version it becomes one of this.
bool is_one_index(const std::vector<fs::path>& files) {
    return files.size() == 1 && index::is_index(files.front());
}

std::string summary(const fs::path& out, const index::IndexFile& file) {
    const index::SeriesInfo& info = file.info();
    const index::IndexStats& stats = file.stats();
    const auto& n = info.grid.vertices;
    std::string text = fmt::format("{}: {} x {} x {} vertices, {} step{}, {}, values {} to {}{}\n"
                                   "{}\n",
                                   out.string(), n[0], n[1], n[2], info.steps(),
                                   info.steps() == 1 ? "" : "s", index::name_of(info.type),
                                   stats.low, stats.high, with_space(info.value_unit), sizes(file));
    for (const std::string& note : info.notes)
        text += fmt::format("note: {}\n", note);
    return text;
}

/// What was asked for; an index that is appended to stays what it is in all that was not.
BuildArguments with_held(BuildArguments arguments, const index::IndexFile& held) {
    index::BuildOptions& build = arguments.build;
    if (arguments.tiers.empty() && held.plan().asked)
        build.tiers = held.plan().tiers;
    if (!build.with_tree && held.plan().tiers.has(index::Tier::tree)) {
        build.with_tree = true;
        build.tree = held.tree_options();
    }
    if (arguments.codec.empty())
        build.codec = held.codec();
    arguments.refer = arguments.refer || held.referral();
    if (!arguments.color && held.color()) {
        arguments.color = held.color()->chosen_array.value_or(held.color()->array);
        arguments.color_component = held.color()->chosen_component;
    }
    return arguments;
}

void build_with(index::Team& team, const BuildArguments& asked, const CancelOnSignal& signals) {
    const bool reports = team.rank() == 0 && !asked.quiet;
    BuildArguments arguments = asked;
    std::shared_ptr<const index::IndexFile> held;
    if (asked.append)
        team.together([&] {
            held = index::IndexFile::open(asked.out);
            arguments = with_held(asked, *held);
        });
    index::BuildOptions options = arguments.build;
    if (!arguments.tiers.empty())
        options.tiers = tiers_of(arguments.tiers);
    if (!arguments.codec.empty())
        options.codec = *index::codec_from_name(arguments.codec);
    options.color_array = arguments.color;
    options.color_component = arguments.color_component;
    std::unique_ptr<index::VolumeSeries> series, colors;
    team.together([&] {
        const std::vector<fs::path> files = expand_patterns(arguments.files);
        refuse_input_as_output(files, arguments.out);
        if (arguments.refer)
            options.referral = referral_to(files, arguments);
        if (is_one_index(files)) {
            if (arguments.refer)
                throw UsageError("--refer: an index has no files of values to refer to");
            series = index::open_index_series(files.front(), read_options(arguments));
            index::ReadOptions of_colors = color_options(arguments);
            if (!of_colors.array)
                of_colors.array = index::color_of_index(files.front());
            if (of_colors.array)
                colors = index::open_index_series(files.front(), of_colors);
        } else {
            series = index::open_series(files, read_options(arguments));
            if (arguments.color)
                colors = index::open_series(files, color_options(arguments));
        }
        if (held) {
            series = index::append_to(held, arguments.out.string(), std::move(series));
            colors = index::append_colors_to(held, arguments.out.string(), std::move(colors));
        }
        options.color = colors.get();
    });
    if (!series) { // nothing to append
        if (reports)
            fmt::print("{}: holds every step of these files already\n", arguments.out.string());
        return;
    }
    const index::SeriesInfo& info = series->info();
    try {
        ProgressBar bar(stderr,
                        static_cast<double>(info.step_bytes()) * static_cast<double>(info.steps()));
        index::build_index(
            *series, arguments.out, options,
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
        fmt::print("{}", summary(arguments.out, *index::IndexFile::open(arguments.out)));
}

/// In a job, `what` is the last word: not all members know of it, so none can be waited for.
void end_job(stereo::Cluster& cluster, const std::string& what, int status) {
    if (cluster.size() == 1)
        return;
    fmt::print(stderr, "isochron: {}\n", what);
    cluster.abandon(status);
}

void run_build(const BuildArguments& arguments) {
    const CancelOnSignal signals;
    const auto team = index::join_team();
    // A step may take as long as its disk does; only a process that shows no life is lost.
    using Duration = stereo::ClusterLimits::Duration;
    constexpr Duration kForEver(std::numeric_limits<double>::infinity());
    stereo::Cluster cluster(*team, {.silence = Duration(arguments.timeout), .stall = kForEver});
    cluster.while_waiting([&] { signals.check(); });
    try {
        build_with(cluster, arguments, signals);
    } catch (const stereo::ProcessLost& lost) {
        end_job(cluster, lost.what(), 1);
        throw;
    } catch (const Canceled& canceled) {
        // mpirun ends all processes this way when one of them has died, too.
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

void add_reading_options(Command& command, BuildArguments& arguments) {
    index::ReadOptions& read = arguments.read;
    command.option("--array", read.array, "Scalar array to read, where files hold several")
        .group("Reading");
    command
        .option("--component", read.component,
                "Component of a vector array: a number from 0, or magnitude")
        .group("Reading");
    command
        .flag("--allow-surplus", read.allow_surplus,
              "Read files in which data are left over after the values that the header says")
        .group("Reading");
    command
        .option("--spacing", arguments.spacing,
                "Distance between vertices along each axis, in length units "
                "(default: as the files say, else 1 1 1)")
        .values(3)
        .type_name("SX SY SZ")
        .positive()
        .group("Reading");
    command
        .option("--origin", arguments.origin,
                "Position of the first vertex, in length units "
                "(default: as the files say, else 0 0 0)")
        .values(3)
        .type_name("OX OY OZ")
        .group("Reading");
    command
        .option("--time-step", read.time_step,
                "Physical time between steps, in time units (default: as the files say, "
                "else 1)")
        .positive()
        .group("Reading");
    command.option("--length-unit", read.length_unit, "Unit of positions, such as mm")
        .group("Reading");
    command.option("--time-unit", read.time_unit, "Unit of times, such as s").group("Reading");
    command.option("--value-unit", read.value_unit, "Unit of the values, such as K")
        .group("Reading");

    const char* colors = "Colors";
    const Option color =
        command
            .option("--color", arguments.color, "A second array of the files to color surfaces by")
            .group(colors);
    command
        .option("--color-component", arguments.color_component,
                "Its component, where it is a vector array: a number from 0, or magnitude")
        .needs(color)
        .group(colors);
    command.option("--color-unit", arguments.color_unit, "Unit of its values")
        .needs(color)
        .group(colors);

    const char* raw = "Headerless raw files";
    command.option("--dims", arguments.dims, "Vertices along each axis, x fastest")
        .values(3)
        .type_name("NX NY NZ")
        .between(2u, 65537u)
        .group(raw);
    command.option("--type", arguments.type, "Type of the stored values")
        .one_of({"i8", "u8", "i16", "u16", "i32", "f32", "f64"})
        .group(raw);
    command.flag("--big-endian", read.big_endian, "Most significant byte first (default: least)")
        .group(raw);
    command.option("--header-bytes", read.header_bytes, "Bytes to skip at the start of each file")
        .shows_default()
        .group(raw);
}

} // namespace

void add_build(Command& program) {
    auto arguments = std::make_shared<BuildArguments>();
    Command command =
        program.subcommand("build", "Read a series of volume files and write its index, one file.");
    command
        .option("files", arguments->files,
                "One .pvd, or the steps' files or quoted patterns ('t*.vti') in any order: "
                ".vti .vtk .mhd .mha .nhdr .nrrd .nii .nii.gz .nc, or raw; or an index, also of "
                "the file "
                "version before this")
        .required()
        .type_name("FILES");
    command.option("-o,--out", arguments->out, "Index to write; replaced when complete")
        .required()
        .type_name("NAME.isochron");
    add_reading_options(command, *arguments);

    const char* index_group = "Index";
    command
        .option("--tiers", arguments->tiers,
                "Search structures instead of the planner's choice: some of "
                "bricks,cells,deltas,tree, or none")
        .type_name("LIST")
        .group(index_group);
    command
        .option("--codec", arguments->codec,
                "How values are packed, instead of what suits each chunk of them best")
        .one_of({"none", "lz4", "zstd"})
        .group(index_group);
    command
        .flag("--append", arguments->append,
              "Add the steps that NAME.isochron does not hold yet, if any; FILES are all of "
              "them, those that it holds first. It stays as it was built in all that is not "
              "asked for")
        .group(index_group);
    command
        .flag("--refer", arguments->refer,
              "Refer to FILES instead of carrying a copy of their values")
        .group(index_group);
    command
        .option("--threads", arguments->build.threads,
                "Threads to build with (default 0: as many as there are processors)")
        .between(0u, 1024u)
        .group(index_group);
    command
        .option("--timeout", arguments->timeout,
                "In an MPI job: seconds without a sign of life after which a process is lost, "
                "and the job ends")
        .between(0.1, 86400.0)
        .shows_default()
        .group(index_group);
    const Option lattice =
        command
            .option("--lattice", arguments->build.tree.lattice,
                    "Add the paper's tree, of SpanSpaceSize L: the lattice has L x L elements, "
                    "1 to 4096")
            .between(1u, 4096u)
            .shows_default()
            .group(index_group);
    const Option variation =
        command
            .option("--max-variation", arguments->build.tree.max_variation,
                    "Add the paper's tree: most distinct lattice elements of a cell that is "
                    "stored once for a time span, 1 to 64")
            .between(1u, 64u)
            .shows_default()
            .group(index_group);
    command.flag("--quiet", arguments->quiet, "Print nothing but errors");
    command.footer(
        "Exit status: 0 done, 1 bad input, 2 bad usage, 130 interrupted. Unless it is "
        "0, no file is left behind\nand an older index stays as it was. mpirun -n N isochron "
        "build ... spreads the work over N processes that\nshare a file system.");
    command.on_run([arguments, lattice, variation] {
        arguments->build.with_tree = lattice.given() || variation.given();
        run_build(*arguments);
    });
}

} // namespace isochron::app
