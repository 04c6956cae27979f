// Ctrl-C ends long work at its next report of progress.
#include "app/command_line/cancel.h"

#include <array>
#include <atomic>
#include <utility>

namespace isochron::app {
namespace {

constexpr std::array kSignals{SIGINT, SIGTERM, SIGHUP};

volatile std::sig_atomic_t came = 0; // a signal handler can reach nothing else
int living = 0;                      // of CancelOnSignal, one within the other
std::atomic<const WakeOnSignal*> woken_by_signals = nullptr;
static_assert(std::atomic<const WakeOnSignal*>::is_always_lock_free);

} // namespace

void note_signal(int signal) {
    came = signal;
    if (const WakeOnSignal* const woken = woken_by_signals)
        woken->wake_(woken->who_.get());
}

CancelOnSignal::CancelOnSignal() {
    if (living++ == 0)
        came = 0;
    struct sigaction action {};
    action.sa_handler = note_signal;
    action.sa_flags = SA_RESTART;
    for (std::size_t i = 0; i < kSignals.size(); ++i) {
        sigaction(kSignals[i], nullptr, &previous_[i]);
        if (previous_[i].sa_handler != SIG_IGN) // as nohup asks
            sigaction(kSignals[i], &action, nullptr);
    }
}

CancelOnSignal::~CancelOnSignal() {
    --living;
    for (std::size_t i = 0; i < kSignals.size(); ++i)
        sigaction(kSignals[i], &previous_[i], nullptr);
}

void CancelOnSignal::check() const {
    if (came != 0)
        throw Canceled(came);
}

int CancelOnSignal::received() {
    return came;
}

WakeOnSignal::WakeOnSignal(std::shared_ptr<const void> who, void (*wake)(const void* who))
    : who_(std::move(who)), wake_(wake) {
    woken_by_signals = this;
}

WakeOnSignal::~WakeOnSignal() {
    woken_by_signals = nullptr;
}

} // namespace isochron::app
