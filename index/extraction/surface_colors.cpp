// Computes the color coordinates of an extraction's cells.
#include "index/extraction/surface_colors.h"

#include "index/surface/cell_colors.h"

#include <algorithm>

namespace isochron::index {

SurfaceColors::SurfaceColors(std::shared_ptr<const IndexFile> file,
                             std::optional<SearchMethod> method)
    : file_(std::move(file)), method_(method), layers_(file_) {}

bool SurfaceColors::fill(const SurfacesQuery& query, const std::vector<CellSet>& surfaces,
                         const StepView& step, std::vector<std::uint16_t>& out,
                         std::vector<std::uint16_t>& corners, const std::stop_token& stop,
                         const KnownColors& known) {
    forget_all_but(query);
    out.clear();
    corners.clear();
    if (query.coloring == CellColoring::none)
        return true;
    std::optional<ColorSource> source;
    if (query.coloring == CellColoring::value) {
        if (query.colors >= ColorSource::count(*file_))
            return true;
        source.emplace(*file_, query.colors);
    }
    const bool blended = query.coloring == CellColoring::first_blended_crossing;
    std::size_t rank = 0;
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        const auto& cells = surfaces[i].ids;
        if (cells.empty())
            continue;
        out.resize(rank + cells.size(), kNoColor);
        const auto part = std::span(out).subspan(rank);
        if (source) {
            corners.resize(8 * out.size(), kNoFineColor);
            const Part colored{part, std::span(corners).subspan(8 * rank)};
            const bool keeps = i < known.surfaces.size() && !known.surfaces[i].places.empty();
            if (keeps ? !fill_others(step, surfaces[i], *source, known, known.surfaces[i], colored,
                                     stop)
                      : !layers_.color_cells(step, surfaces[i], *source, colored.colors, stop,
                                             colored.corners))
                return false;
        } else if (!has_wide_ids(file_->info().grid)) {
            const FirstCrossings* first = crossings(query.isovalues[i], blended, stop);
            if (!first)
                return false;
            color_by_first_crossing(*first, file_->info().times, query.instant, cells, part);
        }
        rank = out.size();
    }
    return true;
}

/// Takes over the colors that stay, and colors the other cells.
bool SurfaceColors::fill_others(const StepView& step, const CellSet& surface,
                                const ColorSource& source, const KnownColors& known,
                                const KnownColors::Surface& earlier, const Part& part,
                                const std::stop_token& stop) {
    CellSet others;
    others.query = surface.query;
    std::vector<std::uint32_t> places; // where the other cells are in the surface
    for (std::uint32_t i = 0; i < surface.ids.size(); ++i) {
        if (earlier.places[i] == EarlierMesh::kNone) {
            others.ids.push_back(surface.ids[i]);
            places.push_back(i);
            continue;
        }
        const std::size_t from = earlier.first + earlier.places[i];
        part.colors[i] = known.colors[from];
        std::ranges::copy(known.corners.subspan(8 * from, 8), &part.corners[8 * std::size_t{i}]);
    }
    if (places.empty())
        return !stop.stop_requested();
    std::vector<std::uint16_t> colors(places.size(), kNoColor),
        corners(8 * places.size(), kNoFineColor);
    if (!layers_.color_cells(step, others, source, colors, stop, corners))
        return false;
    for (std::size_t i = 0; i < places.size(); ++i) {
        part.colors[places[i]] = colors[i];
        std::copy_n(&corners[8 * i], 8, &part.corners[8 * std::size_t{places[i]}]);
    }
    return true;
}

void SurfaceColors::forget_all_but(const SurfacesQuery& query) {
    std::erase_if(crossings_, [&](const FirstCrossingsPtr& known) {
        return !by_first_crossing(query.coloring) ||
               std::ranges::find(query.isovalues, known->isovalue) == query.isovalues.end();
    });
}

/// @return null when stopped
const FirstCrossings* SurfaceColors::crossings(double isovalue, bool blended,
                                               const std::stop_token& stop) {
    const auto known = std::ranges::find_if(crossings_, [&](const FirstCrossingsPtr& each) {
        return each->isovalue == isovalue && each->blended() == blended;
    });
    if (known != crossings_.end())
        return known->get();
    FirstCrossingsPtr found =
        first_crossings(file_->info(), search_in(file_, method_, Shading::none), isovalue, stop,
                        blended ? crossings_between(file_, 0, isovalue, stop) : nullptr);
    if (!found)
        return nullptr;
    crossings_.push_back(std::move(found));
    return crossings_.back().get();
}

} // namespace isochron::index
