// Checks the frame counter of a tracker's frames.
#include "interaction/trackers/frame_sequence.h"

namespace isochron::interaction {
namespace {

constexpr std::int32_t kLongestWay = 1000; ///< [frames] by which a datagram may be overtaken
constexpr Seconds kSilence{0.5};           ///< longest gap between the frames of one run

} // namespace

bool FrameSequence::accept(std::uint32_t counter, Seconds arrival) {
    if (newest_) {
        const auto step = static_cast<std::int32_t>(counter - newest_->counter);
        const bool starts_over =
            step > kLongestWay || step < -kLongestWay || arrival - newest_->arrival > kSilence;
        if (step <= 0 && !starts_over) {
            ++late_;
            return false;
        }
        if (step > 1 && step <= kLongestWay)
            missing_ += static_cast<std::uint64_t>(step) - 1;
    }
    newest_ = Newest{counter, arrival};
    ++accepted_;
    return true;
}

} // namespace isochron::interaction
