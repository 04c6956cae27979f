// Reads steps on several threads, ahead of the thread that takes them.
#include "index/indexing/parallel_steps.h"

#include <algorithm>

namespace isochron::index {
namespace {

constexpr std::size_t kMostHeld = 128 << 20; ///< [bytes] of steps in memory
constexpr unsigned kMostReaders = 8;

} // namespace

unsigned ParallelSteps::readers_for(std::span<VolumeSeries* const> arrays, std::size_t steps,
                                    unsigned threads) {
    std::size_t bytes = 0;
    for (const VolumeSeries* array : arrays)
        bytes += array->info().step_bytes();
    const std::size_t fit = kMostHeld / std::max<std::size_t>(1, bytes);
    const std::size_t readers =
        std::min<std::size_t>({threads, kMostReaders, steps, fit - std::min<std::size_t>(fit, 1)});
    const auto can_be_another = [](const VolumeSeries* array) {
        return array->another() != nullptr;
    };
    return readers > 1 && std::ranges::all_of(arrays, can_be_another)
               ? static_cast<unsigned>(readers)
               : 0;
}

ParallelSteps::ParallelSteps(std::span<VolumeSeries* const> arrays, std::size_t begin,
                             std::size_t end, unsigned readers)
    : begin_(begin), end_(end), steps_(readers + 1), arrays_(readers) {
    for (const VolumeSeries* array : arrays) {
        for (Step& step : steps_)
            step.values.emplace_back(array->info().step_bytes());
        for (Arrays& of_reader : arrays_)
            of_reader.push_back(array->another());
    }
    for (const Arrays& of_reader : arrays_)
        readers_.emplace_back(
            [this, &of_reader](const std::stop_token& stop) { run(stop, of_reader); });
}

ParallelSteps::~ParallelSteps() = default;

void ParallelSteps::run(const std::stop_token& stop, const Arrays& arrays) {
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
            for (std::size_t i = 0; i < arrays.size(); ++i)
                arrays[i]->read(begin_ + number, step.values[i]);
        } catch (...) {
            failure = std::current_exception();
        }
        lock.lock();
        step.failure = failure;
        step.there = true;
        changed_.notify_all();
    }
}

std::span<const StepBytes> ParallelSteps::next() {
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
