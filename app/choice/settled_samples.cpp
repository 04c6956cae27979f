// More samples of each pixel of a settled picture.
#include "app/choice/settled_samples.h"

namespace isochron::app {

bool SettledSamples::take(const Picture& drawn) {
    if (!are_missing())
        return false;
    if (outputs_.in_mean() == 0) {
        next_.reset();
        outputs_.begin_mean();
        if (outputs_.in_mean() == 0)
            return settled_ = false; // nothing is shown
    }
    if (!next_) {
        next_.emplace(drawn);
        next_->keeps = false; // what is moved while the head sways is of the first samples alone
    }
    next_->draw(scene_, outputs_, quality_.part_budget());
    if (!next_->whole)
        return false;
    next_.reset();
    outputs_.add_to_mean();
    constexpr int kFirstShown = 4;
    const bool shown = outputs_.in_mean() == kFirstShown || !are_missing();
    if (shown)
        outputs_.complete_mean();
    return shown;
}

void SettledSamples::give_up() {
    next_.reset();
    outputs_.end_mean();
}

} // namespace isochron::app
