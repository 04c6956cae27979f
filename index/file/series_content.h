// What every series keeps to, and the hash that tells its data from others.
#pragma once

#include "index/volume/volume_series.h"

#include <cstdint>
#include <span>

namespace isochron::index {

/// What every series must keep to: 2 to 65,537 vertices along each axis, fewer than 2^32 cells in 19 layers and
/// steps, a finite geometry with positive spacing and a regular direction, finite increasing times,
/// a slope that is not 0. @throws Error
void check_limits(const SeriesInfo& info);

/// The hash of the first steps of a series, of everything that decides what a query answers.
/// @param checksums of the stored values of these steps
std::uint64_t content_hash_of(const SeriesInfo& info, std::span<const std::uint64_t> checksums);

} // namespace isochron::index
