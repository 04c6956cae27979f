// The first steps of a series.
#include "index/indexing/first_steps.h"

#include <cassert>

namespace isochron::index {

FirstSteps::FirstSteps(VolumeSeries& whole, std::size_t steps)
    : whole_(&whole), info_(whole.info()) {
    assert(steps > 0 && steps <= info_.steps());
    if (info_.sources.size() == info_.steps()) // else all steps are in the same files
        info_.sources.resize(steps);
    info_.times.resize(steps);
    std::erase_if(info_.missing_after, [&](std::uint32_t step) { return step + 1 >= steps; });
}

std::unique_ptr<VolumeSeries> FirstSteps::another() const {
    auto whole = whole_->another();
    return whole ? std::unique_ptr<VolumeSeries>(new FirstSteps(std::move(whole), info_)) : nullptr;
}

} // namespace isochron::index
