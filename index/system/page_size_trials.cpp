// Compares the times of the two kinds of pages.
#include "index/system/page_size_trials.h"

#include <algorithm>

namespace isochron::index {
namespace {

constexpr unsigned kMostBetweenTrials = 1 << 16;

std::size_t place(Pages pages) {
    return static_cast<std::size_t>(pages);
}

Pages other(Pages pages) {
    return pages == Pages::small ? Pages::huge : Pages::small;
}

} // namespace

PageSizeTrials& PageSizeTrials::of_process() {
    static PageSizeTrials trials;
    return trials;
}

Pages PageSizeTrials::next() {
    const std::scoped_lock lock(mutex_);
    for (const Pages pages : {Pages::small, Pages::huge})
        if (!times_[place(pages)])
            return pages;
    if (--until_trial_ > 0)
        return better_;
    between_ = std::min(2 * between_, kMostBetweenTrials);
    until_trial_ = between_;
    return other(better_);
}

void PageSizeTrials::took(Pages pages, std::chrono::nanoseconds time) {
    const std::scoped_lock lock(mutex_);
    auto& known = times_[place(pages)];
    // A trial counts as it is, since the last one may be long ago.
    known = known && pages == better_ ? (*known + time) / 2 : time;
    const auto& small = times_[place(Pages::small)];
    const auto& huge = times_[place(Pages::huge)];
    if (!small || !huge)
        return;
    const Pages better = *huge < *small ? Pages::huge : Pages::small;
    if (better != better_)
        between_ = until_trial_ = kBetweenTrials;
    better_ = better;
}

} // namespace isochron::index
