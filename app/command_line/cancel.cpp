// Ctrl-C ends long work at its next report of progress, or soon.
#include "app/command_line/cancel.h"

#include "app/end_in_time.h"
#include "index/readers/process/process_text.h"
#include "index/readers/process/reader_pool.h"
#include "index/system/links/link.h"

#include <array>
#include <atomic>
#include <cstdio>
#include <string>
#include <utility>

#include <unistd.h>

namespace isochron::app {
namespace {

constexpr std::array kSignals{SIGINT, SIGTERM, SIGHUP};

std::atomic<int> came = 0; // the signal; a handler may write only what takes no lock
static_assert(std::atomic<int>::is_always_lock_free);
volatile pid_t sender = 0;   // who sent the signal that came
pid_t launcher = 0;          // leader of this process's group
std::atomic<int> living = 0; // objects of CancelOnSignal, one within the other
std::atomic<const WakeOnSignal*> woken_by_signals = nullptr;
static_assert(std::atomic<const WakeOnSignal*>::is_always_lock_free);

void end_what_is_canceled() {
    if (living > 0 && came != 0)
        throw Canceled(came);
}

/// The parent of a process, or 0 where that cannot be read.
pid_t parent_of(pid_t process) {
    const std::string fields = index::process_text("/proc/" + std::to_string(process) + "/stat");
    const std::size_t name_ends = fields.rfind(')'); // the name itself may hold anything
    pid_t parent = 0;
    if (name_ends != fields.npos)
        std::sscanf(fields.c_str() + name_ends + 1, " %*c %d", &parent);
    return parent;
}

/// The nearest ancestor outside this process's group; a shell may stand between the two.
pid_t find_launcher() {
    pid_t ancestor = getppid();
    while (ancestor != 0 && getpgid(ancestor) == getpgrp())
        ancestor = parent_of(ancestor);
    return ancestor;
}

} // namespace

void note_signal(int signal, siginfo_t* about, void*) {
    came = signal;
    sender = about->si_pid;
    EndInTime::signaled(signal);
    if (const WakeOnSignal* const woken = woken_by_signals)
        woken->wake_(woken->who_.get());
}

CancelOnSignal::CancelOnSignal() {
    if (living++ == 0) {
        came = 0;
        launcher = find_launcher(); // before the end of a shell between the two leaves no trace
        index::readers_of_this_process().call_while_waiting(end_what_is_canceled);
        index::call_while_waiting_for_links(end_what_is_canceled);
        EndInTime::watch();
    }
    struct sigaction action{};
    action.sa_sigaction = note_signal;
    action.sa_flags = SA_RESTART | SA_SIGINFO;
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

bool CancelOnSignal::sent_by_the_launcher() {
    return came != 0 && sender != 0 && sender == launcher;
}

WakeOnSignal::WakeOnSignal(std::shared_ptr<const void> who, void (*wake)(const void* who))
    : who_(std::move(who)), wake_(wake) {
    woken_by_signals = this;
}

WakeOnSignal::~WakeOnSignal() {
    woken_by_signals = nullptr;
}

} // namespace isochron::app
