// The values along a ruler.
#pragma once

#include "index/file/index_file.h"
#include "index/volume/instant.h"

#include <glm/vec3.hpp>

#include <memory>
#include <stop_token>
#include <string>
#include <vector>

namespace isochron::index {

/// Where values are asked for: at an instant of an array, along straight lines from place to place.
struct ProfileQuery {
    std::shared_ptr<const IndexFile> array;
    Instant instant;
    std::vector<glm::dvec3> places; ///< physical space, two or more
    bool operator==(const ProfileQuery&) const = default;
};

/// Immutable once it is shared. All three lists have the same number of samples.
struct Profile {
    ProfileQuery query;
    std::vector<double> distances; ///< way from the first place, in the unit of lengths, ascending
    std::vector<double> values;    ///< NaN outside the data and where they miss a value
    std::vector<glm::dvec3> at;    ///< physical space
};
using ProfilePtr = std::shared_ptr<const Profile>;

inline constexpr std::size_t kProfileSamples = 513;

/// kProfileSamples, equally far from each other; without any if all places are one.
/// @throws Error when data cannot be read or are damaged
/// @throws Stopped when it is asked to stop
Profile profile_of(const ProfileQuery& query, const std::stop_token& stop = {});

/// Five numbers for each sample: its distance, x, y, z and value.
std::vector<double> rows_of(const Profile& profile);

/// A table: `distance,x,y,z,value`, a row for each sample; nothing for a value that is not there.
std::string csv_of(const Profile& profile);

} // namespace isochron::index
