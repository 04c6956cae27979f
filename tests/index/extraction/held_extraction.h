// An extraction in the hands of a test.
#pragma once

#include "index/extraction/extraction.h"
#include "tests/support/eventually.h"
#include "tests/support/thread_rest.h"

#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <semaphore>
#include <stop_token>

#include <unistd.h>

namespace isochron::index {

inline ExtractionPtr empty_extraction(const SurfacesQuery& query) {
    auto extraction = std::make_shared<Extraction>();
    extraction->query = query;
    return extraction;
}

/// An extraction whose runs the test holds and lets go one by one.
class HeldExtraction {
  public:
    /// Obedient: a stopped run returns nothing, as the real one does.
    explicit HeldExtraction(bool obedient = true) : obedient_(obedient) {}

    Extract extract() {
        return [this](const SurfacesQuery& query, const std::stop_token& stop) -> ExtractionPtr {
            {
                const std::scoped_lock lock(mutex_);
                ++calls_[query.instant.step];
                worker_ = ::gettid();
            }
            called_.notify_all();
            started_.release();
            release_.acquire();
            return obedient_ && stop.stop_requested() ? nullptr : empty_extraction(query);
        };
    }
    void wait_until_started() { started_.acquire(); }
    void let_go(int runs = 1) { release_.release(runs); }
    int calls(std::uint32_t step) {
        const std::scoped_lock lock(mutex_);
        return calls_[step];
    }
    /// Waits until a step is searched. @return false if it never is
    bool is_searched(std::uint32_t step) {
        std::unique_lock lock(mutex_);
        return test_support::is_told(called_, lock, [&] { return calls_[step] > 0; });
    }
    /// Whether the thread that ran searches has found no other work.
    bool worker_rests() {
        const std::scoped_lock lock(mutex_);
        return test_support::sleeps(worker_);
    }

  private:
    bool obedient_;
    std::mutex mutex_;
    std::condition_variable called_;
    pid_t worker_ = 0;
    std::map<std::uint32_t, int> calls_;
    std::counting_semaphore<> started_{0}, release_{0};
};

} // namespace isochron::index
