// The command line of `isochron build`, turned into the options of the index library.
#include "app/indexing/build_arguments.h"

#include "app/command_line/step_range.h"
#include "app/indexing/file_patterns.h"
#include "index/file/index_file.h"
#include "index/readers/formats/series/resampled_series.h"
#include "index/readers/process/reader_pool.h"
#include "index/system/links/link.h"
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
#include <tuple>

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
    throw UsageError("{} {}, expected {}", option, text, expected);
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
        throw UsageError("--crop {}, expected {}", text, expected);
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
        throw UsageError("--stride {}, expected {}", text, expected);
    return {static_cast<std::uint32_t>(numbers[0]), static_cast<std::uint32_t>(numbers[1]),
            static_cast<std::uint32_t>(numbers[2])};
}

std::array<std::uint64_t, 3> steps_of_text(const std::string& text) {
    const std::string expected =
        "a step, from 0, the first and the last one, 0:20, or every fifth of them, 0:20:5";
    const auto numbers = numbers_of(text, "--steps", expected);
    if (numbers.size() > 3 || text.find(',') != text.npos ||
        (numbers.size() == 3 && numbers[2] == 0))
        throw UsageError("--steps {}, expected {}", text, expected);
    return {numbers[0], numbers.size() > 1 ? numbers[1] : numbers[0],
            numbers.size() == 3 ? numbers[2] : 1};
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
        throw UsageError(
            "--component: with several arrays add it to a name: --array velocity.magnitude");
    if (several && arguments.read.value_unit)
        throw UsageError("--value-unit: expected with one array only");
    if (!arguments.arrays.empty())
        arguments.read.array = arguments.arrays.front();
    const auto path = take_path_within(arguments.files);
    if (path && arguments.read.array)
        throw UsageError("--array {} and {} in the name of a file: expected one",
                         *arguments.read.array, *path);
    if (path)
        arguments.read.array = path;
    return arguments;
}

index::ReadOptions read_options(const BuildArguments& arguments) {
    index::ReadOptions read = arguments.read;
    if (!arguments.dims.empty())
        read.dims = {arguments.dims[0], arguments.dims[1], arguments.dims[2]};
    if (arguments.crop)
        read.crop = crop_of(*arguments.crop);
    if (arguments.stride)
        read.stride = stride_of(*arguments.stride);
    if (arguments.steps)
        read.steps = steps_of_text(*arguments.steps);
    if (!arguments.resample.empty())
        read.resample = {arguments.resample[0], arguments.resample[1], arguments.resample[2]};
    if (arguments.resample_by_cell)
        read.resample = index::kBySmallestCell;
    read.dates = index::day_month_of(arguments.dates);
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
            throw UsageError("--tiers: {}: expected none, or some of {}", name,
                             fmt::join(index::kTierNames, ","));
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
    if (arguments.patience != BuildArguments().patience)
        index::set_link_patience(std::chrono::milliseconds(std::lround(arguments.patience * 1000)));
}

void add_reading_options(Command& command, BuildArguments& arguments) {
    index::ReadOptions& read = arguments.read;
    const char* reading = "Reading";
    command
        .option(
            "--array NAME", arguments.arrays,
            "Array to read, where the files hold several. May be given several times: the index "
            "then holds each of these arrays. `velocity.magnitude` is a component of an array, "
            "'u*' stands for all arrays whose names match, and u,v,w makes one vector of three "
            "arrays")
        .repeatable()
        .group(reading);
    command
        .flag("--all-arrays", arguments.all_arrays,
              "Read every array that has the same shape as the first one. A vector is read as its "
              "magnitude")
        .group(reading);
    command
        .option(
            "--component COMPONENT", read.component,
            "Component of a vector array: its number from 0, or `magnitude`. Or a field that is "
            "computed: the length of the `gradient` of a scalar, the length of the `vorticity` "
            "of a vector, or the `q-criterion` of a vector")
        .group(reading);
    command
        .flag("--allow-surplus", read.allow_surplus,
              "Accept files that hold more data than their header says")
        .group(reading);
    command
        .flag("--extra-axis-is-time", read.extra_axis_is_time,
              "Read the fourth axis, which is not x, y or z, as time, whatever the file says of it")
        .group(reading);
    command
        .option("--member NUMBER", read.member,
                "Number of the ensemble member to read, from 0, where files hold several members")
        .group(reading);
    command
        .option("--resample NX NY NZ", arguments.resample,
                "Interpolate a rectilinear, curvilinear or unstructured grid onto a regular grid "
                "with this many vertices along x, y and z")
        .between(2u, 65537u)
        .group(reading);
    command
        .flag("--resample-by-cell", arguments.resample_by_cell,
              "Interpolate like --resample, onto vertices that are as far apart as the smallest "
              "cell is long")
        .group(reading);
    command
        .flag("--times-from-names", read.times_from_names,
              "Take the time of a step from the name of its file or folder: from the last number "
              "that differs between the names (30 in t_0030.vti, 0.25 in 0.25/p.vti), or from the "
              "date (2020-01-02, 20200102T0600)")
        .group(reading);
    command
        .option("--dates ORDER", arguments.dates,
                "Order of day and month in dates whose year is last, in names and in files: "
                "01-02-2020 is the first of February (dmy) or January 2 (mdy)")
        .one_of({std::string(word_of(index::DayMonth::day_first)),
                 std::string(word_of(index::DayMonth::month_first))})
        .group("Reading");
    command
        .flag("--keep-first", read.keep_first,
              "Read the first of several steps that have the same time, as a restarted simulation "
              "leaves them. Without this option the last one is read")
        .group(reading);
    command
        .option(
            "--crop X0:X1,Y0:Y1,Z0:Z1", arguments.crop,
            "Read a part of the grid: the numbers of its first and last vertex along each axis, "
            "from 0")
        .group(reading);
    command
        .option(
            "--stride COUNT[,COUNT,COUNT]", arguments.stride,
            "Read every second vertex (2), or every Nth, along all axes; 2,2,1 says it for each "
            "axis")
        .group(reading);
    command
        .option("--steps FIRST:LAST[:STRIDE]", arguments.steps,
                "Read some of the steps, numbered from 0: `7`, `0:63` for 0 to 63, or `0:63:4` for "
                "every fourth of them")
        .group(reading);
    command
        .option("--spacing SX SY SZ", arguments.spacing,
                "Distance between vertices along each axis, in the unit of length (default: from "
                "the files, or 1 1 1)")
        .positive()
        .group(reading);
    command
        .option("--origin OX OY OZ", arguments.origin,
                "Position of the first vertex, in the unit of length (default: from the files, or "
                "0 0 0)")
        .group(reading);
    command
        .option(
            "--time-step TIME", read.time_step,
            "Time from one step to the next, in the unit of time (default: from the files, or 1)")
        .positive()
        .group(reading);
    for (auto& [name, unit, help] :
         {std::tuple<const char*, std::optional<std::string>&, const char*>{
              "--length-unit UNIT", read.length_unit,
              "Unit of positions and distances, such as mm"},
          {"--time-unit UNIT", read.time_unit, "Unit of times, such as s"},
          {"--value-unit UNIT", read.value_unit, "Unit of the values, such as K"}})
        command.option(name, unit, help).group(reading);
    command
        .option("--allow FOLDER", arguments.allowed,
                "Folder whose files may be read where a given file names them, as links of HDF5, "
                "XDMF and .pvd do. Without this option, only files beside the given one are read. "
                "May be given several times")
        .repeatable()
        .existing_folder()
        .group(reading);
    command
        .option("--patience SECONDS", arguments.patience,
                "Give up a file whose reader has done nothing for this long; each megabyte of the "
                "file adds a second, and waiting for a local disk does not count")
        .between(1.0, 86400.0)
        .shows_default()
        .group(reading);

    const char* colors = "Colors";
    const Option color = command
                             .option("--color-by,--color NAME", arguments.color,
                                     "A second array, whose values color the surfaces")
                             .group(colors);
    command
        .option("--color-component COMPONENT", arguments.color_component,
                "Component of the second array, as for --component")
        .needs(color)
        .group(colors);
    command.option("--color-unit UNIT", arguments.color_unit, "Unit of the second array's values")
        .needs(color)
        .group(colors);

    const char* raw = "Raw files without a header";
    command
        .option("--dims NX NY NZ", arguments.dims,
                "Number of vertices along x, y and z; x varies fastest")
        .between(2u, 65537u)
        .group(raw);
    command
        .option("--type TYPE", arguments.type,
                "Type of the values in raw files. Other files are converted to this type, so that "
                "files of several types make one series")
        .one_of({"i8", "u8", "i16", "u16", "i32", "f32", "f64"})
        .group(raw);
    command
        .flag("--big-endian", read.big_endian, "The values are big-endian (default: little-endian)")
        .group(raw);
    command
        .option("--header-bytes COUNT", read.header_bytes,
                "Number of bytes at the beginning of each file that are skipped")
        .shows_default()
        .group(raw);
}

std::pair<Option, Option> add_index_options(Command& command, BuildArguments& arguments) {
    const char* index_group = "Index";
    command
        .option("--tiers LIST", arguments.tiers,
                "Search structures to build: bricks, tree (the tree of the paper), bricks,tree, or "
                "none (default: bricks)")
        .group(index_group);
    command
        .option("--codec CODEC", arguments.codec,
                "Compression of the values (default: what suits each chunk best)")
        .one_of({"none", "lz4", "zstd"})
        .group(index_group);
    command
        .flag("--append", arguments.append,
              "Add to the index the steps that it does not hold yet. FILE... are the files of all "
              "steps, beginning with those that the index holds. Options that are not given "
              "are those that the index was built with")
        .group(index_group);
    command
        .flag("--refer", arguments.refer,
              "Leave the values in the files: the index holds references to them instead of a copy")
        .group(index_group);
    command
        .option("--threads COUNT", arguments.build.threads,
                "Number of threads that build; 0 takes one for each processor")
        .between(0u, 1024u)
        .group(index_group);
    const Option lattice =
        command
            .option("--lattice COUNT", arguments.build.tree.lattice,
                    "Also build the tree of the paper, with a lattice of this many elements along "
                    "each side (the paper's SpanSpaceSize)")
            .between(1u, 4096u)
            .shows_default()
            .group(index_group);
    const Option variation =
        command
            .option("--max-variation COUNT", arguments.build.tree.max_variation,
                    "Also build the tree of the paper; it stores a cell once for a span of time in "
                    "which the cell lies in at most this many lattice elements")
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
