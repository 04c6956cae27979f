// Ctrl-C ends long work at its next report of progress.
#include "app/command_line/cancel.h"

#include <array>

namespace isochron::app {
namespace {

constexpr std::array kSignals{SIGINT, SIGTERM, SIGHUP};

volatile std::sig_atomic_t came = 0; // a signal handler can reach nothing else

} // namespace

CancelOnSignal::CancelOnSignal() {
    came = 0;
    struct sigaction action {};
    action.sa_handler = [](int signal) { came = signal; };
    action.sa_flags = SA_RESTART;
    for (std::size_t i = 0; i < kSignals.size(); ++i) {
        sigaction(kSignals[i], nullptr, &previous_[i]);
        if (previous_[i].sa_handler != SIG_IGN) // as nohup asks
            sigaction(kSignals[i], &action, nullptr);
    }
}

CancelOnSignal::~CancelOnSignal() {
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

} // namespace isochron::app
