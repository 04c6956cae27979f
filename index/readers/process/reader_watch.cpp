// The two rules: a reader that makes no progress, and one that seems to make some for ever.
#include "index/readers/process/reader_watch.h"

#include <fmt/format.h>

namespace isochron::index {
namespace {

double seconds_of(ReaderWatch::Duration duration) {
    return std::chrono::duration<double>(duration).count();
}

} // namespace

void ReaderWatch::begin(Duration patience, Duration of_bytes) {
    patience_ = patience;
    of_bytes_ = of_bytes;
    silent_ = asleep_ = Duration{0};
}

std::optional<std::string> ReaderWatch::look(const std::optional<ProcessSigns>& now) {
    const bool progresses = now && (!last_ || now->waits_for_disk || now->read != last_->read ||
                                    now->touched != last_->touched);
    const bool works =
        now && (!last_ || now->waits_for_disk || now->runs || now->worked != last_->worked);
    last_ = now;
    silent_ = progresses ? Duration{0} : silent_ + kLook;
    if (silent_ >= patience_)
        return fmt::format("its reader made no progress for {} s and was stopped",
                           seconds_of(patience_));
    // Else a reader that wakes now and then to touch a page would be waited for without end.
    asleep_ += works ? Duration{0} : kLook;
    if (asleep_ >= patience_ + of_bytes_)
        return fmt::format("its reader did nothing in {} s of one request and was stopped",
                           seconds_of(patience_ + of_bytes_));
    return std::nullopt;
}

} // namespace isochron::index
