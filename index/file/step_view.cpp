// Decides whether a step is worked on as a whole.
#include "index/file/step_view.h"

#include "index/volume/stored_cut.h"

namespace isochron::index {

std::optional<std::uint64_t> StepView::stored_cut(double isovalue) const {
    return index::stored_cut(type(), scaling(), isovalue);
}

const LoadedStep& StepView::whole(const std::stop_token& stop) const {
    if (!whole_)
        whole_ = load_(at_, stop);
    return *whole_;
}

StepView step_of(const IndexFile& file, Instant at) {
    if (!file.better_whole(at))
        return step_in_chunks(file, at);
    const SeriesInfo& info = file.info();
    return {
        {&info.grid, info.type, info.scaling, info.steps()},
        &file.chunks(),
        at,
        [&file](std::uint32_t step, const std::stop_token& stop) { return file.load(step, stop); }};
}

StepView step_in_chunks(const IndexFile& file, Instant at, std::size_t level) {
    return {file.chunks(level), at, level};
}

} // namespace isochron::index
