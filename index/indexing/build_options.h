// What a build is told besides the series.
#pragma once

#include "index/file/chunks/chunk_codec.h"
#include "index/file/sections/index_contents.h"
#include "index/file/sections/tiers.h"
#include "index/volume/tree_options.h"
#include "index/volume/volume_series.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace isochron::index {

/// An array of an index besides its first.
struct FurtherArray {
    VolumeSeries* series = nullptr; ///< a series of the same files; outlives the build
    /// The options that select it in the files.
    std::optional<std::string> array = {}, component = {};
    std::optional<ChosenTiers> plan = {}; ///< as BuildOptions::plan
};

struct BuildOptions {
    std::optional<TierSet> tiers = {}; ///< none: bricks
    /// The plan of an index that is written anew: kept, instead of `tiers`.
    std::optional<ChosenTiers> plan = {};
    bool with_tree = false; ///< add the tree
    ThiOptions tree = {};
    unsigned threads = 0; ///< 0: one for each processor
    /// Most bytes that wait in memory to be packed: planes of a level of detail, and of steps whose
    /// values have more than 8 bits. More of them wait in a file.
    std::uint64_t waiting_bytes = 64 << 20;
    Codec codec = Codec::fitting;
    /// If set, the file refers to these files instead of carrying a copy of the values.
    std::optional<Referral> referral = {};
    /// The array to color by: another array of the same files; null: none. Outlives the build.
    VolumeSeries* color = nullptr;
    /// The options that select it in the files, for an index that refers to them.
    std::optional<std::string> color_array = {}, color_component = {};
    /// The options that select the volume itself.
    std::optional<std::string> array = {}, component = {};
    /// How the files are read, for steps that are appended later; without array and component.
    std::optional<ReadOptions> reading = {};
    bool replaces_any = false; ///< also a file that is no index
    /// Measure what blends between the steps are worth. Without it the index does not say, as those of
    /// older programs do not; benchmarks compare the times.
    bool measures_blends = true;
    /// Further arrays, each with its own levels and tiers; fewer than kMostArrays.
    std::vector<FurtherArray> further = {};
};

} // namespace isochron::index
