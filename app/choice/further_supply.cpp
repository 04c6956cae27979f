// Makes surfaces of other arrays beside the frames, and keeps those that may serve again.
#include "app/choice/further_supply.h"

#include "app/scene/color_scale.h"

#include <algorithm>
#include <cstddef>

namespace isochron::app {
namespace {

/// Surfaces that are kept, those shown included.
constexpr std::size_t kMostFurtherKept = 24;
constexpr std::uint64_t kMostTogether = 4 * FurtherSupply::kMost; ///< triangles

/// Whether both are of one surface, at whatever instant and isovalue.
bool same_surface(const index::SurfacesQuery& a, const index::SurfacesQuery& b) {
    return a.array == b.array && surface_of(a) == surface_of(b);
}

} // namespace

FurtherSupply::FurtherSupply(std::shared_ptr<const index::IndexFile> file)
    : file_(std::move(file)) {}

void FurtherSupply::take() {
    for (MadeSurfaces& made : making_.take()) {
        makes_.reset();
        if (made.surfaces) {
            kept_.push_back(std::move(made.surfaces));
        } else if (!made.failure.empty()) {
            failed_.push_back(std::move(made.query));
            messages_.push_back(std::move(made.failure));
        }
    }
    std::uint64_t triangles = 0;
    for (const index::InstantSurfacesPtr& kept : kept_)
        triangles += kept->triangles();
    while (kept_.size() > kMostFurtherKept || (kept_.size() > 1 && triangles > kMostTogether)) {
        triangles -= kept_.front()->triangles();
        kept_.erase(kept_.begin());
    }
}

/// One with as many triangles as may be, or else another one of the query, or else the last one of the surface.
index::InstantSurfacesPtr FurtherSupply::best(const index::SurfacesQuery& query,
                                              std::uint64_t most) const {
    if (index::InstantSurfacesPtr there = surfaces_among(kept_, query, most))
        return there;
    index::InstantSurfacesPtr last;
    for (const index::InstantSurfacesPtr& kept : kept_)
        if (same_surface(kept->query, query) &&
            (!last || kept->query == query || last->query != query))
            last = kept;
    return last;
}

/// Any of each first, and then each as it is wanted.
std::optional<WantedSurfaces> FurtherSupply::next(std::span<const index::SurfacesQuery> wished,
                                                  std::uint64_t most) const {
    for (const bool any : {true, false})
        for (const index::SurfacesQuery& query : wished) {
            const index::InstantSurfacesPtr there =
                any ? best(query, most) : surfaces_among(kept_, query, most);
            if (!(there && there->query == query) &&
                std::ranges::find(failed_, query) == failed_.end())
                return WantedSurfaces{array_of(file_, query.array), query,
                                      any ? std::min(most, kMostMoving) : most};
        }
    return std::nullopt;
}

void FurtherSupply::drop_unwished(std::span<const index::SurfacesQuery> wished) {
    const auto has = [&](const index::InstantSurfacesPtr& kept) {
        return std::ranges::any_of(
            wished, [&](const auto& query) { return same_surface(query, kept->query); });
    };
    std::erase_if(kept_, [&](const auto& kept) { return !has(kept); });
    std::erase_if(failed_, [&](const auto& failed) {
        return std::ranges::find(wished, failed) == wished.end();
    });
    // A small one is finished, or nothing would come while a value is dragged.
    if (makes_ && makes_->most > kMostMoving &&
        std::ranges::find(wished, makes_->query) == wished.end())
        making_.cancel();
}

void FurtherSupply::update(const Frame& frame, const std::vector<index::SurfacesQuery>& wished) {
    take();
    drop_unwished(wished);
    const bool by_crossing = std::ranges::any_of(
        wished, [](const auto& query) { return index::by_first_crossing(query.coloring); });
    if (!by_crossing)
        crossings_.reset();
    else if (!crossings_)
        crossings_ = std::make_shared<index::KnownCrossings>();
    const bool rests =
        !frame.is_live() || frame.is_kept || frame.report.pace == interaction::Pace::settled;
    const std::uint64_t most = rests ? kMost : kMostMoving;
    for (auto wanted = next(wished, most); wanted && (!makes_ || !frame.is_live());
         wanted = next(wished, most)) {
        if (!makes_) {
            if (!frame.is_live())
                wanted->most = most;
            wanted->known = crossings_;
            makes_ = wanted;
            making_.ask(*wanted);
        }
        if (frame.is_live())
            break;
        making_.finish();
        take();
    }
    come_ = next(wished, most).has_value();
    shown_.clear();
    for (const index::SurfacesQuery& query : wished)
        if (index::InstantSurfacesPtr there = best(query, most))
            shown_.push_back(std::move(there));
}

std::vector<ShownFurther> shown_further(const std::vector<index::InstantSurfacesPtr>& made,
                                        const ExplorerState& state, const index::IndexFile& file) {
    std::vector<ShownFurther> further;
    for (const index::InstantSurfacesPtr& surfaces : made) {
        const std::size_t number = surface_of(surfaces->query);
        if (number >= state.isosurfaces.size() || state.slices.hides_surfaces())
            continue;
        const index::SeriesInfo& info = file.array(surfaces->query.array).info();
        ShownFurther& shown = further.emplace_back();
        shown.surfaces = surfaces;
        shown.look = state.isosurfaces[number];
        shown.look.isovalue = surfaces->query.isovalues.back();
        shown.values = {info.array, info.value_unit, info.type, info.digits};
        shown.simplified = !surfaces->exact() && surfaces->most == FurtherSupply::kMost;
        shown.by_values = colored_as_asked(*surfaces, state, file);
    }
    return further;
}

bool colored_as_asked(const index::InstantSurfaces& made, const ExplorerState& state,
                      const index::IndexFile& file) {
    const index::SurfacesQuery& query = made.query;
    return query.coloring != index::CellColoring::none &&
           query.coloring == state.surfaces().coloring &&
           (query.coloring != index::CellColoring::value ||
            query.colors == color_array(state, file)) &&
           made.meshes.back() && !made.meshes.back()->colors.empty();
}

} // namespace isochron::app
