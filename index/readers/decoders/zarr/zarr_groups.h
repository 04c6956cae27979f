// What the groups of a Zarr hierarchy say: their attributes, their arrays, images of OME-Zarr.
#pragma once

#include "index/readers/decoders/zarr/zarr_store.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace isochron::index {

/// @param group empty: the root @throws Error naming the store: no JSON object
nlohmann::json attributes_of_group(const ZarrStore& store, const std::string& group);

/// What describes the image in the attributes of OME-Zarr; null: none.
nlohmann::json multiscale_of(const nlohmann::json& attributes);

/// What describes an array as a level of an image.
struct ZarrLevel {
    nlohmann::json attributes;     ///< attributes of the image's group, or of the root
    nlohmann::json image, dataset; ///< null: the array is of no image
};

/// Asks the groups around an array, from the nearest on: `1` and the root for `1/0`.
ZarrLevel level_of(const ZarrStore& store, const std::string& array);

/// Adds the paths of the arrays below a group, at most 20,000.
/// @param depth of the group
void find_arrays(const ZarrStore& store, const std::string& group, int depth,
                 std::vector<std::string>& paths);

/// `um` for `micrometer`; other units as they are.
std::string tidy_unit_of_ome(const std::string& unit);

} // namespace isochron::index
