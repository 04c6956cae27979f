// Vectors whose components are arrays of their own: `u,v,w`.
#pragma once

#include "index/volume/volume_series.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace isochron::index {

/// The two or three names in `u,v,w`; empty for any other text.
std::vector<std::string> names_in_list(const std::string& array);

/// Opens the arrays that are a vector's components along x, y and z. On a staggered grid a
/// component has one vertex more along an axis than the others. Neighbors along it are averaged,
/// which gives values where the other components lie.
/// @param open an array by its name @throws Error when their shapes or times differ otherwise
std::vector<std::unique_ptr<VolumeSeries>>
open_components(const std::vector<std::string>& names,
                const std::function<std::unique_ptr<VolumeSeries>(const std::string&)>& open);

} // namespace isochron::index
