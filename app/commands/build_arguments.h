// What a user asked `isochron build` for, as options of the floor below.
#pragma once

#include "app/commands/subcommands.h"
#include "index/build/index_build.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

struct BuildArguments {
    std::vector<std::string> files;
    std::filesystem::path out;
    index::ReadOptions read;
    std::string type;
    std::vector<std::uint32_t> dims, resample;
    std::vector<double> spacing, origin;
    index::BuildOptions build;
    std::string tiers, codec;
    std::optional<std::string> color, color_component, color_unit;
    bool quiet = false, append = false, refer = false;
    double timeout = 30; ///< [s]
};

/// `run.h5:/fields/rho` as run.h5 with `--array /fields/rho`. @throws UsageError for both
BuildArguments with_path_within(BuildArguments arguments);

index::ReadOptions read_options(const BuildArguments& arguments);
/// Of the second array: the same files, and all that was said of them, but another array.
index::ReadOptions color_options(const BuildArguments& arguments);
/// `bricks,cells`; `none` for an index that only scans. @throws UsageError
index::TierSet tiers_of(const std::string& list);
/// The files as the index will look for them: from its own folder.
index::Referral referral_to(const std::vector<std::filesystem::path>& files,
                            const BuildArguments& arguments);

/// What was asked for; an index that is appended to stays what it is in all that was not.
BuildArguments with_held(BuildArguments arguments, const index::IndexFile& held);
/// Why an index cannot grow in place; empty when it can.
std::string reason_to_rewrite(const index::IndexFile& held, const index::BuildOptions& options);

/// The options that say how files are to be read.
void add_reading_options(Command& command, BuildArguments& arguments);

} // namespace isochron::app
