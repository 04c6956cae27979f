// Chooses levels of detail by counting cells, and puts cells of mixed levels together.
#include "index/detail/detail_search.h"

#include "index/detail/cell_thinning.h"
#include "index/detail/lost_cells.h"
#include "index/surface/cell_colors.h"
#include "index/surface/coarse_planes.h"

#include <algorithm>
#include <cmath>
#include <ranges>
#include <set>

namespace isochron::index {
namespace {

/// A surface has about four times as many cells on the next finer level.
constexpr int kBitsFiner = 2;
constexpr double kFiner = 1 << kBitsFiner;
/// Cells of a chunk that has some: a smooth surface through it has about 300.
constexpr double kLeastOfChunk = 64;
/// How many more cells than asked for are better than another search.
constexpr double kTolerated = 1.5;
/// Cells of the largest grid of which it is kept when they were first active: four bytes each.
constexpr std::uint64_t kMostCrossings = std::uint64_t{1} << 28;
/// Part of the cells asked for that those may be which levels have lost, however many are drawn.
constexpr std::uint64_t kPartOfLost = 4;

bool all_at(std::span<const std::uint8_t> levels, unsigned level) {
    return std::ranges::all_of(levels, [level](std::uint8_t l) { return l == level; });
}

/// A cell of a level's own grid at its place of mixed levels.
CellPoint centered(CellPoint point, unsigned level) {
    for (std::uint16_t* at : {&point.x, &point.y, &point.z})
        *at = static_cast<std::uint16_t>(doubled_center(*at, level));
    return point;
}

} // namespace

std::size_t DetailCells::cells() const {
    std::size_t cells = 0;
    for (const CellSet& set : surfaces)
        cells += set.points.size();
    return cells;
}

DetailSearch::DetailSearch(std::shared_ptr<const IndexFile> file)
    : file_(std::move(file)), regions_(file_->info().grid), by_place_(regions_.from_the_middle()),
      top_(static_cast<unsigned>(file_->detail_levels() - 1)),
      by_bricks_(file_->plan().tiers.has(Tier::bricks)), searchers_(top_ + 1) {}

LayerSearch& DetailSearch::searcher(unsigned level) {
    if (!searchers_[level])
        searchers_[level] = std::make_unique<LayerSearch>(file_);
    return *searchers_[level];
}

/// Finds the cells of one level in the step's own order. @return false when stopped
bool DetailSearch::search(const SurfacesQuery& query, unsigned level, const ChunkFilter& only,
                          LevelCells& found, const std::stop_token& stop) {
    found = {};
    for (std::size_t i = 0; i < query.isovalues.size(); ++i) {
        CellSet& set = found.surfaces.emplace_back();
        set.query = query.surface(i);
        set.method = by_bricks_ ? SearchMethod::bricks : SearchMethod::scan;
        if (std::isfinite(set.query.isovalue) &&
            !searcher(level).search(step(query.instant, level), set, by_bricks_, true, stop, only))
            return false;
        if (!color(set.query, level, set, found.colors.emplace_back(), stop))
            return false;
        if (level > 0)
            move_planes_out(set.points, file_->info().grid.spacing);
        found.cells += set.points.size();
    }
    if (level == 0) // its work space is the largest
        searchers_[0].reset();
    return true;
}

/// When the cells of a level were first active at that level. @return null when stopped
const FirstCrossings* DetailSearch::crossings(double isovalue, unsigned level,
                                              const std::stop_token& stop) {
    FirstCrossingsPtr& known = crossings_[{isovalue, level}];
    const Search search = [&](const Query& query, const std::stop_token& asked) {
        return asked.stop_requested()
                   ? nullptr
                   : std::make_shared<const CellSet>(search_level(file_, level, query));
    };
    const bool blended = coloring_ == CellColoring::first_blended_crossing;
    if (!known || known->blended() != blended)
        known =
            first_crossings(file_->chunks(level).info(), search, isovalue, stop,
                            blended ? crossings_between(file_, level, isovalue, stop) : nullptr);
    return known.get();
}

/// Gives every cell a color coordinate, kNoColor where the level has no colors.
bool DetailSearch::color(const Query& query, unsigned level, const CellSet& set,
                         std::vector<std::uint16_t>& colors, const std::stop_token& stop) {
    colors.assign(set.points.size(), kNoColor);
    if (by_first_crossing(coloring_)) {
        if (set.ids.empty() || file_->chunks(level).info().grid.cell_count() > kMostCrossings)
            return true;
        const FirstCrossings* const first = crossings(query.isovalue, level, stop);
        if (first)
            color_by_first_crossing(*first, file_->info().times, query.instant, set.ids, colors);
        return first != nullptr;
    }
    const ChunkStore* const store = source_ ? source_->chunks(level) : nullptr;
    if (!store || set.ids.empty())
        return true;
    return searcher(level).color_cells(step(query.instant, level), set, *source_, colors, stop);
}

/// Finds the whole levels, the coarsest first, until there are too many cells or the next level
/// will have too many. @return false when stopped
bool DetailSearch::count_down(const SurfacesQuery& query, const std::stop_token& stop) {
    known_.clear();
    const auto most = static_cast<double>(query.detail.most_cells);
    for (unsigned level = top_ + 1; level-- > 1;) {
        LevelCells& found = known_[level];
        if (!search(query, level, {}, found, stop))
            return false;
        counted_ = level;
        if (kFiner * static_cast<double>(found.cells) > most)
            break;
    }
    in_region_.assign(regions_.size(), 0);
    for (const CellSet& set : known_[counted_].surfaces)
        for (const CellPoint& point : set.points)
            ++in_region_[regions_.number({regions_.along(0, point.x, counted_),
                                          regions_.along(1, point.y, counted_),
                                          regions_.along(2, point.z, counted_)})];
    return true;
}

double DetailSearch::expected_cells(const Levels& levels) const {
    double cells = 0;
    for (std::size_t i = 0; i < levels.size(); ++i)
        cells += expected_cells(i, levels[i]);
    return cells;
}

/// In one region.
double DetailSearch::expected_cells(std::size_t region, unsigned level) const {
    return std::ldexp(static_cast<double>(in_region_[region]),
                      kBitsFiner * (static_cast<int>(counted_) - static_cast<int>(level))) *
           (level == 0 ? level_zero_ : 1.0);
}

/// What the chunks' ranges say: means may have lost much of a rough volume.
double DetailSearch::least_cells_of_volume(const SurfacesQuery& query) const {
    if (!by_bricks_)
        return 0;
    const StepView at = step(query.instant, 0);
    double chunks = 0;
    for (const double isovalue : query.isovalues) {
        const auto cut = at.cut(isovalue);
        for (std::uint32_t layer = 0; cut && layer < at.chunk_grid().layers(); ++layer)
            chunks +=
                static_cast<double>(LayerCandidates::places_of(*at.layer(layer), *cut).size());
    }
    return kLeastOfChunk * chunks;
}

DetailSearch::Levels DetailSearch::lifted(const SurfacesQuery& query, unsigned coarser,
                                          unsigned finest) const {
    Levels levels =
        regions_.levels(query.detail.wished, coarser, std::min(top_, regions_.coarsest()));
    for (std::uint8_t& level : levels)
        level = std::max(level, static_cast<std::uint8_t>(finest));
    return levels;
}

/// The finest levels that are expected to have not too many cells, and by how much the wishes were
/// made coarser: from `coarser` on. @return no levels if there are too many at the coarsest
std::pair<DetailSearch::Levels, unsigned>
DetailSearch::lifted_to_fit(const SurfacesQuery& query, unsigned coarser, unsigned finest) const {
    const auto most = static_cast<double>(query.detail.most_cells);
    const unsigned first = coarser, last = coarsest_lift(query);
    Levels levels = lifted(query, coarser, finest);
    double cells = expected_cells(levels);
    Levels finer;
    while (cells > most) {
        if (coarser >= last)
            return {{}, coarser};
        finer = std::exchange(levels, lifted(query, ++coarser, finest));
        cells = expected_cells(levels);
    }
    if (coarser == first)
        return {std::move(levels), coarser};
    for (const std::uint32_t region : by_place_) {
        if (finer[region] == levels[region])
            continue;
        cells += expected_cells(region, finer[region]) - expected_cells(region, levels[region]);
        if (cells > most)
            break;
        levels[region] = finer[region];
    }
    return {std::move(levels), coarser};
}

/// Parts of a level by which wishes can be made coarser until all regions are at the coarsest.
unsigned DetailSearch::coarsest_lift(const SurfacesQuery& query) const {
    const auto& wished = query.detail.wished;
    const int least = wished.empty() ? 0 : std::ranges::min(wished);
    return static_cast<unsigned>(
        std::max(DetailQuery::kPartsOfLevel * static_cast<int>(top_) - least, 0));
}

/// The chunks of a level in which it draws cells.
ChunkFilter DetailSearch::chunks_of(const Levels& levels, unsigned level) const {
    const ChunkGrid& grid = file_->chunks(level).grid();
    return
        [wanted = regions_.chunks_of(levels, level, grid),
         of_layer = std::size_t{grid.chunks_of_layer()}](std::uint32_t layer, std::uint32_t place) {
            return wanted[layer * of_layer + place];
        };
}

/// Adds the cells that a level draws.
void DetailSearch::append(const LevelCells& from, const Levels& levels, unsigned level,
                          DetailCells& result) {
    for (std::size_t i = 0; i < from.surfaces.size(); ++i) {
        const CellSet& set = from.surfaces[i];
        CellSet& to = result.surfaces[i];
        to.candidates += set.candidates;
        to.search_time += set.search_time;
        to.shading_time += set.shading_time;
        for (std::size_t n = 0; n < set.points.size(); ++n) {
            const CellPoint& point = set.points[n];
            if (!regions_.draws(levels, level, {point.x, point.y, point.z}))
                continue;
            to.points.push_back(centered(point, level));
            colors_[i].push_back(from.colors[i][n]);
        }
    }
}

/// @return false when stopped
bool DetailSearch::gather(const SurfacesQuery& query, const Levels& levels, DetailCells& result,
                          const std::stop_token& stop) {
    colors_.assign(query.isovalues.size(), {});
    result.surfaces.clear();
    for (std::size_t i = 0; i < query.isovalues.size(); ++i) {
        CellSet& set = result.surfaces.emplace_back();
        set.query = query.surface(i);
        set.method = by_bricks_ ? SearchMethod::bricks : SearchMethod::scan;
    }
    for (const unsigned level : std::set<unsigned>(levels.begin(), levels.end())) {
        if (const auto known = known_.find(level); known != known_.end()) {
            append(known->second, levels, level, result);
            continue;
        }
        LevelCells found;
        if (!search(query, level, by_bricks_ ? chunks_of(levels, level) : ChunkFilter(), found,
                    stop))
            return false;
        append(found, levels, level, result);
    }
    result.levels = levels;
    return true;
}

/// Adds what the levels have lost. @return false when stopped
bool DetailSearch::add_lost(const SurfacesQuery& query, unsigned finest, DetailCells& result,
                            const std::stop_token& stop) {
    if (!by_bricks_ || std::ranges::max(result.levels) <= finest)
        return true;
    LostCells lost(*file_, regions_, finest, searcher(finest));
    std::vector<CellSet> of_surface(query.isovalues.size());
    std::vector<std::vector<std::uint16_t>> colors(of_surface.size());
    std::uint64_t all = 0;
    for (std::size_t i = 0; i < of_surface.size(); ++i) {
        CellSet &set = result.surfaces[i], &found = of_surface[i];
        if (!std::isfinite(set.query.isovalue))
            continue;
        if (!lost.find(set.query, set.points, result.levels, found, stop) ||
            !color(set.query, finest, found, colors[i], stop))
            return false;
        all += found.points.size();
        set.candidates += found.candidates;
        set.search_time += found.search_time;
        set.shading_time += found.shading_time;
    }
    searchers_[finest].reset(); // its work space is the largest
    const std::uint64_t most = query.detail.most_cells, drawn = result.cells();
    const CellThinning thinning(all, std::max(most / kPartOfLost, most - std::min(most, drawn)));
    for (std::size_t i = 0; i < of_surface.size(); ++i)
        for (std::size_t n = 0; n < of_surface[i].points.size(); ++n) {
            const CellPoint& point = of_surface[i].points[n];
            if (!thinning.keeps({point.x, point.y, point.z}))
                continue;
            result.surfaces[i].points.push_back(centered(point, finest));
            colors_[i].push_back(colors[i][n]);
        }
    return true;
}

std::optional<std::uint64_t> DetailSearch::count(const SurfacesQuery& query,
                                                 const std::stop_token& stop) {
    if (file_->referral())
        return std::nullopt;
    std::uint64_t cells = 0;
    for (const double isovalue : query.isovalues) {
        if (!std::isfinite(isovalue))
            continue;
        const auto of_surface =
            searcher(0).count(step(query.instant, 0), {query.instant, isovalue}, by_bricks_, stop);
        if (!of_surface)
            return std::nullopt;
        cells += *of_surface;
    }
    searchers_[0].reset();
    return cells;
}

/// The finest level that has not too many cells as a whole, as far as is known.
unsigned DetailSearch::finest_that_fits(double most) const {
    unsigned finest = top_;
    for (const auto& [level, cells] : known_)
        if (static_cast<double>(cells.cells) <= most)
            finest = std::min(finest, level);
    return finest;
}

DetailSearch::Outcome DetailSearch::find(const SurfacesQuery& query,
                                         std::optional<std::uint64_t> volume_cells,
                                         DetailCells& result, const std::stop_token& stop) {
    const auto most = static_cast<double>(query.detail.most_cells);
    if (top_ == 0 || !has_mixed_levels(file_->info().grid) ||
        query.instant.step >= file_->info().steps())
        return Outcome::whole;
    coloring_ = query.coloring;
    source_.reset();
    if (coloring_ == CellColoring::value && query.colors < ColorSource::count(*file_))
        source_.emplace(*file_, query.colors);
    std::erase_if(crossings_, [&](const auto& known) {
        return !by_first_crossing(coloring_) || !known.second ||
               std::ranges::find(query.isovalues, known.first.first) == query.isovalues.end();
    });
    if (!count_down(query, stop))
        return Outcome::stopped;
    unsigned coarser = 0;
    level_zero_ = 1;
    if (const Levels levels = lifted(query, 0, 0); all_at(levels, 0)) {
        const double expected = expected_cells(levels);
        const double cells = volume_cells ? static_cast<double>(*volume_cells)
                                          : std::max(expected, least_cells_of_volume(query));
        if (cells <= most)
            return Outcome::whole;
        if (expected > 0)
            level_zero_ = cells / expected;
        else // nothing is known of where they are
            while (all_at(lifted(query, coarser, 0), 0) && coarser < coarsest_lift(query))
                ++coarser;
    }
    const unsigned finest = file_->referral() ? 1 : 0; // else there are no chunks of level 0
    for (bool last = false; !last;) {
        auto [levels, lift] = lifted_to_fit(query, coarser, finest);
        last = lift >= coarsest_lift(query);
        if (levels.empty())
            levels.assign(regions_.size(), static_cast<std::uint8_t>(finest_that_fits(most)));
        if (!gather(query, levels, result, stop))
            return Outcome::stopped;
        const double times = static_cast<double>(result.cells()) / most;
        last |= times <= kTolerated;
        // There are about `kFiner` times fewer cells one level up.
        coarser =
            lift + static_cast<unsigned>(std::ceil(DetailQuery::kPartsOfLevel *
                                                   std::log2(std::max(times, 1.0)) / kBitsFiner));
    }
    known_.clear();
    result.coarsest = std::ranges::max(result.levels);
    if (!add_lost(query, finest, result, stop))
        return Outcome::stopped;
    result.colors.clear();
    if (by_first_crossing(query.coloring) || source_)
        for (const auto& of_surface : colors_)
            result.colors.insert(result.colors.end(), of_surface.begin(), of_surface.end());
    return Outcome::made;
}

} // namespace isochron::index
