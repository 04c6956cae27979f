// Decides by the tables of chunks how much stays.
#include "index/extraction/extraction_at_hand.h"

#include <algorithm>
#include <bit>

namespace isochron::index {
namespace {

/// Where less than this share of the cells stays, all are found anew: that takes no longer.
constexpr double kLeastKept = 0.25;
/// Where such a share of the chunks stays, enough of their cells do: they need not be counted.
constexpr double kPlenty = 0.75;

/// As the worker compares queries: a NaN equals itself.
bool same(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

} // namespace

void ExtractionAtHand::set(const ExtractionPtr& made) {
    if (!made->coarse())
        from_ = made;
}

bool ExtractionAtHand::may_keep(const SurfacesQuery& query) const {
    if (!free_ || !from_ || from_->query.array != query.array || has_wide_ids(file_->info().grid) ||
        from_->query.step >= file_->info().steps())
        return false;
    return from_->query.step == query.step ||
           (file_->has_since() && file_->plan().tiers.has(Tier::bricks));
}

void ExtractionAtHand::begin(const SurfacesQuery& query, bool by_cells) {
    query_ = query;
    by_cells_ = by_cells && shading_ == Shading::none;
    staying_.reset();
    step_.reset();
    mesh_.reset();
    if (!may_keep(query))
        return;
    step_.emplace(part_of_step(*file_, query.step));
    const double share = from_->query.step == query.step
                             ? 1.0
                             : staying_share(*step_, from_->query.step, query.isovalues);
    if (share < kLeastKept)
        return;
    staying_.emplace(*step_, from_->query.step, shading_ != Shading::none);
    if (!enough_stays(share))
        staying_.reset();
}

/// Of the cells at hand. @param chunks share of the chunks that stay
bool ExtractionAtHand::enough_stays(double chunks) const {
    if (chunks >= kPlenty)
        return true;
    std::size_t all = 0, kept = 0;
    for (std::size_t i = 0; i < from_->surfaces.size(); ++i) {
        const std::vector<CellId>& ids = from_->surfaces[i].ids;
        all += ids.size();
        kept += count_kept(file_->info().grid, ids, *staying_);
    }
    return static_cast<double>(kept) >= kLeastKept * static_cast<double>(all);
}

bool ExtractionAtHand::keeps_cells(std::size_t surface) const {
    return staying_ && !by_cells_ && surface < from_->surfaces.size() &&
           same(from_->query.isovalues[surface], query_.isovalues[surface]);
}

bool ExtractionAtHand::find(std::size_t surface, bool meshed, const std::stop_token& stop,
                            CellSet& set, SurfaceChange& change) {
    const auto started = std::chrono::steady_clock::now();
    const CellSet& earlier = from_->surfaces[surface];
    set.query = query_.surface(surface);
    set.method = SearchMethod::bricks;
    CellSet others;
    others.query = set.query;
    if (from_->query.step != query_.step) {
        if (!step_->by_chunks())
            step_->whole(stop); // before there are several threads
        if (!layers_.search_others(*step_, others, *staying_, shading_ != Shading::none, stop))
            return false;
    }
    mesh_ = meshed ? earlier.mesh : nullptr;
    change =
        join_cells(file_->info().grid, earlier, *staying_, others, set, mesh_ ? &places_ : nullptr);
    if (mesh_)
        corners_ = corners_of_cells(*mesh_);
    set.search_time = std::chrono::steady_clock::now() - started;
    return !stop.stop_requested();
}

EarlierMesh ExtractionAtHand::mesh() const {
    return mesh_ ? EarlierMesh{mesh_.get(), corners_, places_} : EarlierMesh{};
}

KnownBlocks ExtractionAtHand::blocks(bool only_if_same_levels) const {
    if (!staying_ || (only_if_same_levels &&
                      !std::ranges::equal(from_->query.isovalues, query_.isovalues, same)))
        return {};
    return {&from_->blocks, &*staying_};
}

} // namespace isochron::index
