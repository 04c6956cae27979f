// The values along a ruler.
#include "index/extraction/profile.h"

#include "index/extraction/value_in_index.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace isochron::index {

Profile profile_of(const ProfileQuery& query, const std::stop_token& stop) {
    Profile profile{.query = query, .distances = {}, .values = {}, .at = {}};
    std::vector<double> ends{0.0}; // way to each place
    for (std::size_t i = 1; i < query.places.size(); ++i)
        ends.push_back(ends.back() + glm::distance(query.places[i - 1], query.places[i]));
    if (!(ends.back() > 0))
        return profile;
    for (std::size_t sample = 0, leg = 1; sample < kProfileSamples; ++sample) {
        const double way = ends.back() * static_cast<double>(sample) / (kProfileSamples - 1);
        while (leg + 1 < ends.size() && way > ends[leg])
            ++leg;
        const double length = ends[leg] - ends[leg - 1];
        const double share =
            length > 0 ? std::clamp((way - ends[leg - 1]) / length, 0.0, 1.0) : 0.0;
        profile.distances.push_back(way);
        profile.at.push_back(glm::mix(query.places[leg - 1], query.places[leg], share));
    }
    profile.values = values_in(*query.array, query.instant, profile.at, stop);
    return profile;
}

std::vector<double> rows_of(const Profile& profile) {
    std::vector<double> rows;
    for (std::size_t i = 0; i < profile.values.size(); ++i) {
        const glm::dvec3& at = profile.at[i];
        rows.insert(rows.end(), {profile.distances[i], at.x, at.y, at.z, profile.values[i]});
    }
    return rows;
}

std::string csv_of(const Profile& profile) {
    std::string text = "distance,x,y,z,value\n";
    for (std::size_t i = 0; i < profile.values.size(); ++i) {
        const glm::dvec3& at = profile.at[i];
        text += fmt::format("{},{},{},{},", profile.distances[i], at.x, at.y, at.z);
        if (std::isfinite(profile.values[i]))
            text += fmt::format("{}", profile.values[i]);
        text += '\n';
    }
    return text;
}

} // namespace isochron::index
