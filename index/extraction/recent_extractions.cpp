// Chooses the extractions to drop when there is no more room.
#include "index/extraction/recent_extractions.h"

#include <algorithm>
#include <bit>
#include <iterator>
#include <utility>

namespace isochron::index {
namespace {

constexpr std::size_t kFewest = 3; ///< shown, prefetched, and one for stepping back
constexpr std::size_t kMostKept = 1024;

template <class T>
std::uint64_t bytes_of(const std::vector<T>& values) {
    return values.size() * sizeof(T);
}

std::uint64_t bytes_of(const Extraction& extraction) {
    std::uint64_t bytes = sizeof extraction + bytes_of(extraction.colors) +
                          bytes_of(extraction.corner_colors) + bytes_of(extraction.blocks.ids) +
                          bytes_of(extraction.blocks.digests) + extraction.blocks.bytes() +
                          bytes_of(extraction.surroundings.shares);
    for (const SurfaceChange& change : extraction.change.surfaces)
        bytes += bytes_of(change.removed) + bytes_of(change.added);
    for (const CellSet& set : extraction.surfaces)
        bytes += bytes_of(set.ids) + bytes_of(set.points) + bytes_of(set.rows) +
                 (set.mesh ? bytes_of(*set.mesh) : 0);
    if (const SimplifiedMeshesPtr later = extraction.later->get())
        bytes += later->bytes();
    return bytes;
}

} // namespace

bool same_but_for_step(const SurfacesQuery& a, const SurfacesQuery& b) {
    return a.array == b.array && a.coloring == b.coloring && a.colors == b.colors &&
           a.detail == b.detail && a.pieces == b.pieces &&
           std::ranges::equal(a.isovalues, b.isovalues, {}, std::bit_cast<std::uint64_t, double>,
                              std::bit_cast<std::uint64_t, double>);
}

ExtractionPtr RecentExtractions::find(const SurfacesQuery& query) const {
    if (kept_.empty())
        return nullptr;
    const auto enough = [&](const Kept& kept) {
        return kept.extraction->query.mesh_room >= query.mesh_room;
    };
    if (same_but_for_step(kept_.front().extraction->query, query)) {
        const auto known = by_step_.find(query.instant.number());
        return known != by_step_.end() && enough(*known->second) ? known->second->extraction
                                                                 : nullptr;
    }
    // At most a few kept extractions are for other surfaces.
    std::size_t looked_at = 0;
    for (auto it = kept_.rbegin(); it != kept_.rend() && looked_at < kFewest; ++it, ++looked_at)
        if (it->extraction->query.instant == query.instant && enough(*it) &&
            same_but_for_step(it->extraction->query, query))
            return it->extraction;
    return nullptr;
}

std::optional<std::uint32_t> RecentExtractions::missing(const SurfacesQuery& query,
                                                        const StepsAhead& ahead) const {
    SurfacesQuery at = query;
    std::uint64_t bytes = 0;
    const std::uint32_t count = std::min<std::uint32_t>(ahead.count(), kMostKept - kFewest);
    for (std::uint32_t i = 0; i < count; ++i) {
        at.instant = Instant(ahead.at(i));
        if (const ExtractionPtr known = find(at))
            bytes += bytes_of(*known);
        else if (i == 0 || bytes + largest_ <= budget_)
            return at.instant.step;
        else
            return {};
    }
    return {};
}

std::vector<std::uint32_t> RecentExtractions::steps(const SurfacesQuery& query) const {
    std::vector<std::uint32_t> steps;
    if (!kept_.empty() && same_but_for_step(kept_.front().extraction->query, query))
        for (const auto& [number, place] : by_step_)
            if (const Instant at = place->extraction->query.instant; !at.between())
                steps.push_back(at.step);
    std::ranges::sort(steps);
    return steps;
}

void RecentExtractions::drop(Place place, Dropped& dropped) {
    bytes_ -= place->bytes;
    const auto known = by_step_.find(place->extraction->query.instant.number());
    if (known != by_step_.end() && known->second == place)
        by_step_.erase(known);
    dropped.push_back(std::move(place->extraction));
    kept_.erase(place);
}

/// The oldest extraction that is not ahead, except the newest; if all are ahead, the one that is
/// needed last.
RecentExtractions::Place RecentExtractions::victim(const std::optional<StepsAhead>& ahead) {
    const Place oldest = std::prev(kept_.end());
    if (!ahead || ahead->steps == 0)
        return oldest;
    // The steps ahead that are kept, up to the first that is not.
    std::vector<const Kept*> needed;
    Place last = oldest;
    for (std::uint32_t i = 0; i < ahead->count(); ++i) {
        const auto known = by_step_.find(Instant(ahead->at(i)).number());
        if (known == by_step_.end())
            break;
        last = known->second;
        needed.push_back(&*last);
    }
    std::ranges::sort(needed);
    for (Place place = oldest; place != kept_.begin(); --place)
        if (!std::ranges::binary_search(needed, &*place))
            return place;
    return last;
}

RecentExtractions::Dropped RecentExtractions::add(ExtractionPtr extraction,
                                                  const std::optional<StepsAhead>& ahead) {
    Dropped dropped;
    const std::uint64_t bytes = bytes_of(*extraction);
    if (!kept_.empty() && !same_but_for_step(kept_.front().extraction->query, extraction->query)) {
        by_step_.clear(); // others are hardly needed any more: only a few stay
        largest_ = 0;
        while (!kept_.empty() && (kept_.size() >= kFewest || bytes_ + bytes > budget_))
            drop(std::prev(kept_.end()), dropped);
    }
    if (const auto known = by_step_.find(extraction->query.instant.number());
        known != by_step_.end())
        drop(known->second, dropped);
    largest_ = std::max(largest_, bytes);
    bytes_ += bytes;
    kept_.push_front({std::move(extraction), bytes});
    by_step_[kept_.front().extraction->query.instant.number()] = kept_.begin();
    drop_to_fit(ahead, dropped);
    return dropped;
}

RecentExtractions::Dropped RecentExtractions::count_again(const ExtractionPtr& extraction,
                                                          const std::optional<StepsAhead>& ahead) {
    Dropped dropped;
    for (Kept& kept : kept_)
        if (kept.extraction == extraction) {
            bytes_ -= kept.bytes;
            kept.bytes = bytes_of(*extraction);
            bytes_ += kept.bytes;
        }
    drop_to_fit(ahead, dropped);
    return dropped;
}

void RecentExtractions::drop_to_fit(const std::optional<StepsAhead>& ahead, Dropped& dropped) {
    while (kept_.size() > kFewest && (bytes_ > budget_ || kept_.size() > kMostKept))
        drop(victim(ahead), dropped);
}

RecentExtractions::Dropped RecentExtractions::take_all() {
    Dropped dropped;
    while (!kept_.empty())
        drop(kept_.begin(), dropped);
    largest_ = 0;
    return dropped;
}

} // namespace isochron::index
