// Runs independent pieces of work on all processors.
#include "index/system/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace isochron::index {

unsigned thread_count(unsigned asked) {
    return asked ? asked : std::max(1u, std::thread::hardware_concurrency());
}

void parallel_for(std::size_t count, unsigned threads,
                  const std::function<void(std::size_t item, unsigned worker)>& work,
                  const std::function<void(double)>& progress) {
    std::atomic<std::size_t> next{0};
    std::mutex failure_mutex;
    std::exception_ptr failure;
    const auto run = [&](unsigned worker, const std::function<void(double)>& report) {
        try {
            if (report)
                report(0.0);
            for (std::size_t item; (item = next.fetch_add(1)) < count;) {
                work(item, worker);
                if (report)
                    report(static_cast<double>(std::min(next.load(), count)) /
                           static_cast<double>(count));
            }
        } catch (...) {
            next = count; // other workers find no more items
            const std::lock_guard lock(failure_mutex);
            if (!failure)
                failure = std::current_exception();
        }
    };
    {
        std::vector<std::jthread> others;
        for (unsigned worker = 1; worker < std::min<std::size_t>(threads, count); ++worker)
            others.emplace_back(run, worker, nullptr);
        run(0, progress);
    }
    if (failure)
        std::rethrow_exception(failure);
}

} // namespace isochron::index
