// The command line of `isochron build`, turned into the options of the index library.
#include "app/indexing/build_arguments.h"

#include "app/command_line/step_range.h"
#include "app/indexing/file_patterns.h"
#include "index/file/index_file.h"
#include "index/readers/formats/series/resampled_series.h"
#include "index/readers/process/reader_pool.h"
#include "index/system/new_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <iterator>
#include <sstream>
#include <string_view>

namespace isochron::app {
namespace fs = std::filesystem;

namespace {

std::string names_of(const index::TierSet& tiers) {
    std::vector<std::string_view> names;
    for (std::size_t i = 0; i < index::kTierNames.size(); ++i)
        if (tiers.has(static_cast<index::Tier>(i)))
            names.push_back(index::kTierNames[i]);
    return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ","));
}

glm::dvec3 vector_of(const std::vector<double>& numbers) {
    return {numbers[0], numbers[1], numbers[2]};
}

/// Whole numbers with a colon or a comma between each two. @throws UsageError: anything else
std::vector<std::uint64_t> numbers_of(std::string_view text, const std::string& option,
                                      const std::string& expected) {
    if (auto numbers = whole_numbers(text, ":,"))
        return *std::move(numbers);
    throw UsageError(fmt::format("{} {}, expected {}", option, text, expected));
}

/// `X0:X1,Y0:Y1,Z0:Z1`, both ends named.
std::array<std::array<std::uint32_t, 2>, 3> crop_of(const std::string& text) {
    const std::string expected = "the first and the last vertex along x, y and z: 0:99,20:59,0:31";
    std::string form;
    std::ranges::copy_if(text, std::back_inserter(form),
                         [](char c) { return c == ':' || c == ','; });
    const auto numbers = numbers_of(text, "--crop", expected);
    std::array<std::array<std::uint32_t, 2>, 3> crop{};
    if (form != ":,:,:" || std::ranges::any_of(numbers, [](auto n) { return n > 65536; }))
        throw UsageError(fmt::format("--crop {}, expected {}", text, expected));
    for (std::size_t i = 0; i < 6; ++i)
        crop[i / 2][i % 2] = static_cast<std::uint32_t>(numbers[i]);
    return crop;
}

std::array<std::uint32_t, 3> stride_of(const std::string& text) {
    const std::string expected = "every how many vertices, for all axes or for each: 2 or 2,2,1";
    auto numbers = numbers_of(text, "--stride", expected);
    if (numbers.size() == 1)
        numbers.resize(3, numbers.front());
    if (numbers.size() != 3 || text.find(':') != text.npos ||
        std::ranges::any_of(numbers, [](auto n) { return n < 1 || n > 65536; }))
        throw UsageError(fmt::format("--stride {}, expected {}", text, expected));
    return {static_cast<std::uint32_t>(numbers[0]), static_cast<std::uint32_t>(numbers[1]),
            static_cast<std::uint32_t>(numbers[2])};
}

std::array<std::uint64_t, 3> steps_of_text(const std::string& text) {
    const std::string expected = "the first and the last step, from 0: 0:20, or each fifth: 0:20:5";
    const auto numbers = numbers_of(text, "--steps", expected);
    if ((numbers.size() != 2 && numbers.size() != 3) || text.find(',') != text.npos ||
        (numbers.size() == 3 && numbers[2] == 0))
        throw UsageError(fmt::format("--steps {}, expected {}", text, expected));
    return {numbers[0], numbers[1], numbers.size() == 3 ? numbers[2] : 1};
}

/// Takes what the user left open from how files were read before.
void fill_in(index::ReadOptions& read, const index::ReadOptions& held) {
    const auto take = [](auto& of, const auto& held_one) {
        if (!of)
            of = held_one;
    };
    take(read.allow_surplus, held.allow_surplus);
    take(read.extra_axis_is_time, held.extra_axis_is_time);
    take(read.member, held.member);
    take(read.times_from_names, held.times_from_names);
    take(read.dates, held.dates);
    take(read.keep_first, held.keep_first);
    take(read.crop, held.crop);
    take(read.stride, held.stride);
    take(read.steps, held.steps);
    take(read.resample, held.resample);
    take(read.dims, held.dims);
    take(read.type, held.type);
    take(read.big_endian, held.big_endian);
    take(read.header_bytes, held.header_bytes);
    take(read.spacing, held.spacing);
    take(read.origin, held.origin);
    take(read.time_step, held.time_step);
    take(read.length_unit, held.length_unit);
    take(read.time_unit, held.time_unit);
    take(read.value_unit, held.value_unit);
}

} // namespace

BuildArguments with_path_within(BuildArguments arguments) {
    const bool several = arguments.all_arrays || arguments.arrays.size() > 1;
    if (arguments.all_arrays && !arguments.arrays.empty())
        throw UsageError("--all-arrays and --array: expected one of them, not both");
    if (several && arguments.read.component)
        throw UsageError("--component: with several arrays add it to a name: --array "
                         "velocity.magnitude");
    if (several && arguments.read.value_unit)
        throw UsageError("--value-unit: expected with one array only");
    if (!arguments.arrays.empty())
        arguments.read.array = arguments.arrays.front();
    const auto path = take_path_within(arguments.files);
    if (path && arguments.read.array)
        throw UsageError(fmt::format("--array {} and {} in the name of a file: expected one",
                                     *arguments.read.array, *path));
    if (path)
        arguments.read.array = path;
    return arguments;
}

index::ReadOptions read_options(const BuildArguments& arguments) {
    index::ReadOptions read = arguments.read;
    if (!arguments.dims.empty())
        read.dims = {arguments.dims[0], arguments.dims[1], arguments.dims[2]};
    if (!arguments.crop.empty())
        read.crop = crop_of(arguments.crop);
    if (!arguments.stride.empty())
        read.stride = stride_of(arguments.stride);
    if (!arguments.steps.empty())
        read.steps = steps_of_text(arguments.steps);
    if (!arguments.resample.empty())
        read.resample = {arguments.resample[0], arguments.resample[1], arguments.resample[2]};
    if (arguments.resample_by_cell)
        read.resample = index::kBySmallestCell;
    if (!arguments.dates.empty())
        read.dates =
            arguments.dates == "dmy" ? index::DayMonth::day_first : index::DayMonth::month_first;
    if (!arguments.type.empty())
        read.type = index::value_type_from_name(arguments.type);
    if (!arguments.spacing.empty())
        read.spacing = vector_of(arguments.spacing);
    if (!arguments.origin.empty())
        read.origin = vector_of(arguments.origin);
    return read;
}

index::ReadOptions color_options(const BuildArguments& arguments) {
    index::ReadOptions read = read_options(arguments);
    read.array = arguments.color;
    read.component = arguments.color_component;
    read.value_unit = arguments.color_unit;
    return read;
}

index::TierSet tiers_of(const std::string& list) {
    index::TierSet tiers;
    if (list == "none")
        return tiers;
    std::istringstream names(list);
    for (std::string name; std::getline(names, name, ',');) {
        const auto tier =
            index::tier_from_name(index::is_former_tier(name) ? std::string_view("bricks") : name);
        if (!tier)
            throw UsageError(fmt::format("--tiers: {}: expected none, or some of {}", name,
                                         fmt::join(index::kTierNames, ",")));
        tiers = tiers.with(*tier);
    }
    return tiers;
}

std::string former_tiers_note(const std::string& list) {
    std::istringstream names(list);
    for (std::string name; std::getline(names, name, ',');)
        if (index::is_former_tier(name))
            return fmt::format("--tiers {}: {} is no longer built; bricks take its place", list,
                               name);
    return {};
}

index::Referral referral_to(const std::vector<fs::path>& files, const BuildArguments& arguments) {
    index::Referral referral{.files = {}, .options = read_options(arguments)};
    const fs::path folder = fs::absolute(index::end_of_links(arguments.out)).parent_path();
    for (const fs::path& file : files)
        referral.files.push_back(fs::absolute(file).lexically_relative(folder));
    return referral;
}

BuildArguments with_held(BuildArguments arguments, const index::IndexFile& held) {
    const index::Metadata& known = held.metadata();
    index::BuildOptions& build = arguments.build;
    if (arguments.tiers.empty())
        build.plan = held.plan();
    if (held.plan().tiers.has(index::Tier::tree) && !build.with_tree) {
        build.with_tree = true;
        build.tree = held.tree_options();
    }
    if (arguments.codec.empty())
        build.codec = held.codec();
    arguments.refer = arguments.refer || held.referral();
    if (!arguments.read.array && held.arrays() > 1) {
        for (std::size_t number = 0; number < held.arrays(); ++number) {
            const index::Metadata& one = held.array(number).metadata();
            arguments.arrays.push_back(one.chosen_array.value_or(one.info.array) +
                                       (one.chosen_component ? "." + *one.chosen_component : ""));
        }
        arguments.all_arrays = false;
        arguments.read.array = arguments.arrays.front();
    } else if (!arguments.read.array) {
        arguments.read.array = known.chosen_array;
        arguments.read.component = known.chosen_component;
    }
    if (known.reading)
        fill_in(arguments.read, *known.reading);
    else if (held.referral()) // an index of an older program
        fill_in(arguments.read, held.referral()->options);
    if (!arguments.color && held.color()) {
        arguments.color = held.color()->chosen_array.value_or(held.color()->array);
        arguments.color_component = held.color()->chosen_component;
    }
    return arguments;
}

std::string reason_to_rewrite(const index::IndexFile& held, const index::BuildOptions& options) {
    for (std::size_t number = 0; number < held.arrays(); ++number) {
        const index::TierSet has = held.array(number).plan().tiers;
        index::TierSet wanted = options.tiers.value_or(has);
        if (options.with_tree)
            wanted = wanted.with(index::Tier::tree);
        if (wanted != has)
            return fmt::format("tiers {} instead of {}", names_of(wanted), names_of(has));
    }
    if (options.codec != held.codec())
        return fmt::format("codec {} instead of {}",
                           index::kCodecNames[static_cast<std::size_t>(options.codec)],
                           index::kCodecNames[static_cast<std::size_t>(held.codec())]);
    if (options.referral.has_value() != held.referral().has_value())
        return "it refers to its files from now on";
    if (options.with_tree)
        return "the paper's tree spans all steps";
    return {};
}

void set_up_readers(const BuildArguments& arguments) {
    index::ReaderPool& readers = index::readers_of_this_process();
    readers.let_read(arguments.allowed);
    readers.set_patience(std::chrono::milliseconds(std::lround(arguments.patience * 1000)));
}

void add_reading_options(Command& command, BuildArguments& arguments) {
    index::ReadOptions& read = arguments.read;
    command
        .option("--array", arguments.arrays,
                "Array to read, if the files hold several. Given several times, each becomes an "
                "array of the index; a component may stand behind its name: velocity.magnitude. "
                "A pattern stands for all that match: 'u*'. u,v,w is the vector of three arrays")
        .repeatable()
        .type_name("NAME")
        .group("Reading");
    command
        .flag("--all-arrays", arguments.all_arrays,
              "Read every array that has the same shape as the first, of vectors the magnitude")
        .group("Reading");
    command
        .option(
            "--component", read.component,
            "Component of a vector array: a number from 0, or `magnitude`; or what is computed: "
            "`gradient` (its length) of a scalar, `vorticity` (its length) or `q-criterion` of a "
            "vector")
        .group("Reading");
    command
        .flag("--allow-surplus", read.allow_surplus,
              "Accept files with more data than their header says")
        .group("Reading");
    command
        .flag("--extra-axis-is-time", read.extra_axis_is_time,
              "Read the axis that is not x, y or z as time, even if the file says otherwise or "
              "leaves it open")
        .group("Reading");
    command
        .option("--member", read.member,
                "Which run of an ensemble to read, counted from 0, where files hold several")
        .type_name("N")
        .group("Reading");
    command
        .option("--resample", arguments.resample,
                "Interpolate a rectilinear, curvilinear or unstructured grid onto a regular grid "
                "of this many vertices")
        .values(3)
        .type_name("NX NY NZ")
        .between(2u, 65537u)
        .group("Reading");
    command
        .flag("--resample-by-cell", arguments.resample_by_cell,
              "The same, with the smallest cell's size as the distance between vertices")
        .group("Reading");
    command
        .flag("--times-from-names", read.times_from_names,
              "Use as time the number that differs from file to file in the names of the files, or "
              "of their folders; of several, the last: 30 of t_0030.vti, 0.25 of 0.25/p.vti. Or "
              "the date: 2020-01-02, 20200102T0600")
        .group("Reading");
    command
        .option("--dates", arguments.dates,
                "Order of day and month in dates whose year is last, in names and in files: "
                "01-02-2020 is the first of February (dmy) or January 2 (mdy)")
        .one_of({"dmy", "mdy"})
        .group("Reading");
    command
        .flag("--keep-first", read.keep_first,
              "Of steps with the same time, as a restart leaves them, read the first instead of "
              "the last")
        .group("Reading");
    command
        .option("--crop", arguments.crop,
                "Read only a part: the first and the last vertex along each axis, from 0")
        .type_name("X0:X1,Y0:Y1,Z0:Z1")
        .group("Reading");
    command
        .option("--stride", arguments.stride,
                "Read only every second vertex, or every Nth, along all axes or each: 2 or 2,2,1")
        .type_name("N")
        .group("Reading");
    command
        .option("--steps", arguments.steps,
                "Read only some steps: the first and the last, from 0, and the stride: 0:20:5")
        .type_name("A:B[:C]")
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
    command
        .option("--allow", arguments.allowed,
                "Folder from which the files may read others that they name (links of HDF5, XDMF "
                "and .pvd); without it only those in their own folders. May be given several times")
        .repeatable()
        .existing_folder()
        .type_name("FOLDER")
        .group("Reading");
    command
        .option("--patience", arguments.patience,
                "End a reader that does nothing for this many seconds, and a second more for each "
                "megabyte of its file; time in which it waits for a local disk does not count")
        .between(1, 86400)
        .shows_default()
        .type_name("SECONDS")
        .group("Reading");
    command.option("--time-unit", read.time_unit, "Unit of times, such as s").group("Reading");
    command.option("--value-unit", read.value_unit, "Unit of the values, such as K")
        .group("Reading");

    const char* colors = "Colors";
    const Option color =
        command.option("--color", arguments.color, "A second array, to color the surfaces by")
            .group(colors);
    command
        .option("--color-component", arguments.color_component,
                "Component of the second array, as `--component` has it")
        .needs(color)
        .group(colors);
    command.option("--color-unit", arguments.color_unit, "Unit of the second array's values")
        .needs(color)
        .group(colors);

    const char* raw = "Headerless raw files";
    command.option("--dims", arguments.dims, "Vertices along each axis, x fastest")
        .values(3)
        .type_name("NX NY NZ")
        .between(2u, 65537u)
        .group(raw);
    command
        .option("--type", arguments.type,
                "Type of the stored values of raw files; others are\nconverted to it, so that "
                "files of several types make\na series")
        .one_of({"i8", "u8", "i16", "u16", "i32", "f32", "f64"})
        .group(raw);
    command.flag("--big-endian", read.big_endian, "Big-endian values (default: little-endian)")
        .group(raw);
    command.option("--header-bytes", read.header_bytes, "Bytes to skip at the start of each file")
        .shows_default()
        .group(raw);
}

std::pair<Option, Option> add_index_options(Command& command, BuildArguments& arguments) {
    const char* index_group = "Index";
    command
        .option("--tiers", arguments.tiers,
                "Search structures to build: bricks, tree (the paper's), both with a comma between "
                "them, or `none` (default: bricks)")
        .type_name("LIST")
        .group(index_group);
    command
        .option("--codec", arguments.codec,
                "How values are compressed (default: what suits each chunk best)")
        .one_of({"none", "lz4", "zstd"})
        .group(index_group);
    command
        .flag("--append", arguments.append,
              "Add the steps that NAME.isochron does not hold yet. FILES are all steps, the held "
              "ones first. Options that are not given stay as they were")
        .group(index_group);
    command
        .flag("--refer", arguments.refer,
              "Store references to FILES instead of a copy of their values")
        .group(index_group);
    command
        .option("--threads", arguments.build.threads,
                "Threads to build with (0: one for each processor)")
        .between(0u, 1024u)
        .group(index_group);
    const Option lattice =
        command
            .option(
                "--lattice", arguments.build.tree.lattice,
                "Add the paper's tree; its lattice has L x L elements (the paper's SpanSpaceSize)")
            .between(1u, 4096u)
            .shows_default()
            .group(index_group);
    const Option variation = command
                                 .option("--max-variation", arguments.build.tree.max_variation,
                                         "Add the paper's tree; a cell is stored once for a time "
                                         "span in which it has at most this many lattice elements")
                                 .between(1u, 64u)
                                 .shows_default()
                                 .group(index_group);
    return {lattice, variation};
}

BuildArguments build_arguments_of(const std::vector<std::string>& words) {
    BuildArguments arguments;
    read_words(words, [&](Command& command) {
        add_reading_options(command, arguments);
        add_index_options(command, arguments);
    });
    arguments.build.with_tree = std::ranges::any_of(words, [](const std::string& word) {
        return word.starts_with("--lattice=") || word.starts_with("--max-variation=");
    });
    return arguments;
}

} // namespace isochron::app
