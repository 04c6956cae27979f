// Computes the color coordinates of an extraction's cells.
#include "index/extraction/surface_colors.h"

#include "index/surface/cell_colors.h"

#include <algorithm>
#include <span>

namespace isochron::index {

SurfaceColors::SurfaceColors(std::shared_ptr<const IndexFile> file,
                             std::optional<SearchMethod> method)
    : file_(std::move(file)), method_(method), layers_(file_) {}

bool SurfaceColors::fill(const SurfacesQuery& query, const std::vector<CellSet>& surfaces,
                         const StepView& step, std::vector<std::uint16_t>& out,
                         std::vector<std::uint16_t>& corners, const std::stop_token& stop) {
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
    std::size_t rank = 0;
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        const auto& cells = surfaces[i].ids;
        if (cells.empty())
            continue;
        out.resize(rank + cells.size(), kNoColor);
        const auto part = std::span(out).subspan(rank);
        if (source) {
            corners.resize(8 * out.size(), kNoFineColor);
            if (!layers_.color_cells(step, surfaces[i], *source, part, stop,
                                     std::span(corners).subspan(8 * rank)))
                return false;
        } else if (!has_wide_ids(file_->info().grid)) {
            const FirstCrossings* first = crossings(query.isovalues[i], stop);
            if (!first)
                return false;
            color_by_first_crossing(*first, file_->info().times, cells, part);
        }
        rank = out.size();
    }
    return true;
}

void SurfaceColors::forget_all_but(const SurfacesQuery& query) {
    std::erase_if(crossings_, [&](const FirstCrossingsPtr& known) {
        return query.coloring != CellColoring::first_crossing ||
               std::ranges::find(query.isovalues, known->isovalue) == query.isovalues.end();
    });
}

/// @return null when stopped
const FirstCrossings* SurfaceColors::crossings(double isovalue, const std::stop_token& stop) {
    const auto known = std::ranges::find(crossings_, isovalue, &FirstCrossings::isovalue);
    if (known != crossings_.end())
        return known->get();
    FirstCrossingsPtr found =
        first_crossings(file_->info(), search_in(file_, method_, Shading::none), isovalue, stop);
    if (!found)
        return nullptr;
    crossings_.push_back(std::move(found));
    return crossings_.back().get();
}

} // namespace isochron::index
