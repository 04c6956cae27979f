// Makes an index in the background.
#include "app/indexing/indexing.h"

#include "app/indexing/file_patterns.h"
#include "app/indexing/kept_index.h"
#include "app/safe_text.h"
#include "index/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <new>
#include <utility>

#include <sys/resource.h>

namespace isochron::app {
namespace {

/// Ends the work from its progress.
struct IndexingStopped {};

/// Pictures go first: the threads and processes that this thread starts from now on get only the
/// processor time that drawing leaves.
void give_way_to_pictures() {
    constexpr int kPolite = 10;
    setpriority(PRIO_PROCESS, 0, kPolite);
}

} // namespace

std::string Indexing::State::line() const {
    if (done)
        return {};
    if (of == 0)
        return "opening";
    const double percent = 100 * fraction;
    return steps == 0 ? fmt::format("indexing {} step{}: {}, {:.0f} %", of, of == 1 ? "" : "s",
                                    phase.empty() ? "reading" : phase, percent)
                      : fmt::format("indexing: {} of {} steps, {:.0f} %", steps, of, percent);
}

Indexing::Indexing(BuildArguments arguments, std::filesystem::path folder, bool asks)
    : arguments_(std::move(arguments)), folder_(std::move(folder)), asks_(asks),
      worker_([this](const std::stop_token& stop) { run(stop); }) {}

Indexing::~Indexing() = default;

Indexing::State Indexing::state() const {
    const std::scoped_lock lock(mutex_);
    return state_;
}

void Indexing::wait_for_opening(std::chrono::milliseconds most) const {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, most,
                      [&] { return state_.of > 0 || state_.done || !state_.offers.empty(); });
}

void Indexing::check() const {
    const std::scoped_lock lock(mutex_);
    if (failed_)
        std::rethrow_exception(failed_);
}

void Indexing::set(const std::function<void(State&)>& change) {
    const std::scoped_lock lock(mutex_);
    change(state_);
    changed_.notify_all();
}

void Indexing::choose(std::size_t offer) {
    const std::scoped_lock lock(mutex_);
    chosen_ = offer;
    changed_.notify_all();
}

bool Indexing::waits_for_choice() const {
    const std::scoped_lock lock(mutex_);
    return !chosen_;
}

/// Offers arrays to the user, and reads their values meanwhile.
std::size_t Indexing::chosen_of(const std::vector<ArrayOffer>& offers,
                                const std::stop_token& stop) {
    set([&](State& state) { state.offers = offers; });
    const auto waits = [&] { return !stop.stop_requested() && waits_for_choice(); };
    const std::vector<std::filesystem::path> files = expand_patterns(arguments_.files);
    for (std::size_t i = 0; i < offers.size() && waits(); ++i)
        if (const auto range = offers[i].fault.empty()
                                   ? first_range(files, arguments_, offers[i].name, waits)
                                   : std::nullopt)
            set([&](State& state) { state.offers[i].range = range; });
    std::unique_lock lock(mutex_);
    if (!changed_.wait(lock, stop, [&] { return chosen_.has_value(); }))
        throw IndexingStopped();
    const ArrayOffer& one = state_.offers.at(*chosen_);
    state_.array = one.name;
    std::ranges::copy_if(state_.offers, std::back_inserter(state_.others), [&](const auto& each) {
        return !each.fault.empty() || each.group != one.group;
    });
    state_.offers.clear();
    return *chosen_;
}

void Indexing::run(const std::stop_token& stop) {
    std::exception_ptr failed;
    std::string failure;
    std::optional<ProgressBar> bar; // beside the window, for who looks there
    try {
        const auto path = kept_index(
            arguments_, folder_,
            {.choose = asks_ ? [&](const auto& offers) { return chosen_of(offers, stop); }
                             : ChooseArray(),
             .opened = [&](std::size_t steps) { set([&](State& state) { state.of = steps; }); },
             .held =
                 [&](const std::filesystem::path& at, std::size_t steps) {
                     set([&](State& state) {
                         state.index = at;
                         state.steps = steps;
                     });
                     give_way_to_pictures();
                 },
             .progress =
                 [&](std::string_view phase, double fraction) {
                     if (stop.stop_requested())
                         throw IndexingStopped();
                     set([&](State& state) {
                         state.phase = phase;
                         state.fraction = fraction;
                     });
                     if (!bar)
                         bar.emplace(stderr, 0, ProgressBar::Of::all);
                     bar->show("indexing", fraction);
                 }});
    } catch (const IndexingStopped&) {
        return;
    } catch (const std::bad_alloc&) {
        failure = "there is not enough memory to index these files";
        failed = std::make_exception_ptr(index::Error(failure));
    } catch (const std::exception& error) {
        failure = one_line(error.what());
        failed = std::current_exception();
    }
    set([&](State& state) {
        failed_ = failed;
        state.failure = failure;
        state.done = true;
    });
}

} // namespace isochron::app
