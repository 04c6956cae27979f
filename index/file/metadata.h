// What an .isochron file knows about its volume, as JSON.
#pragma once

#include "index/file/chunk_codec.h"
#include "index/file/index_contents.h"
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
    std::optional<LevelMap> levels = {}; ///< always set once the values are known
    ThiOptions tree = {};
    std::optional<Referral> referral = {};
    std::optional<ColorArray> color = {};
};

/// Same metadata, same text: keys are sorted, numbers round-trip.
std::string to_json(const Metadata& metadata);

/// @throws Error when it is not JSON, nests too deeply, lacks a key or holds an impossible value
///         (see `check_limits`)
Metadata metadata_from_json(std::string_view text);

/// What every series must keep to: 2 to 65,537 vertices along each axis, fewer than 2^32 cells and
/// steps, a finite geometry with positive spacing and a regular direction, finite increasing times,
/// a slope that is not 0. @throws Error
void check_limits(const SeriesInfo& info);

/// Bytes from one step to the next in the volume section.
constexpr std::size_t step_stride(std::size_t step_bytes) {
    return (step_bytes + 63) / 64 * 64;
}

} // namespace isochron::index
