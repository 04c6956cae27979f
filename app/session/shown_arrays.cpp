// Which array of the index a session shows, and by which it colors.
#include "app/session/shown_arrays.h"

#include "app/scene/color_scale.h"
#include "app/session/start_state.h"
#include "app/text.h"
#include "index/error.h"
#include "index/file/color_source.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <utility>

namespace isochron::app {

bool has_values(const index::IndexStats& stats) {
    return has_surfaces(stats) ||
           std::ranges::any_of(stats.histogram, [](std::uint64_t count) { return count > 0; });
}

std::optional<std::size_t> next_with_surfaces(const index::IndexFile& file, std::size_t number) {
    for (std::size_t i = 1; i < file.arrays(); ++i)
        if (const std::size_t other = (number + i) % file.arrays();
            has_surfaces(file.array(other).stats()))
            return other;
    return std::nullopt;
}

ShownArrays::ShownArrays(const Config& config, std::shared_ptr<const index::IndexFile> file,
                         const ExplorerState& home)
    : file_(std::move(file)), color_names_(index::color_source_names(*file_)),
      first_surfaces_{home.isosurfaces} {
    for (std::size_t number = 0; number < file_->arrays(); ++number) {
        const index::IndexFile& array = file_->array(number);
        const index::SeriesInfo& info = array.info();
        const index::IndexStats& stats = array.stats();
        const std::string share = missing_text(stats.nan_values, info);
        const std::string missing = share.empty() ? "" : fmt::format(", {} missing", share);
        names_.push_back(info.array);
        notes_.push_back(range_text(stats.low, stats.high, info.value_unit) + missing);
        lines_.push_back({info.array,
                          grid_words(info),
                          info.value_unit,
                          range_text(stats.low, stats.high) + missing,
                          {}});
        if (number > 0)
            first_surfaces_.push_back(
                first_surfaces(config, array_of(file_, number), home.instant.step));
    }
}

PanelArrays ShownArrays::in_panel(const ExplorerState& state) const {
    std::vector<const index::IndexFile*> of_surfaces;
    for (std::size_t i = 0; i < state.isosurfaces.size(); ++i)
        of_surfaces.push_back(number(state, i) == number(state) ? nullptr : &of(state, i));
    return {.names = names_,
            .notes = notes_,
            .lines = lines_,
            .asked = number(state),
            .way_to = [this, &state](std::size_t number) { return way_to(number, state); },
            .color_names = color_names_,
            .color = color_array(state, *file_),
            .of_surfaces = std::move(of_surfaces)};
}

std::shared_ptr<const index::IndexFile> ShownArrays::held(const ExplorerState& state) const {
    return array_of(file_, number(state));
}

void ShownArrays::expect(const std::string& name) const {
    if (!name.empty() && !file_->array_called(name))
        throw index::Error("{}: no array {}, expected {}", file_->name(), name,
                           fmt::join(names_, ", "));
}

bool ShownArrays::turn(const ExplorerState& before, const ExplorerState& now) {
    expect(now.array);
    const std::size_t left = number(before);
    if (left == number(now))
        return false;
    interaction::Commands& kept = left_[left];
    kept.array = names_[left];
    kept.isosurfaces = before.isosurfaces;
    kept.picked = before.picked;
    kept.coloring = before.coloring;
    kept.pieces = before.pieces;
    return true;
}

std::vector<interaction::Commands> ShownArrays::left(const ExplorerState& state) const {
    std::vector<interaction::Commands> left;
    for (const auto& [number, commands] : left_)
        if (number != this->number(state))
            left.push_back(commands);
    return left;
}

void ShownArrays::recall(const std::vector<interaction::Commands>& left) {
    for (const interaction::Commands& commands : left)
        if (const auto number = file_->array_called(*commands.array))
            left_[*number] = commands;
}

interaction::Commands ShownArrays::way_to(std::size_t number, const ExplorerState& state) const {
    interaction::Commands way;
    if (const auto known = left_.find(number); known != left_.end()) {
        way = known->second;
    } else {
        way.array = names_[number];
        way.isosurfaces = first_surfaces_[number];
        way.picked = 0;
        way.coloring = state.coloring;
        if (way.coloring->by == interaction::ColorBy::value && way.coloring->array.empty())
            way.coloring->range.reset(); // colors may stand for another array
        if (!state.pieces.all())
            way.pieces = interaction::ShownPieces{}; // places are on surfaces of the array before
    }
    if (state.mark.point)
        way.mark = interaction::Mark{}; // its value is of the array before
    return way;
}

index::SurfacesQuery ShownArrays::surfaces(const ExplorerState& state) const {
    index::SurfacesQuery query = state.surfaces();
    query.array = static_cast<std::uint32_t>(number(state));
    if (query.coloring == index::CellColoring::value)
        query.colors = static_cast<std::uint32_t>(color_array(state, *file_));
    return query;
}

std::vector<index::SurfacesQuery> ShownArrays::further(const ExplorerState& state) const {
    std::vector<index::SurfacesQuery> queries;
    for (std::size_t i = 0; i < state.isosurfaces.size(); ++i) {
        const interaction::Isosurface& surface = state.isosurfaces[i];
        if (surface.of_shown_array() || !(surface.opacity > 0) ||
            !file_->array_called(surface.array))
            continue;
        index::SurfacesQuery& query = queries.emplace_back();
        query.instant = state.shown_instant();
        query.isovalues.assign(i, kNoSurface);
        query.isovalues.push_back(surface.isovalue);
        query.array = static_cast<std::uint32_t>(number(state, i));
        query.coloring = state.surfaces().coloring;
        if (query.coloring == index::CellColoring::value) {
            if (index::ColorSource::count(*file_) == 0)
                query.coloring = index::CellColoring::none;
            else
                query.colors = static_cast<std::uint32_t>(color_array(state, *file_));
        }
        query.pieces = filter_of(state.pieces);
        for (auto* const list : {&query.pieces.only, &query.pieces.hidden})
            std::erase_if(*list, [i](const index::PieceAt& piece) { return piece.surface != i; });
    }
    return queries;
}

std::vector<std::string> ShownArrays::settle(ExplorerState& state) const {
    std::vector<std::string> faults;
    for (interaction::Isosurface& surface : state.isosurfaces) {
        const auto named = file_->array_called(surface.array);
        if (!surface.array.empty() && !named)
            faults.push_back(fmt::format("no surface of array {}, expected {}", surface.array,
                                         fmt::join(names_, ", ")));
        else if (named == number(state))
            surface.array.clear();
    }
    return faults;
}

} // namespace isochron::app
