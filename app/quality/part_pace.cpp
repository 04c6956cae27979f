// How much of a picture that is drawn over several frames is drawn in each of them.
#include "app/quality/part_pace.h"

#include <algorithm>

namespace isochron::app {

/// Share of a frame's time that a piece is meant to take: less than all, as costs are known from
/// the piece before only.
constexpr double kPiece = 0.25;

void PartPace::begin_frame(Milliseconds each) {
    each_ = each;
    spent_ = Milliseconds(0);
    begun_ = false;
}

std::size_t PartPace::next() const {
    std::size_t work = kFirst;
    if (of_one_.count() > 0) {
        const double wanted = kPiece * (each_ / of_one_);
        const double most = 2.0 * static_cast<double>(last_);
        work = std::max(kLeast, static_cast<std::size_t>(std::min(wanted, most)));
    }
    const bool fits = spent_ + static_cast<double>(work) * of_one_ <= each_ && spent_ < each_;
    return fits || !begun_ ? work : 0;
}

void PartPace::took(std::size_t work, Milliseconds time) {
    begun_ = true;
    spent_ += time;
    whole_ += time;
    if (work == 0)
        return;
    last_ = work;
    of_one_ = time / static_cast<double>(work);
}

} // namespace isochron::app
