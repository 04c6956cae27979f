// The command line of `isochron build`, turned into the options of the index library.
#pragma once

#include "app/command_line/subcommands.h"
#include "index/indexing/index_build.h"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace isochron::app {

struct BuildArguments {
    std::vector<std::string> files;
    std::vector<std::filesystem::path> allowed; ///< folders that files may name, besides their own
    double patience = 60;                       ///< [s] in which a reader may do nothing
    std::filesystem::path out;
    index::ReadOptions read;
    std::string type, dates;
    std::vector<std::uint32_t> dims, resample;
    bool resample_by_cell = false; ///< by the size of the smallest cell
    std::vector<double> spacing, origin;
    std::optional<std::string> crop, stride, steps; ///< as given: `0:9,0:9,5:8`, `2,2,1`, `0:20:5`
    index::BuildOptions build;
    std::string tiers, codec;
    /// Arrays to read; the first is also `read.array`. A component may stand behind the name:
    /// `velocity.magnitude`.
    std::vector<std::string> arrays;
    bool all_arrays = false;
    std::optional<std::string> color, color_component, color_unit;
    bool append = false, refer = false;
    double timeout = 30; ///< [s]
};

/// Turns `run.h5:/fields/rho` into run.h5 with `--array /fields/rho`, and makes the first array the
/// one that is read.
/// @throws UsageError when `--array` is given as well, or when there are several arrays and an
///         option is for one only
BuildArguments with_path_within(BuildArguments arguments);

index::ReadOptions read_options(const BuildArguments& arguments);
/// Read options of the second array: the same files and options, but another array.
index::ReadOptions color_options(const BuildArguments& arguments);
/// Parses `bricks,tree`, or `none` for an index that only scans. Bricks stand for `cells` and `deltas`,
/// which earlier programs built. @throws UsageError
index::TierSet tiers_of(const std::string& list);
/// The line that says so; empty if the list has none of these two.
std::string former_tiers_note(const std::string& list);
/// The files as the index will refer to them: relative to its own folder.
index::Referral referral_to(const std::vector<std::filesystem::path>& files,
                            const BuildArguments& arguments);

/// The arguments, with all that the user left open taken from the index that is appended to.
BuildArguments with_held(BuildArguments arguments, const index::IndexFile& held);
/// Why an index cannot grow in place; empty if it can.
std::string reason_to_rewrite(const index::IndexFile& held, const index::BuildOptions& options);

/// Lets readers read the folders that the user allows, for as long as the user's patience lasts. To
/// be called before anything is read.
void set_up_readers(const BuildArguments& arguments);

/// Adds the options that say how files are read.
void add_reading_options(Command& command, BuildArguments& arguments);
/// Adds the options that say what the index holds. @return those of the paper's tree
std::pair<Option, Option> add_index_options(Command& command, BuildArguments& arguments);
/// The options that a program gives as words, without files and output.
/// @throws UsageError naming the option that is wrong
BuildArguments build_arguments_of(const std::vector<std::string>& words);

} // namespace isochron::app
