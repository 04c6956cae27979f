// Measures surfaces at all steps, on a thread of its own that stands behind the picture.
#pragma once

#include "app/frame/step_curve.h"
#include "app/kept/kept_curves.h"

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

namespace isochron::app {

/// What is to be measured.
struct WantedCurves {
    std::vector<CurveSubject> subjects;
    std::uint32_t now = 0;              ///< step that is shown: it comes first
    std::vector<std::uint32_t> at_hand; ///< steps that come next
    bool rest = false;                  ///< also the others, the nearest ones first
    bool paused = false;                ///< no step is begun
    bool operator==(const WantedCurves&) const = default;
};

/// One thread owns the maker: it asks, and takes the curves. Neither ever waits.
class CurveMaker {
  public:
    /// Measures one step, on the maker's thread. @return as many numbers as `numbers_of` says; nothing
    /// when stopped @throws index::Error
    using Measure = std::function<std::optional<std::vector<double>>(
        const CurveSubject&, std::uint32_t step, const std::stop_token&)>;

    explicit CurveMaker(Measure measure);
    ~CurveMaker(); ///< stops the step that is being measured
    CurveMaker(const CurveMaker&) = delete;
    CurveMaker& operator=(const CurveMaker&) = delete;

    /// Sets the function that is called, on the maker's thread, when there is something new.
    void set_wake(std::function<void()> wake);
    /// Keeps whole curves in a folder from now on; before the first `update`.
    void keep_in(KeptCurves kept);

    /// Called once a frame. Subjects that were there before keep what is known of them; a step that is
    /// being measured of another one is given up.
    void update(const WantedCurves& wanted);
    /// The curves of the subjects of the last `update`, in their order.
    std::vector<StepCurvePtr> curves();
    /// Why steps could not be measured, the last reason; empty: all could.
    std::string failure() const;
    /// Blocks until nothing is left to do that may be begun: for replays and tests.
    void finish();

  private:
    /// A subject with what is known of it; `shared` is what was given away last.
    struct Job {
        StepCurve curve;
        bool looked = false;      ///< for a kept one
        StepCurvePtr shared = {}; ///< null: it has changed since
    };
    /// What is done next: a step of a job, or without a step the look for a kept curve.
    struct Task {
        std::size_t job;
        std::optional<std::uint32_t> step;
    };
    std::optional<Task> next() const;
    std::optional<std::uint32_t> next_step(const Job& job) const;
    void work(const std::stop_token& stop);
    void do_task(const Task& task, std::unique_lock<std::mutex>& lock);
    Job* job_of(const CurveSubject& subject);

    const Measure measure_;
    std::optional<KeptCurves> kept_;
    mutable std::mutex mutex_; ///< guards all below
    std::condition_variable_any changed_;
    WantedCurves wanted_;
    std::vector<Job> jobs_;                ///< in the order of the subjects
    std::optional<CurveSubject> measured_; ///< subject of the step that is being measured
    std::stop_source stop_step_;
    std::string failure_;
    std::function<void()> wake_; ///< may be null
    std::jthread worker_;        ///< last member: starts after, and joins before, all the others
};

/// Measures in the index, with a cache of its own, so that the picture's steps stay at hand.
CurveMaker::Measure measured_in_index();

} // namespace isochron::app
