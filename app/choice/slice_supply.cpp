// Reads the values of slices beside the frames.
#include "app/choice/slice_supply.h"

#include "app/scene/color_scale.h"

#include <algorithm>

namespace isochron::app {
namespace {

index::SliceValuesPtr slice_at_hand(const std::vector<index::SliceValuesPtr>& slices,
                                    const index::SliceQuery& query) {
    const auto found = std::ranges::find(
        slices, query, [](const index::SliceValuesPtr& slice) { return slice->query; });
    return found == slices.end() ? nullptr : *found;
}

std::vector<index::SliceQuery> slices_asked(const ExplorerState& state,
                                            const index::IndexFile& file) {
    std::vector<index::SliceQuery> queries;
    for (const interaction::Plane& plane : state.slices.planes)
        if (plane.shown)
            queries.push_back({state.shown_instant().within(file.info().steps()),
                               static_cast<std::uint32_t>(slice_array(state, file)), plane.point,
                               plane.normal});
    return queries;
}

} // namespace

SliceSupply::SliceSupply(std::shared_ptr<const index::IndexFile> file)
    : file_(std::move(file)),
      reading_(read, [](const Wanted& wanted, const std::string& why, bool) {
          return Read{wanted.queries, {}, why};
      }) {}

SliceSupply::Read SliceSupply::read(const Wanted& wanted, const Asking& asking) {
    Read read{wanted.queries, {}, {}};
    for (const index::SliceQuery& query : wanted.queries) {
        index::SliceValuesPtr slice = slice_at_hand(wanted.at_hand, query);
        if (!slice)
            slice = std::make_shared<index::SliceValues>(
                index::slice_values(wanted.file->array(query.array), query, asking.stop));
        read.slices.push_back(std::move(slice));
    }
    return read;
}

void SliceSupply::take() {
    for (Read& read : reading_.take()) {
        reads_ = false;
        if (read.failure.empty()) {
            shown_ = std::move(read.slices);
        } else {
            failed_ = std::move(read.queries);
            messages_.push_back(std::move(read.failure));
        }
    }
}

void SliceSupply::update(const Frame& frame) {
    const Queries wanted = slices_asked(frame.state, *file_);
    take();
    const auto at_hand = [&] {
        return std::ranges::all_of(
            wanted, [&](const auto& query) { return slice_at_hand(shown_, query) != nullptr; });
    };
    while (!at_hand() && wanted != failed_ && (!reads_ || !frame.is_live())) {
        if (!std::exchange(reads_, true))
            reading_.ask({file_, wanted, shown_});
        if (frame.is_live())
            break;
        reading_.finish();
        take();
    }
    come_ = !at_hand() && wanted != failed_;
    if (come_)
        return;
    std::vector<index::SliceValuesPtr> shown; // some planes may have gone
    for (const index::SliceQuery& query : wanted)
        if (index::SliceValuesPtr slice = slice_at_hand(shown_, query))
            shown.push_back(std::move(slice));
    shown_ = std::move(shown);
}

std::vector<ShownSlice> shown_slices(const std::vector<index::SliceValuesPtr>& read,
                                     const ExplorerState& state, const index::IndexFile& file) {
    std::vector<ShownSlice> slices;
    for (const index::SliceValuesPtr& slice : read) {
        if (slice->outline.empty())
            continue;
        std::vector<interaction::Isosurface> lines; // the surfaces of its array
        for (std::size_t i = 0; state.slices.isolines && i < state.isosurfaces.size(); ++i)
            if (array_of_surface(state, i, file) == slice->query.array)
                lines.push_back(state.isosurfaces[i]);
        ColorScale scale = slice_scale(state, file, slice->query.array);
        scale.whole = slice->whole; // a series that grows may have a wider one by now
        slices.push_back({slice, std::move(scale), std::move(lines)});
    }
    return slices;
}

} // namespace isochron::app
