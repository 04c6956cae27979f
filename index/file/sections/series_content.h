// The limits of every series, and the hash that identifies its data.
#pragma once

#include "index/volume/volume_series.h"

#include <cstdint>
#include <span>

namespace isochron::index {

/// Checks the limits: 2 to 65,537 vertices along each axis, fewer than 2^32 cells in 19 layers of
/// cells, 1 to 2^32 - 2 steps, a finite geometry with positive spacing and a regular direction,
/// finite increasing times, a finite scaling with a slope that is not 0. @throws Error
void check_limits(const SeriesInfo& info);

/// The hash of the first steps of a series: of everything that determines the answers to queries.
/// @param checksums of the stored values of these steps, one for each
std::uint64_t content_hash_of(const SeriesInfo& info, std::span<const std::uint64_t> checksums);

} // namespace isochron::index
