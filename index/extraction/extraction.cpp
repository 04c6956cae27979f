// Sums over the surfaces of an extraction.
#include "index/extraction/extraction.h"

#include <algorithm>
#include <numeric>

namespace isochron::index {
namespace {

template <class Sum, class Of>
Sum sum_of(const std::vector<CellSet>& surfaces, Of&& of) {
    return std::transform_reduce(surfaces.begin(), surfaces.end(), Sum{}, std::plus{}, of);
}

} // namespace

std::size_t Extraction::cells() const {
    return sum_of<std::size_t>(surfaces, [this](const CellSet& set) {
        return coarse() ? set.points.size() : set.ids.size();
    });
}
bool Extraction::shaded() const {
    return coarse() || std::ranges::all_of(surfaces, [](const CellSet& set) {
               return set.points.size() == set.ids.size();
           });
}
bool Extraction::meshed() const {
    return !coarse() && std::ranges::all_of(surfaces, [](const CellSet& set) {
        return set.mesh || set.ids.empty();
    });
}
std::vector<CellMeshPtr> Extraction::meshes(std::size_t level) const {
    if (level > 0 || !meshed()) {
        const SimplifiedMeshesPtr made = later->get();
        return made ? made->levels[level] : std::vector<CellMeshPtr>();
    }
    std::vector<CellMeshPtr> own;
    for (const CellSet& surface : surfaces)
        own.push_back(surface.mesh);
    return own;
}
std::size_t Extraction::triangles(std::size_t level) const {
    std::size_t count = 0;
    for (const CellMeshPtr& mesh : meshes(level))
        count += mesh ? mesh->triangles.size() / 3 : 0;
    return count;
}
std::uint64_t Extraction::candidates() const {
    return sum_of<std::uint64_t>(surfaces, [](const CellSet& set) { return set.candidates; });
}
std::uint64_t Extraction::reused() const {
    return sum_of<std::uint64_t>(surfaces, [](const CellSet& set) { return set.reused; });
}
std::chrono::nanoseconds Extraction::search_time() const {
    return sum_of<std::chrono::nanoseconds>(surfaces,
                                            [](const CellSet& set) { return set.search_time; });
}

} // namespace isochron::index
