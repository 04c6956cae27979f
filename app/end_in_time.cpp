// Ends the process soon after a signal.
#include "app/end_in_time.h"

#include "app/safe_text.h"
#include "index/system/temporary/own_remains.h"

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

#include <poll.h>
#include <semaphore.h>
#include <sys/resource.h>
#include <unistd.h>

namespace isochron::app {
namespace {

/// Never destroyed: the thread that waits may outlive `main`.
struct Watch {
    sem_t came{}; ///< a signal
    std::atomic<int> signal = 0;
    std::atomic<const char*> program = nullptr; ///< null: the process is not ended
    std::once_flag begun;
    std::atomic_flag told;
    std::timed_mutex still; ///< held while what is saved may change
    std::function<void()> save;
    std::atomic<bool> saves = false;
    int draws = 0; ///< objects of DrawsOnly, one within the other
    Watch() { sem_init(&came, 0, 0); }
};

Watch& watch_of_process() {
    static Watch* const watch = new Watch;
    return *watch;
}

/// A process is gone once its last thread is, and on a busy machine a thread of the lowest priority (a
/// driver keeps its cache of shaders with some) waits for seconds until it may end.
void raise_all_threads() noexcept {
    const int usual = getpriority(PRIO_PROCESS, static_cast<id_t>(getpid()));
    std::error_code gone;
    for (std::filesystem::directory_iterator at("/proc/self/task", gone), end; !gone && at != end;
         at.increment(gone))
        setpriority(PRIO_PROCESS, static_cast<id_t>(std::atoi(at->path().filename().c_str())),
                    usual);
}

/// Whether a line can be written at once: a full pipe whose reader hangs would keep the process.
bool takes_a_line(int file) noexcept {
    pollfd one{file, POLLOUT, 0};
    return ::poll(&one, 1, 0) == 1 && (one.revents & POLLOUT) != 0;
}

[[noreturn]] void end(Watch& watch) {
    const std::chrono::seconds most = watch.saves ? EndInTime::kToSave : EndInTime::kToCleanUp;
    ::alarm(static_cast<unsigned>(most.count())); // ends it where even that hangs
    if (watch.still.try_lock_for(most) && watch.save)
        watch.save();
    index::remove_own_remains();
    if (!EndInTime::is_first_to_tell()) {
        std::this_thread::sleep_for(EndInTime::kByItself); // another thread says it now
    } else if (takes_a_line(STDERR_FILENO)) {
        if (::isatty(STDERR_FILENO) != 0)
            print_safely(stderr, "\n"); // behind a bar of progress
        print_safely(stderr, "{}: canceled\n", watch.program.load());
    }
    raise_all_threads(); // work may have lowered its own meanwhile
    ::_exit(128 + watch.signal);
}

void wait_for_a_signal(Watch& watch) {
    while (sem_wait(&watch.came) != 0) {
    }
    raise_all_threads(); // refused where the user may not
    std::this_thread::sleep_for(EndInTime::kByItself);
    if (watch.program != nullptr)
        end(watch);
}

} // namespace

void EndInTime::allow(const char* program) {
    watch_of_process().program = program;
}

void EndInTime::leave_to_the_job() {
    watch_of_process().program = nullptr;
}

void EndInTime::watch() {
    Watch& watch = watch_of_process();
    if (watch.program != nullptr)
        std::call_once(watch.begun,
                       [&] { std::thread([&watch] { wait_for_a_signal(watch); }).detach(); });
}

void EndInTime::signaled(int signal) noexcept {
    Watch& watch = watch_of_process();
    watch.signal = signal;
    sem_post(&watch.came);
}

bool EndInTime::is_first_to_tell() {
    return !watch_of_process().told.test_and_set();
}

SavedAtEnd::SavedAtEnd(std::function<void()> save) {
    Watch& watch = watch_of_process();
    watch.still.lock();
    watch.save = std::move(save);
    watch.saves = true;
}

SavedAtEnd::~SavedAtEnd() {
    Watch& watch = watch_of_process();
    watch.saves = false;
    watch.save = {};
    watch.still.unlock();
}

DrawsOnly::DrawsOnly() {
    Watch& watch = watch_of_process();
    if (watch.save && watch.draws++ == 0)
        watch.still.unlock();
}

DrawsOnly::~DrawsOnly() {
    Watch& watch = watch_of_process();
    if (watch.save && --watch.draws == 0)
        watch.still.lock();
}

} // namespace isochron::app
