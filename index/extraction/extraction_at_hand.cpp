// Decides by the tables of chunks how much stays.
#include "index/extraction/extraction_at_hand.h"

#include "index/file/color_source.h"
#include "index/volume/cell_walk.h"

#include <algorithm>
#include <bit>

namespace isochron::index {
namespace {

/// Where less than this share of the cells stays, all are found anew: that takes no longer.
constexpr double kLeastKept = 0.25;
/// Where such a share of the chunks stays, enough of their cells do: they need not be counted.
constexpr double kPlenty = 0.75;

/// Where less than this share of the cells stays with all around them, the mesh of a step that lies in
/// memory as a whole, without colors, is made anew: that takes no longer.
constexpr double kLeastInner = 0.5;

/// After so many looks at a step with other isovalues it is decoded as a whole, where it may be: by
/// chunks, a look takes about a millisecond more, and decoding takes some tens of them.
constexpr unsigned kManyLooks = 16;

/// As the worker compares queries: a NaN equals itself.
bool same(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

} // namespace

void ExtractionAtHand::set(const ExtractionPtr& made, bool same_colors) {
    if (made->coarse())
        return;
    from_ = made;
    same_colors_ = same_colors;
}

bool ExtractionAtHand::may_keep(const SurfacesQuery& query) const {
    if (!free_ || !from_ || from_->query.array != query.array || has_wide_ids(file_->info().grid) ||
        from_->query.instant.step >= file_->info().steps())
        return false;
    if (from_->query.instant.between() ||
        query.instant.between()) // tables say what stays at a step
        return false;
    return from_->query.instant == query.instant ||
           (file_->has_since() && file_->plan().tiers.has(Tier::bricks));
}

void ExtractionAtHand::begin(const SurfacesQuery& query) {
    query_ = query;
    finds_anew_ = false;
    staying_.reset();
    step_.reset();
    mesh_.reset();
    staying_colors_.reset();
    places_.assign(query.isovalues.size(), {});
    colored_.assign(query.isovalues.size(), {});
    if (!may_keep(query))
        return;
    looks_ = from_->query.instant == query.instant ? looks_ + 1 : 0;
    step_.emplace(looks_ > kManyLooks ? step_of(*file_, query.instant)
                                      : part_of_step(*file_, query.instant));
    const double share = from_->query.instant == query.instant
                             ? 1.0
                             : staying_share(*step_, from_->query.instant, query.isovalues);
    if (share < kLeastKept)
        return;
    // Ids alone are found in a step in memory sooner than they are joined with those that stay.
    if (shading_ == Shading::none && query.coloring != CellColoring::value && !step_->by_chunks() &&
        share < kPlenty)
        finds_anew_ = true;
    staying_.emplace(*step_, from_->query.instant, shading_ != Shading::none);
    if (finds_anew_ || enough_stays(share))
        look_at_colors();
    else
        staying_.reset();
}

/// Finds out where the colors at hand stay, if they are those that are asked for.
void ExtractionAtHand::look_at_colors() {
    const SurfacesQuery& earlier = from_->query;
    if (!same_colors_ || query_.coloring != CellColoring::value ||
        earlier.coloring != query_.coloring || earlier.colors != query_.colors ||
        query_.colors >= ColorSource::count(*file_))
        return;
    if (const ChunkStore* const chunks = ColorSource(*file_, query_.colors).chunks())
        staying_colors_.emplace(StepView(*chunks, query_.instant), earlier.instant, false);
}

/// Whether enough of the cells at hand stays. @param chunks share of the chunks that stay
bool ExtractionAtHand::enough_stays(double chunks) const {
    if (chunks >= kPlenty)
        return true;
    double all = 0, kept = 0;
    for (const CellSet& surface : from_->surfaces) {
        const auto count = static_cast<double>(surface.ids.size());
        all += count;
        kept += count * share_kept(file_->info().grid, surface.ids, *staying_);
    }
    return kept >= kLeastKept * all;
}

bool ExtractionAtHand::keeps_cells(std::size_t surface) const {
    return staying_ && !finds_anew_ && surface < from_->surfaces.size() &&
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
    if (from_->query.instant != query_.instant) {
        if (!step_->by_chunks())
            step_->whole(stop); // before there are several threads
        if (!layers_.search_others(*step_, others, *staying_, shading_ != Shading::none, stop))
            return false;
    }
    mesh_ = meshed ? earlier.mesh : nullptr;
    found_ = surface;
    change = join_cells(file_->info().grid, earlier, *staying_, others, set,
                        mesh_ || staying_colors_ ? &places_[surface] : nullptr,
                        mesh_ ? &inner_ : nullptr);
    if (staying_colors_)
        keep_colors(surface, set);
    if (mesh_ && !pays(set.ids.size()))
        mesh_.reset();
    if (mesh_)
        cells_ = cells_of(*mesh_);
    set.search_time = std::chrono::steady_clock::now() - started;
    return !stop.stop_requested();
}

/// Whether the mesh at hand saves time. @param cells of the surface that was found
bool ExtractionAtHand::pays(std::size_t cells) const {
    if (step_->by_chunks() || staying_colors_)
        return true;
    const auto inner = static_cast<std::size_t>(std::ranges::count(inner_, 1));
    return static_cast<double>(inner) >= kLeastInner * static_cast<double>(cells);
}

/// Notes which of a surface's staying cells also keep their colors.
void ExtractionAtHand::keep_colors(std::size_t surface, const CellSet& set) {
    std::vector<std::uint32_t>& places = colored_[surface] = places_[surface];
    CellWalk walk(file_->info().grid);
    for (std::size_t i = 0; i < places.size(); ++i) {
        walk.to(set.ids[i]);
        if (!staying_colors_->has_cell(walk.x(), walk.y(), walk.z()))
            places[i] = EarlierMesh::kNone;
    }
}

EarlierMesh ExtractionAtHand::mesh() const {
    if (!mesh_)
        return {};
    EarlierMesh mesh{mesh_.get(), &cells_, places_[found_], inner_};
    if (staying_colors_ && mesh_->colors.size() == mesh_->vertices.size())
        mesh.colored = colored_[found_];
    return mesh;
}

KnownColors ExtractionAtHand::colors() const {
    if (!staying_colors_ || from_->colors.size() != from_->cells())
        return {};
    KnownColors known{from_->colors, from_->corner_colors};
    std::size_t first = 0;
    for (std::size_t i = 0; i < from_->surfaces.size(); ++i) {
        if (i < colored_.size())
            known.surfaces.push_back({colored_[i], first});
        first += from_->surfaces[i].ids.size();
    }
    return known;
}

const SurroundingField* ExtractionAtHand::surroundings() const {
    const bool same_isovalues =
        staying_ && std::ranges::equal(from_->query.isovalues, query_.isovalues, same);
    return same_isovalues && !from_->surroundings.shares.empty() ? &from_->surroundings : nullptr;
}

KnownBlocks ExtractionAtHand::blocks(bool only_if_same_levels) const {
    if (!staying_ || (only_if_same_levels &&
                      !std::ranges::equal(from_->query.isovalues, query_.isovalues, same)))
        return {};
    return {&from_->blocks, &*staying_};
}

} // namespace isochron::index
