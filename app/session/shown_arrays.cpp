// Which array of the index a session shows, and by which it colors.
#include "app/session/session.h"

#include "app/scene/color_scale.h"
#include "app/session/start_state.h"
#include "index/error.h"
#include "index/file/color_source.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace isochron::app {

void Session::take_arrays() {
    for (std::size_t number = 0; number < file_->arrays(); ++number) {
        array_names_.push_back(file_->array(number).info().array);
        if (number == 0)
            continue;
        scene_.cells().prepare_for(file_->array(number).info());
        first_surfaces_.push_back(first_surfaces(config_, array_of(file_, number), home_.step));
    }
    color_names_ = index::color_source_names(*file_);
}

void Session::expect_array(const std::string& name) const {
    if (!name.empty() && !file_->array_called(name))
        throw index::Error(fmt::format("{}: no array {}, expected {}", file_->name(), name,
                                       fmt::join(array_names_, ", ")));
}

void Session::set_state(const ExplorerState& state) {
    expect_array(state.array);
    state_ = state;
    picker_.set_file(array_of(file_, array_number()));
}

/// Remembers how the array before was left, if there is another now.
void Session::turn_to_array(const ExplorerState& before) {
    expect_array(state_.array);
    const std::size_t left = file_->array_called(before.array).value_or(0);
    if (left == array_number())
        return;
    interaction::Commands& kept = left_[left];
    kept.array = array_names_[left];
    kept.isosurfaces = before.isosurfaces;
    kept.picked = before.picked;
    kept.coloring = before.coloring;
    picker_.set_file(array_of(file_, array_number()));
}

std::vector<interaction::Commands> Session::left_arrays() const {
    std::vector<interaction::Commands> left;
    for (const auto& [number, commands] : left_)
        if (number != array_number())
            left.push_back(commands);
    return left;
}

void Session::recall_arrays(const std::vector<interaction::Commands>& left) {
    for (const interaction::Commands& commands : left)
        if (const auto number = file_->array_called(*commands.array))
            left_[*number] = commands;
}

interaction::Commands Session::way_to_array(std::size_t number) const {
    interaction::Commands way;
    if (const auto known = left_.find(number); known != left_.end()) {
        way = known->second;
    } else {
        way.array = array_names_[number];
        way.isosurfaces = number == 0 ? home_.isosurfaces : first_surfaces_[number - 1];
        way.picked = 0;
        way.coloring = state_.coloring;
        if (way.coloring->by == interaction::ColorBy::value && way.coloring->array.empty())
            way.coloring->range.reset(); // colors may stand for another array
    }
    if (state_.mark.point)
        way.mark = interaction::Mark{}; // its value is of the array before
    return way;
}

/// What is asked for: the state's surfaces, of its arrays.
index::SurfacesQuery Session::surfaces() const {
    index::SurfacesQuery query = state_.surfaces();
    query.array = static_cast<std::uint32_t>(array_number());
    if (query.coloring == index::CellColoring::value)
        query.colors = static_cast<std::uint32_t>(color_array(state_, *file_));
    return query;
}

} // namespace isochron::app
