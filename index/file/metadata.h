// What an .isochron file knows about its volume, as JSON.
#pragma once

#include "index/file/chunk_codec.h"
#include "index/file/index_contents.h"
#include "index/file/series_content.h"
#include "index/thi/thi_tree.h"
#include "index/volume/level_map.h"

#include <string>
#include <string_view>

namespace isochron::index {

/// The metadata section. `stats` has no sizes here: those follow from the section table.
struct Metadata {
    SeriesInfo info = {};
    IndexStats stats = {};
    TierPlan plan = {};
    Codec codec = Codec::fitting;        ///< that values were packed with
    std::optional<LevelMap> levels = {}; ///< of the cells, where there are any
    std::uint32_t cell_steps = 0;        ///< first steps that the cells hold
    /// Content hashes of the states that the index has grown from, the first one first.
    std::vector<std::uint64_t> earlier = {};
    ThiOptions tree = {};
    std::optional<Referral> referral = {};
    std::optional<ColorArray> color = {};
    /// What picks the array in the files: `ReadOptions::array` and `component`.
    std::optional<std::string> chosen_array = {}, chosen_component = {};
};

/// Sets what follows from the counts of a series' values.
void set_counts(Metadata& metadata, ValueCounts counts);

/// Same metadata, same text: keys are sorted, numbers round-trip.
std::string to_json(const Metadata& metadata);

/// @throws Error when it is not JSON, nests too deeply, lacks a key or holds an impossible value
///         (see `check_limits`)
Metadata metadata_from_json(std::string_view text);

/// Bytes from one step to the next where values lie as they are.
constexpr std::size_t step_stride(std::size_t step_bytes) {
    return (step_bytes + 63) / 64 * 64;
}

} // namespace isochron::index
