// Chooses the sender whose datagrams are used.
#include "interaction/trackers/used_sender.h"

#include <algorithm>

#include <fmt/format.h>

namespace isochron::interaction {
namespace {

constexpr Seconds kSenderGone{1};      ///< a tracker sends some 60 frames in that time
constexpr std::size_t kMostNoisy = 64; ///< senders that are remembered

} // namespace

bool UsedSender::admits(const Endpoint& sender, Seconds arrival) {
    if (current_ && current_->sender == sender)
        return true;
    if (arrival - noisy_since_ > kSenderGone)
        noisy_.clear();
    const bool allowed = !from_ || (sender.address == from_->address &&
                                    (from_->port == 0 || sender.port == from_->port));
    const bool free = !current_ || arrival - current_->arrival > kSenderGone;
    if (allowed && free && std::ranges::find(noisy_, sender) == noisy_.end()) {
        current_ = Current{sender, arrival};
        return true;
    }
    ++strangers_;
    last_stranger_ = sender;
    return false;
}

void UsedSender::heard(Seconds arrival) {
    current_->arrival = arrival;
    current_->proven = true;
}

void UsedSender::made_no_sense(Seconds arrival) {
    if (current_->proven)
        return;
    if (noisy_.empty())
        noisy_since_ = arrival;
    if (noisy_.size() < kMostNoisy)
        noisy_.push_back(current_->sender);
    current_.reset();
}

std::optional<Endpoint> UsedSender::proven(Seconds now) const {
    if (!current_ || !current_->proven || now - current_->arrival > kSenderGone)
        return std::nullopt;
    return current_->sender;
}

std::string UsedSender::strangers(std::uint64_t more) const {
    if (strangers_ + more == 0)
        return {};
    return fmt::format(", {} from others ({})", strangers_ + more, to_string(last_stranger_));
}

} // namespace isochron::interaction
