// The background worker.
#include "index/extraction/extractor.h"

#include "index/system/kept_memory.h"

#include <condition_variable>
#include <mutex>
#include <new>
#include <thread>
#include <utility>

namespace isochron::index {
namespace {

using Clock = std::chrono::steady_clock;

/// Whether what was extracted for one query is what another asks for.
bool answers(const SurfacesQuery& query, const SurfacesQuery& wanted) {
    return query.instant == wanted.instant && same_but_for_step(query, wanted) &&
           query.mesh_room >= wanted.mesh_room;
}

} // namespace

bool is_worth_finishing(std::chrono::nanoseconds since_start, std::chrono::nanoseconds last_took) {
    constexpr std::chrono::milliseconds kWorthIt{5};
    return last_took >= kWorthIt && 4 * since_start >= last_took && since_start <= 2 * last_took;
}

struct Extractor::State {
    struct Job {
        SurfacesQuery query;
        bool prefetch;
        ExtractionPtr meshes_of; ///< the job makes meshes of it; null: it extracts
        std::uint64_t times_forgotten;
        std::stop_source stop;
        Clock::time_point started = Clock::now();
    };
    struct Outcome {
        ExtractionPtr extraction; ///< null: stopped or failed
        std::string failure;      ///< empty unless failed
    };

    State(Extract e, std::uint64_t room) : extract(std::move(e)), recent(room) {}

    /// The next query to prefetch, if any.
    std::optional<SurfacesQuery> prefetch_wanted() const {
        if (!wanted || !wanted->ahead || in_flux || prefetch_done)
            return {};
        const auto step = recent.missing(wanted->query, *wanted->ahead);
        if (!step)
            return {};
        SurfacesQuery query = wanted->query;
        query.instant = Instant(*step);
        return query;
    }
    /// What meshes are still to be made of; null: nothing.
    ExtractionPtr meshes_wanted() const {
        const ExtractionPtr set = wanted && answered && !in_flux ? wanted->meshes_of : nullptr;
        const bool may_have = set && set != not_meshed && !set->coarse() && set->cells() > 0;
        return may_have && !set->later->get() ? set : nullptr;
    }
    /// Whether meshes are being made of the cells of this request, which may ask for other parts of
    /// them in each frame that moves: they come first, for a moment, or they would never come.
    bool finishes_meshes(const Request& request) const {
        constexpr std::chrono::seconds kMoment{1};
        return running && running->meshes_of && !request.before_meshes &&
               running->meshes_of->query.of_cells() == request.query.of_cells() &&
               Clock::now() - running->started < kMoment;
    }
    bool has_work() const { return (wanted && !answered) || meshes_wanted() || prefetch_wanted(); }

    bool await_work(std::unique_lock<std::mutex>& lock, const std::stop_token& stop);
    void work(const std::stop_token& stop);
    void add_meshes(const ExtractionPtr& set, std::unique_lock<std::mutex>& lock);
    SimplifiedMeshesPtr meshes_of(const ExtractionPtr& set, std::uint64_t room,
                                  const std::stop_token& stop) const;
    Outcome run(const Job& job);
    void finish(const Job& job, const Outcome& outcome);
    void tell(std::unique_lock<std::mutex>& lock) const;

    const Extract extract;
    mutable std::mutex mutex; ///< for the members below; held for a few assignments only
    mutable std::condition_variable_any changed;
    std::optional<Request> wanted;
    bool answered = false;        ///< the wanted query has been shown or has failed
    bool in_flux = false;         ///< the newest request is for other surfaces than the one before
    bool prefetch_done = false;   ///< the wanted prefetch need not be tried again
    bool abandoned = false;       ///< the last search was abandoned, so the next one is finished
    Clock::duration last_took{0}; ///< how long the last answer that was found took
    std::uint64_t times_forgotten = 0;
    std::optional<Job> running;
    RecentExtractions recent;
    ExtractionPtr shown, not_meshed; ///< the second: it cannot have meshes
    std::optional<std::string> failure;
    std::function<void()> wake; ///< may be null
    std::jthread worker; ///< last, so that it starts after and ends before everything it uses
};

/// After a while without work, the memory of earlier meshes is given back to the system.
/// @return false when there is none and the thread shall end
bool Extractor::State::await_work(std::unique_lock<std::mutex>& lock, const std::stop_token& stop) {
    constexpr std::chrono::seconds kUntilFreed{3};
    const auto any = [this] { return has_work(); };
    if (changed.wait_for(lock, stop, kUntilFreed, any) || stop.stop_requested())
        return has_work();
    lock.unlock();
    free_kept();
    lock.lock();
    return changed.wait(lock, stop, any);
}

void Extractor::State::work(const std::stop_token& stop) {
    std::unique_lock lock(mutex);
    while (await_work(lock, stop)) {
        if (stop.stop_requested())
            return;
        if (const ExtractionPtr set = meshes_wanted()) {
            add_meshes(set, lock);
            continue;
        }
        const bool prefetch = answered;
        const SurfacesQuery query = prefetch ? *prefetch_wanted() : wanted->query;
        if (ExtractionPtr known =
                recent.find(query)) { // only for a request: kept steps are never prefetched
            answered = true;
            failure.reset();
            shown.swap(known);
            changed.notify_all();
            tell(lock);
            known.reset(); // what was shown may be freed here
            lock.lock();
            continue;
        }
        running = Job{query, prefetch, nullptr, times_forgotten, {}};
        const Job job = *running;
        lock.unlock();
        finish(job, run(job));
        lock.lock();
    }
}

/// Like work that is done ahead, it ends when another query comes.
void Extractor::State::add_meshes(const ExtractionPtr& set, std::unique_lock<std::mutex>& lock) {
    running = Job{set->query, true, set, times_forgotten, {}};
    const Job job = *running;
    const std::uint64_t room = wanted->later_room;
    lock.unlock();
    SimplifiedMeshesPtr made;
    try {
        made = meshes_of(set, room, job.stop.get_token());
    } catch (const std::exception&) { // the picture goes on without them
    }
    lock.lock();
    running.reset();
    RecentExtractions::Dropped dropped; // freed without the lock
    if (made && job.times_forgotten == times_forgotten) {
        set->later->put(std::move(made));
        dropped = recent.count_again(set, wanted->ahead);
    } else if (!job.stop.stop_requested()) {
        not_meshed = set;
    }
    changed.notify_all();
    tell(lock);
    dropped.clear();
    lock.lock();
}

/// Extracts the cells once more with a mesh where they came without one: most of what the search
/// and the reading need is still there.
/// @return null: stopped, or there are none
SimplifiedMeshesPtr Extractor::State::meshes_of(const ExtractionPtr& set, std::uint64_t room,
                                                const std::stop_token& stop) const {
    constexpr std::uint64_t kMeanwhile = 4; // so many times the room may be taken
    ExtractionPtr meshed = set;
    if (!set->meshed()) {
        SurfacesQuery query = set->query;
        query.mesh_room = kMeanwhile * room;
        meshed = extract(query, stop);
        if (!meshed || !meshed->meshed() || meshed->cells() != set->cells())
            return nullptr;
    }
    const SimplifiedMeshesPtr simplified = index::simplified(meshed->surfaces, stop);
    if (!simplified)
        return nullptr;
    auto made = std::make_shared<SimplifiedMeshes>(*simplified);
    if (meshed != set)
        made->levels[0] = meshed->meshes(0);
    made->fit(room);
    return made;
}

/// Gives up the lock and wakes who waits for a picture.
void Extractor::State::tell(std::unique_lock<std::mutex>& lock) const {
    const std::function<void()> told = wake;
    lock.unlock();
    if (told)
        told();
}

Extractor::State::Outcome Extractor::State::run(const Job& job) {
    try {
        ExtractionPtr extraction = extract(job.query, job.stop.get_token());
        if (!extraction && !job.stop.stop_requested())
            return {nullptr, "the extraction gave no result"};
        return {std::move(extraction), {}};
    } catch (const std::bad_alloc&) {
        return {nullptr, "there is not enough memory for these cells"};
    } catch (const std::exception& error) {
        return {nullptr, error.what()};
    } catch (...) {
        return {nullptr, "unknown failure of the extraction"};
    }
}

void Extractor::State::finish(const Job& job, const Outcome& outcome) {
    ExtractionPtr replaced = outcome.extraction; // freed after the lock
    RecentExtractions::Dropped dropped;
    {
        std::unique_lock lock(mutex);
        running.reset();
        const bool stopped = job.stop.stop_requested();
        const bool is_answer = answers(job.query, wanted->query) && !answered;
        // The result of an older request comes too late once the newest request is answered.
        const bool shows = is_answer || (!job.prefetch && !answered);
        if (job.times_forgotten != times_forgotten) {
            // Started before `forget`: its result is not wanted.
        } else if (outcome.extraction) {
            dropped = recent.add(outcome.extraction, wanted->ahead);
            if (is_answer)
                answered = true;
            if (!job.prefetch)
                last_took = Clock::now() - job.started;
            if (shows) {
                failure.reset();
                shown.swap(replaced);
            }
        } else if (!outcome.failure.empty() && !stopped) {
            // A failed prefetch is not reported, since that step has not been requested yet.
            if (shows)
                failure = outcome.failure;
            if (is_answer)
                answered = true;
        }
        // Prefetching ends after a step that failed, and once the only step asked for is there.
        if (job.prefetch && !stopped && wanted->ahead)
            prefetch_done = outcome.extraction ? wanted->ahead->steps == 0 &&
                                                     wanted->ahead->next == job.query.instant.step
                                               : same_but_for_step(job.query, wanted->query);
        if (!job.prefetch)
            abandoned = !outcome.extraction && stopped;
        changed.notify_all();
        tell(lock);
    }
}

Extractor::Extractor(Extract extract, std::uint64_t room)
    : state_(std::make_unique<State>(std::move(extract), room)) {
    state_->worker =
        std::jthread([state = state_.get()](std::stop_token stop) { state->work(stop); });
}

Extractor::~Extractor() {
    std::optional<std::stop_source> stop;
    {
        const std::scoped_lock lock(state_->mutex);
        if (state_->running)
            stop = state_->running->stop;
    }
    state_->worker.request_stop();
    if (stop)
        stop->request_stop();
}

void Extractor::set_wake(std::function<void()> wake) {
    const std::scoped_lock lock(state_->mutex);
    state_->wake = std::move(wake);
}

void Extractor::request(const Request& request) {
    std::optional<std::stop_source>
        stop;            // used after the lock: it may run callbacks of the extraction
    ExtractionPtr known; // and what was shown is freed after it, too
    {
        const std::scoped_lock lock(state_->mutex);
        State& s = *state_;
        const bool same_query = s.wanted && answers(s.wanted->query, request.query);
        const bool was_in_flux = std::exchange(
            s.in_flux, s.wanted && !same_but_for_step(s.wanted->query, request.query));
        if (same_query && s.wanted->ahead == request.ahead &&
            s.wanted->meshes_of == request.meshes_of &&
            s.wanted->later_room == request.later_room && !was_in_flux)
            return;
        s.wanted = request;
        s.prefetch_done = false;
        if (!same_query) {
            known = s.recent.find(request.query);
            s.answered = known != nullptr;
            if (known) {
                s.failure.reset();
                s.shown.swap(known);
            }
            // If this request is answered at once, a running prefetch for its surfaces goes on, and so
            // do meshes that are still wanted.
            const bool going_on =
                s.answered && s.running && s.running->prefetch &&
                (s.running->meshes_of ? s.running->meshes_of == request.meshes_of
                                      : same_but_for_step(s.running->query, request.query));
            // Time that plays between steps asks for another moment in every frame.
            const bool shown_late = s.running && !s.running->prefetch &&
                                    s.running->query.instant.between() &&
                                    request.query.instant.between() &&
                                    same_but_for_step(s.running->query, request.query);
            const bool obsolete = s.running && !going_on && !shown_late &&
                                  !s.finishes_meshes(request) &&
                                  !answers(s.running->query, request.query);
            const auto finishes = [&s] {
                return s.abandoned ||
                       is_worth_finishing(Clock::now() - s.running->started, s.last_took);
            };
            if (obsolete && (s.running->prefetch || !finishes()))
                stop = s.running->stop;
        }
    }
    if (stop)
        stop->request_stop();
    state_->changed.notify_all();
}

void Extractor::forget() {
    RecentExtractions::Dropped freed; // after the lock
    std::optional<std::stop_source> stop;
    {
        const std::scoped_lock lock(state_->mutex);
        freed = state_->recent.take_all();
        state_->answered = false;
        state_->prefetch_done = false;
        ++state_->times_forgotten;
        if (state_->running)
            stop = state_->running->stop;
    }
    if (stop)
        stop->request_stop();
    state_->changed.notify_all();
}

ExtractionPtr Extractor::newest() const {
    const std::scoped_lock lock(state_->mutex);
    return state_->shown;
}

std::vector<std::uint32_t> Extractor::at_hand() const {
    const std::scoped_lock lock(state_->mutex);
    return state_->wanted ? state_->recent.steps(state_->wanted->query)
                          : std::vector<std::uint32_t>();
}

std::optional<std::string> Extractor::failure() const {
    const std::scoped_lock lock(state_->mutex);
    return state_->failure;
}

bool Extractor::busy() const {
    const std::scoped_lock lock(state_->mutex);
    return state_->wanted && !state_->answered;
}

void Extractor::wait() const {
    std::unique_lock lock(state_->mutex);
    state_->changed.wait(
        lock, [this] { return !state_->wanted || (state_->answered && !state_->meshes_wanted()); });
}

} // namespace isochron::index
