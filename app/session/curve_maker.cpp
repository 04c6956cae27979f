// Measures surfaces at all steps, on a thread of its own.
#include "app/session/curve_maker.h"

#include "index/error.h"
#include "index/extraction/value_in_index.h"
#include "index/measure/measures.h"
#include "index/system/memory_limit.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <memory>
#include <new>

#include <sys/resource.h>
#include <unistd.h>

namespace isochron::app {

CurveMaker::CurveMaker(Measure measure)
    : measure_(std::move(measure)), worker_([this](const std::stop_token& stop) { work(stop); }) {}

CurveMaker::~CurveMaker() {
    worker_.request_stop();
    const std::scoped_lock lock(mutex_);
    stop_step_.request_stop();
}

void CurveMaker::set_wake(std::function<void()> wake) {
    const std::scoped_lock lock(mutex_);
    wake_ = std::move(wake);
}

void CurveMaker::keep_in(KeptCurves kept) {
    const std::scoped_lock lock(mutex_);
    kept_ = std::move(kept);
}

CurveMaker::Job* CurveMaker::job_of(const CurveSubject& subject) {
    const auto job = std::ranges::find(
        jobs_, subject, [](const Job& each) -> const CurveSubject& { return each.curve.subject; });
    return job == jobs_.end() ? nullptr : &*job;
}

void CurveMaker::update(const WantedCurves& wanted) {
    const std::scoped_lock lock(mutex_);
    if (wanted == wanted_)
        return;
    if (wanted.subjects != wanted_.subjects) {
        std::vector<Job> jobs;
        for (const CurveSubject& subject : wanted.subjects)
            if (Job* const there = job_of(subject))
                jobs.push_back(*there);
            else
                jobs.push_back({{subject, numbers_of(subject), subject.array->info().steps()}});
        jobs_ = std::move(jobs);
        failure_.clear();
        if (measured_ && !job_of(*measured_))
            stop_step_.request_stop();
    }
    wanted_ = wanted;
    changed_.notify_all();
}

std::vector<StepCurvePtr> CurveMaker::curves() {
    const std::scoped_lock lock(mutex_);
    std::vector<StepCurvePtr> all;
    for (Job& job : jobs_) {
        if (!job.shared)
            job.shared = std::make_shared<const StepCurve>(job.curve);
        all.push_back(job.shared);
    }
    return all;
}

std::string CurveMaker::failure() const {
    const std::scoped_lock lock(mutex_);
    return failure_;
}

void CurveMaker::finish() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return !measured_ && !next(); });
}

/// The shown step, then those at hand, then the others: each time the nearest one.
std::optional<std::uint32_t> CurveMaker::next_step(const Job& job) const {
    const auto steps = static_cast<std::uint32_t>(job.curve.steps());
    const auto unknown = [&](std::uint32_t step) { return step < steps && !job.curve.known[step]; };
    if (unknown(wanted_.now))
        return wanted_.now;
    if (!wanted_.rest || job.curve.left == 0)
        return std::nullopt;
    const auto away = [&](std::uint32_t step) {
        return std::abs(static_cast<std::int64_t>(step) - static_cast<std::int64_t>(wanted_.now));
    };
    std::optional<std::uint32_t> nearest;
    for (const std::uint32_t step : wanted_.at_hand)
        if (unknown(step) && (!nearest || away(step) < away(*nearest)))
            nearest = step;
    for (std::uint32_t off = 1; !nearest; ++off)
        if (wanted_.now + off < steps && unknown(wanted_.now + off))
            nearest = wanted_.now + off;
        else if (wanted_.now >= off && unknown(wanted_.now - off))
            nearest = wanted_.now - off;
    return nearest;
}

/// The surfaces take turns, so that their curves grow together.
std::optional<CurveMaker::Task> CurveMaker::next() const {
    if (wanted_.paused)
        return std::nullopt;
    std::optional<Task> next;
    for (std::size_t i = 0; i < jobs_.size(); ++i) {
        if (kept_ && wanted_.rest && !jobs_[i].looked)
            return Task{i, std::nullopt};
        const auto step = next_step(jobs_[i]);
        if (step && (!next || jobs_[i].curve.left > jobs_[next->job].curve.left))
            next = Task{i, step};
    }
    return next;
}

void CurveMaker::do_task(const Task& task, std::unique_lock<std::mutex>& lock) {
    const CurveSubject subject = jobs_[task.job].curve.subject;
    measured_ = subject;
    stop_step_ = std::stop_source();
    const std::stop_token stop = stop_step_.get_token();
    std::optional<std::vector<double>> numbers;
    std::optional<StepCurve> kept;
    std::string why;
    lock.unlock();
    try {
        if (task.step)
            numbers = measure_(subject, *task.step, stop);
        else
            kept = kept_->read(subject);
    } catch (const std::bad_alloc&) {
        why = index::shortage_of_memory();
    } catch (const std::exception& error) {
        why = error.what();
    }
    lock.lock();
    Job* const job = job_of(subject); // it may have gone meanwhile
    if (!job)
        return;
    job->looked = true;
    if (kept)
        job->curve = std::move(*kept);
    if (!why.empty()) { // the other steps may be whole
        failure_ = why;
        numbers.emplace(job->curve.values.size(), std::numeric_limits<double>::quiet_NaN());
    }
    if (task.step && numbers)
        job->curve.set(*task.step, *numbers);
    job->shared.reset();
    if (!kept_ || !numbers || job->curve.left > 0 || !failure_.empty())
        return;
    const StepCurve whole = job->curve;
    lock.unlock();
    kept_->write(whole);
    lock.lock();
}

void CurveMaker::work(const std::stop_token& stop) {
    constexpr int kPolitest = 19; // behind all that draws and searches for the picture
    setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kPolitest);
    std::unique_lock lock(mutex_);
    std::optional<Task> task;
    while (changed_.wait(lock, stop, [&] { return (task = next()).has_value(); }) &&
           !stop.stop_requested()) {
        do_task(*task, lock);
        measured_.reset();
        changed_.notify_all();
        const std::function<void()> wake = wake_;
        lock.unlock();
        if (wake)
            wake();
        lock.lock();
    }
}

namespace {

/// The index of the array that was asked for last, opened once more.
struct OwnIndex {
    std::shared_ptr<const index::IndexFile> asked, own;
    std::optional<index::SurfaceMeasures> measures;

    void open(const std::shared_ptr<const index::IndexFile>& array) {
        constexpr std::uint64_t kCache = 64 << 20;
        measures.reset();
        asked = own = array;
        try {
            const auto file = index::IndexFile::open(array->name(), kCache);
            const auto number = file->array_called(array->info().array);
            if (number && file->array(*number).content_hash() == array->content_hash() &&
                file->array(*number).info().steps() == array->info().steps())
                own = index::array_of(file, *number);
        } catch (const index::Error&) { // it has no name any more: the open one serves as well
        }
    }
};

} // namespace

CurveMaker::Measure measured_in_index() {
    return [of = std::make_shared<OwnIndex>()](
               const CurveSubject& subject, std::uint32_t step,
               const std::stop_token& stop) -> std::optional<std::vector<double>> {
        if (of->asked != subject.array)
            of->open(subject.array);
        if (subject.place)
            return std::vector{index::value_in(*of->own, index::Instant(step), *subject.place)
                                   .value_or(std::numeric_limits<double>::quiet_NaN())};
        if (!of->measures)
            of->measures.emplace(of->own);
        index::MeasureWishes wishes{.array = subject.on_surface, .kept = subject.kept};
        if (subject.clip)
            wishes.clip = index::CutPlane{subject.clip->point, subject.clip->normal};
        wishes.box = subject.box;
        wishes.from = subject.from;
        auto found = of->measures->measure({index::Instant(step), subject.isovalue}, wishes, stop);
        return found ? std::optional(std::move(found->values)) : std::nullopt;
    };
}

} // namespace isochron::app
