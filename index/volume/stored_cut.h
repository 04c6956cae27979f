// The stored value at which an isovalue divides the values of a type.
#pragma once

#include "index/volume/value_type.h"

#include <cstdint>
#include <optional>

namespace isochron::index {

/// The ordinal (ordinal.h) of the smallest stored value with `scaled >= isovalue`; if the slope is
/// negative, of the smallest with `scaled < isovalue`. None if all values of the type are on one
/// side, or the isovalue is not finite. It divides the vertices into the two sides of the
/// isosurface. A cell is active if and only if it has vertices on both, so it does not matter which
/// side is the upper one.
std::optional<std::uint64_t> stored_cut(ValueType type, const Scaling& scaling, double isovalue);

} // namespace isochron::index
