// The metadata section of an .isochron file, as JSON.
#pragma once

#include "index/file/chunks/chunk_codec.h"
#include "index/file/sections/blend_quality.h"
#include "index/file/sections/file_layout.h"
#include "index/file/sections/index_contents.h"
#include "index/file/sections/series_content.h"
#include "index/volume/tree_options.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::index {

/// Most arrays that one index may have, the first included.
constexpr std::size_t kMostArrays = 64;

/// Where a further array of an index lies: its sections, as in FileHeader. It has a whole set of
/// them, with metadata of its own; offsets count from the start of the file.
struct ArrayPlace {
    std::uint64_t content_hash = 0;
    std::array<Section, kSectionNames.size()> sections{};
};

/// The metadata section. It holds no sizes of `stats`: those follow from the header.
struct Metadata {
    SeriesInfo info = {};
    IndexStats stats = {};
    ChosenTiers plan = {};
    Codec codec = Codec::fitting; ///< with which values were packed
    /// Content hashes of the states from which the index has grown, oldest first.
    std::vector<std::uint64_t> earlier = {};
    ThiOptions tree = {};
    std::optional<Referral> referral = {};
    std::optional<ColorArray> color = {};
    /// The options that select the array in the files: `ReadOptions::array` and `component`.
    std::optional<std::string> chosen_array = {}, chosen_component = {};
    /// How the files were read, as far as the user said; without array and component. Indexes of
    /// older programs have none.
    std::optional<ReadOptions> reading = {};
    /// The `kReading` of the program that read the files.
    std::uint32_t reading_number = kReading;
    /// What blends between steps are worth; none where that was not measured.
    std::optional<BlendQuality> blends = {};
    /// The arrays of the index besides this one; only the first array lists them.
    std::vector<ArrayPlace> further = {};
};

/// Sets the counts of a series' values, and range and histogram, which follow from them.
void set_counts(Metadata& metadata, ValueCounts counts);

/// Equal metadata give equal text: keys are sorted, numbers round-trip.
std::string to_json(const Metadata& metadata);

/// @throws Error when it is not JSON, nests too deeply, lacks a key or holds an impossible value
///         (see `check_limits`)
Metadata metadata_from_json(std::string_view text);

/// Bytes from one step to the next where unpacked steps lie in a row.
constexpr std::size_t step_stride(std::size_t step_bytes) {
    return (step_bytes + 63) / 64 * 64;
}

} // namespace isochron::index
