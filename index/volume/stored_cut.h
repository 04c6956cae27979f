// Where an isovalue cuts the stored values of a type in two.
#pragma once

#include "index/volume/value_type.h"

#include <cstdint>
#include <optional>

namespace isochron::index {

/// Smallest stored value with `scaled >= isovalue` for a rising scaling, without it for a falling
/// one, as its ordinal (ordinal.h); none when the answer is the same for all values, and for an
/// isovalue that is not finite. It cuts the vertices into the two sides of the isosurface, and a
/// cell is active exactly when it has vertices on both: which side is the upper one does not
/// matter.
std::optional<std::uint64_t> stored_cut(ValueType type, const Scaling& scaling, double isovalue);

} // namespace isochron::index
