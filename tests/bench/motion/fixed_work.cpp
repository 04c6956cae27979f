// Works on all processors in pieces of one size.
#include "tests/bench/motion/fixed_work.h"

#include "app/frame/pacer.h"
#include "index/system/parallel.h"
#include "tests/bench/measures/stopwatch.h"

#include <algorithm>
#include <atomic>
#include <chrono>

namespace isochron::bench {
namespace {

using WorkClock = std::chrono::steady_clock;

/// Arithmetic that no compiler leaves out.
std::uint64_t arithmetic(std::uint64_t rounds) {
    std::uint64_t state = rounds | 1;
    for (std::uint64_t i = 0; i < rounds; ++i)
        state = state * 6364136223846793005u + 1442695040888963407u;
    return state;
}

std::atomic<std::uint64_t> kept = 0;

double ms_of_rounds(std::uint64_t rounds) {
    const unsigned threads = index::thread_count(0);
    const auto began = WorkClock::now();
    index::parallel_for(
        threads, threads, [&](std::size_t, unsigned) { kept = arithmetic(rounds); }, nullptr);
    return std::chrono::duration<double, std::milli>(WorkClock::now() - began).count();
}

/// Rounds of a millisecond of a processor's time, which other work does not lengthen.
double rounds_per_ms() {
    static const double rate = [] {
        constexpr std::uint64_t kRounds = 20'000'000;
        const Stopwatch watch;
        kept = arithmetic(kRounds);
        return static_cast<double>(kRounds) / (1e3 * watch.seconds());
    }();
    return rate;
}

} // namespace

FixedWork::Late FixedWork::run(double ms, double promised_ms, double seconds,
                               const std::function<void()>& check) const {
    const auto rounds = static_cast<std::uint64_t>(std::max(ms, 0.1) * rounds_per_ms());
    std::size_t pieces = 0, over_two = 0, over_three = 0;
    app::Pacer pacer(1e3 / promised_ms);
    const auto end = WorkClock::now() + std::chrono::duration_cast<WorkClock::duration>(
                                            std::chrono::duration<double>(seconds));
    do {
        check();
        const double took = ms_of_rounds(rounds);
        ++pieces;
        over_two += took > 2 * promised_ms;
        over_three += took > 3 * promised_ms;
        pacer.wait();
    } while (WorkClock::now() < end);
    return {static_cast<double>(over_two) / static_cast<double>(pieces),
            static_cast<double>(over_three) / static_cast<double>(pieces)};
}

} // namespace isochron::bench
