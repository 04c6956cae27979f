// Ctrl-C ends long work at its next report of progress, so that the work can clean up. Where none
// comes soon, `EndInTime` ends the process.
#pragma once

#include "index/interrupted.h"

#include <memory>

#include <csignal>

namespace isochron::app {

/// Thrown to end the work; `run_program` prints its line and returns `status`.
class Canceled : public index::Interrupted {
  public:
    explicit Canceled(int signal) : index::Interrupted("canceled"), status(128 + signal) {}
    int status; ///< 130 for SIGINT, 143 for SIGTERM, 129 for SIGHUP
};

/// While it lives, SIGINT, SIGTERM and SIGHUP are noted instead of obeyed, and end every wait for a
/// reader with Canceled. One may live within another, on the same thread.
class CancelOnSignal {
  public:
    CancelOnSignal();
    ~CancelOnSignal();
    CancelOnSignal(const CancelOnSignal&) = delete;
    CancelOnSignal& operator=(const CancelOnSignal&) = delete;

    /// @throws Canceled when a signal has come
    void check() const;
    /// The signal that has come, or 0.
    static int received();
    /// Whether the signal that has come was sent by what started this process's group, as mpirun
    /// does when it ends a job: it says why itself.
    static bool sent_by_the_launcher();

  private:
    struct sigaction previous_[3];
};

void note_signal(int signal, siginfo_t* about, void*); ///< the handler

/// While it lives, a signal that is noted also wakes whoever waits. Only one may live at a time.
class WakeOnSignal {
  public:
    /// @param who is woken, and lives as long as this
    /// @param wake is called with `who` in the signal handler, so it must be safe there
    WakeOnSignal(std::shared_ptr<const void> who, void (*wake)(const void* who));
    ~WakeOnSignal();
    WakeOnSignal(const WakeOnSignal&) = delete;
    WakeOnSignal& operator=(const WakeOnSignal&) = delete;

  private:
    friend void note_signal(int signal, siginfo_t* about, void*);
    std::shared_ptr<const void> who_;
    void (*wake_)(const void* who);
};

} // namespace isochron::app
