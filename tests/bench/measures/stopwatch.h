// Measures processor time, which other work on the machine does not lengthen.
#pragma once

#include <ctime>

namespace isochron::bench {

class Stopwatch {
  public:
    enum class Of { this_thread, all_threads };
    explicit Stopwatch(Of of = Of::this_thread)
        : clock_(of == Of::this_thread ? CLOCK_THREAD_CPUTIME_ID : CLOCK_PROCESS_CPUTIME_ID),
          start_(now()) {}

    double seconds() const { return now() - start_; }

  private:
    double now() const {
        timespec time{};
        clock_gettime(clock_, &time);
        return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
    }

    clockid_t clock_;
    double start_;
};

} // namespace isochron::bench
