// Reads steps on several threads, ahead of the thread that takes them.
#include "index/build/parallel_steps.h"

#include <algorithm>
#include <utility>

namespace isochron::index {
namespace {

constexpr std::size_t kMostHeld = 128 << 20; ///< [bytes] of steps in memory
constexpr unsigned kMostReaders = 8;

} // namespace

unsigned ParallelSteps::readers_for(const VolumeSeries& series, std::size_t steps,
                                    unsigned threads) {
    const std::size_t fit = kMostHeld / std::max<std::size_t>(1, series.info().step_bytes());
    const std::size_t readers =
        std::min<std::size_t>({threads, kMostReaders, steps, fit - std::min<std::size_t>(fit, 1)});
    return readers > 1 && series.another() ? static_cast<unsigned>(readers) : 0;
}

ParallelSteps::ParallelSteps(const VolumeSeries& series, std::size_t begin, std::size_t end,
                             unsigned readers)
    : begin_(begin), end_(end), steps_(readers + 1) {
    for (Step& step : steps_)
        step.values.resize(series.info().step_bytes());
    for (unsigned i = 0; i < readers; ++i)
        series_.push_back(series.another());
    for (const auto& one : series_)
        readers_.emplace_back([this, &one](const std::stop_token& stop) { run(stop, *one); });
}

ParallelSteps::~ParallelSteps() = default;

void ParallelSteps::run(const std::stop_token& stop, VolumeSeries& series) {
    std::unique_lock lock(mutex_);
    // The step that was given last is still in use.
    const auto has_room = [this] {
        return taken_ < given_ - std::min<std::size_t>(given_, 1) + steps_.size();
    };
    while (changed_.wait(lock, stop, has_room) && !stop.stop_requested()) {
        if (begin_ + taken_ >= end_)
            return;
        const std::size_t number = taken_++;
        Step& step = steps_[number % steps_.size()];
        lock.unlock();
        std::exception_ptr failure;
        try {
            series.read(begin_ + number, step.values);
        } catch (...) {
            failure = std::current_exception();
        }
        lock.lock();
        step.failure = failure;
        step.there = true;
        changed_.notify_all();
    }
}

std::span<const std::byte> ParallelSteps::next() {
    std::unique_lock lock(mutex_);
    if (given_ > 0) // the step given before may be overwritten now
        steps_[(given_ - 1) % steps_.size()].there = false;
    Step& step = steps_[given_++ % steps_.size()];
    changed_.notify_all();
    changed_.wait(lock, [&] { return step.there; });
    if (step.failure)
        std::rethrow_exception(step.failure);
    return step.values;
}

} // namespace isochron::index
