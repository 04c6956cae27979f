// Measures surfaces at all steps.
#include "app/session/curve_maker.h"

#include "index/error.h"
#include "index/extraction/value_in_index.h"
#include "index/measure/measures.h"
#include "index/system/memory_limit.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <limits>
#include <memory>
#include <new>

#include <sys/resource.h>
#include <unistd.h>

namespace isochron::app {

CurveMaker::CurveMaker(Measure measure)
    : tools_{std::move(measure), {}},
      asker_(do_task, [](const Task& task, const std::string& why, bool canceled) {
          return Done{task.subject, canceled ? std::string() : why};
      }) {}

CurveMaker::Job* CurveMaker::job_of(const CurveSubject& subject) {
    const auto job = std::ranges::find(
        jobs_, subject, [](const Job& each) -> const CurveSubject& { return each.curve.subject; });
    return job == jobs_.end() ? nullptr : &*job;
}

const StepCurvePtr& CurveMaker::share(Job& job) {
    if (!job.shared)
        job.shared = std::make_shared<const StepCurve>(job.curve);
    return job.shared;
}

void CurveMaker::update(const WantedCurves& wanted) {
    take();
    if (wanted.subjects != wanted_.subjects) {
        std::vector<Job> jobs;
        for (const CurveSubject& subject : wanted.subjects)
            if (Job* const there = job_of(subject))
                jobs.push_back(*there);
            else
                jobs.push_back({{subject, numbers_of(subject), subject.array->info().steps()}});
        jobs_ = std::move(jobs);
        failure_.clear();
        if (asked_ && !job_of(*asked_))
            asker_.cancel();
    }
    wanted_ = wanted;
    ask();
}

std::vector<StepCurvePtr> CurveMaker::curves() {
    std::vector<StepCurvePtr> all;
    std::ranges::transform(jobs_, std::back_inserter(all), share);
    return all;
}

void CurveMaker::finish() {
    while (asked_) {
        asker_.finish();
        take();
        ask();
    }
}

void CurveMaker::take() {
    for (Done& done : asker_.take()) {
        asked_.reset();
        Job* const job = job_of(done.subject);
        if (!job) // it has gone meanwhile
            continue;
        job->looked = true;
        if (!done.failure.empty())
            failure_ = done.failure;
        if (done.kept)
            job->curve = std::move(*done.kept);
        for (const auto& [step, numbers] : done.steps)
            job->curve.set(step, numbers);
        if (done.kept || !done.steps.empty())
            job->shared.reset();
        job->measured |= !done.steps.empty();
    }
}

void CurveMaker::ask() {
    if (asked_)
        return;
    if (std::optional<Task> task = next()) {
        asked_ = task->subject;
        asker_.ask(std::move(*task));
    }
}

/// The surfaces take turns, so that their curves grow together.
std::optional<CurveMaker::Task> CurveMaker::next() {
    if (wanted_.paused)
        return std::nullopt;
    const Job* next = nullptr;
    for (Job& job : jobs_) {
        if (tools_.kept && !job.looked)
            return Task{&tools_, job.curve.subject};
        if (tools_.kept && job.curve.left == 0 && failure_.empty() &&
            std::exchange(job.measured, false))
            return Task{&tools_, job.curve.subject, {}, share(job)};
        if (job.curve.left > (next ? next->curve.left : 0))
            next = &job;
    }
    return next ? std::optional(Task{&tools_, next->curve.subject, next_steps(next->curve)})
                : std::nullopt;
}

/// The shown step, then those at hand, then the others: each time the nearest one.
std::vector<std::uint32_t> CurveMaker::next_steps(const StepCurve& curve) const {
    constexpr std::size_t kMost = 64;
    const auto now = static_cast<std::int64_t>(wanted_.now);
    const auto away = [&](std::int64_t step) { return std::abs(step - now); };
    std::vector<std::uint32_t> steps;
    const auto add = [&](std::int64_t at) {
        const auto step = static_cast<std::uint32_t>(at);
        if (at >= 0 && step < curve.steps() && !curve.known[step] && steps.size() < kMost &&
            std::ranges::find(steps, step) == steps.end())
            steps.push_back(step);
    };
    add(now);
    std::vector<std::uint32_t> at_hand = wanted_.at_hand;
    std::ranges::stable_sort(at_hand, {}, away);
    std::ranges::for_each(at_hand, add);
    for (std::int64_t off = 1; steps.size() < std::min(kMost, curve.left); ++off) {
        add(now + off);
        add(now - off);
    }
    return steps;
}

CurveMaker::Done CurveMaker::do_task(const Task& task, const Asking& asking) {
    constexpr int kPolitest = 19; // behind all that draws and searches for the picture
    setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kPolitest);
    Done done{task.subject};
    if (task.whole)
        task.tools->kept->write(*task.whole);
    else if (task.steps.empty())
        done.kept = task.tools->kept->read(task.subject);
    constexpr std::chrono::milliseconds kTurn(50);
    const auto ends = std::chrono::steady_clock::now() + kTurn;
    for (const std::uint32_t step : task.steps) {
        std::optional<std::vector<double>> numbers;
        try {
            numbers = task.tools->measure(task.subject, step, asking.stop);
            if (!numbers)
                break; // stopped
        } catch (const std::bad_alloc&) { // the other steps may be whole
            done.failure = index::shortage_of_memory();
        } catch (const std::exception& error) {
            done.failure = error.what();
        }
        done.steps.emplace_back(
            step, numbers.value_or(std::vector(numbers_of(task.subject),
                                               std::numeric_limits<double>::quiet_NaN())));
        if (std::chrono::steady_clock::now() > ends)
            break;
    }
    return done;
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
