// Appends results of layers, with room for those still to come.
#include "index/search/layer_results.h"

#include "index/system/huge_pages.h"

#include <algorithm>
#include <span>
#include <utility>

namespace isochron::index {
namespace {

/// Makes room for `more` values, and for those that are likely to follow.
/// @param done fraction of all layers that will have been appended with these
template <class T>
void make_room(std::vector<T>& values, std::size_t more, double done) {
    const std::size_t size = values.size() + more;
    if (size <= values.capacity())
        return;
    const auto likely = static_cast<std::size_t>(1.1 * static_cast<double>(size) / done);
    values.reserve(std::max(likely, size + size / 2));
    ask_for_huge_pages(values.data() + values.size(),
                       (values.capacity() - values.size()) * sizeof(T));
}

/// Appends values, some at a time until it is asked to stop, and calls `f` for each where it is.
template <class T, class F>
void append_each(std::vector<T>& to, const std::vector<T>& more, const std::stop_token& stop,
                 const F& f) {
    constexpr std::size_t kTogether = 1 << 15;
    for (std::size_t i = 0; i < more.size() && !stop.stop_requested(); i += kTogether) {
        const auto some = std::span(more).subspan(i, std::min(kTogether, more.size() - i));
        to.insert(to.end(), some.begin(), some.end());
        std::ranges::for_each(std::span(to).last(some.size()), f);
    }
}

} // namespace

LayerResults::LayerResults(CellSet& set, std::uint32_t layers, std::stop_token stop)
    : set_(&set), stop_(std::move(stop)), waiting_(layers), came_(layers) {
    set.ids.clear();
    set.points.clear();
    set.rows.clear();
    set.candidates = 0;
}

LayerResults::LayerResults(std::uint32_t layers) : set_(nullptr), waiting_(layers), came_(layers) {}

LayerResult LayerResults::begin() {
    const std::scoped_lock lock(mutex_);
    if (free_.empty())
        return {};
    LayerResult result = std::move(free_.back());
    free_.pop_back();
    return result;
}

void LayerResults::add(std::uint32_t layer, LayerResult result) {
    const std::scoped_lock lock(mutex_);
    waiting_[layer] = std::move(result);
    came_[layer] = true;
    for (; next_ < came_.size() && came_[next_]; ++next_)
        append(waiting_[next_]);
}

void LayerResults::append(LayerResult& result) {
    CellSet& from = result.cells;
    cells += from.ids.size();
    if (set_)
        keep(result);
    searching += result.searching;
    shading += result.shading;
    from.ids.clear();
    from.points.clear();
    from.rows.clear();
    from.candidates = 0;
    result.searching = result.shading = {};
    free_.push_back(std::move(result));
}

void LayerResults::keep(LayerResult& result) {
    CellSet& from = result.cells;
    if (came_.size() == 1 && result.first == 0 && result.first_plane == 0) { // nothing to join
        set_->ids.swap(from.ids);
        set_->points.swap(from.points);
        set_->rows.swap(from.rows);
        set_->candidates = from.candidates;
        return;
    }
    const double done = (next_ + 1.0) / static_cast<double>(came_.size());
    const auto before = static_cast<std::uint32_t>(set_->points.size());
    const auto plane = result.first_plane;
    make_room(set_->ids, from.ids.size(), done);
    make_room(set_->points, from.points.size(), done);
    make_room(set_->rows, from.rows.size(), done);
    append_each(set_->ids, from.ids, stop_, [&](CellId& id) { id += result.first; });
    append_each(set_->points, from.points, stop_,
                [&](CellPoint& point) { point.z = static_cast<std::uint16_t>(point.z + plane); });
    append_each(set_->rows, from.rows, stop_, [&](CellRow& row) {
        row.z = static_cast<std::uint16_t>(row.z + plane);
        row.begin += before;
    });
    set_->candidates += from.candidates;
}

} // namespace isochron::index
