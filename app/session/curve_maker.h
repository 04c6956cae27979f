// Measures surfaces at all steps, behind the picture.
#pragma once

#include "app/frame/asker.h"
#include "app/frame/step_curve.h"
#include "app/kept/kept_curves.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

namespace isochron::app {

/// What is to be measured.
struct WantedCurves {
    std::vector<CurveSubject> subjects;
    std::uint32_t now = 0;              ///< step that is shown: it comes first
    std::vector<std::uint32_t> at_hand; ///< steps that come next, before the others
    bool paused = false;                ///< no step is begun
};

/// One thread owns the maker: it asks, and takes the curves. Neither ever waits.
class CurveMaker {
  public:
    /// Measures one step, on the maker's thread. @return as many numbers as `numbers_of` says; nothing
    /// when stopped @throws index::Error
    using Measure = std::function<std::optional<std::vector<double>>(
        const CurveSubject&, std::uint32_t step, const std::stop_token&)>;

    explicit CurveMaker(Measure measure);

    /// Sets the function that is called, on the maker's thread, when there is something new.
    void set_wake(std::function<void()> wake) { asker_.set_wake(std::move(wake)); }
    /// Keeps whole curves in a folder from now on; before the first `update`.
    void keep_in(KeptCurves kept) { tools_.kept = std::move(kept); }

    /// Called once a frame. Subjects that were there before keep what is known of them; a step that is
    /// being measured of another one is given up.
    void update(const WantedCurves& wanted);
    /// The curves of the subjects of the last `update`, in their order.
    std::vector<StepCurvePtr> curves();
    /// Why steps could not be measured, the last reason; empty: all could.
    const std::string& failure() const { return failure_; }
    /// Blocks until nothing is left to do that may be begun: for replays and tests.
    void finish();

  private:
    /// A subject with what is known of it; `shared` is what was given away last.
    struct Job {
        StepCurve curve;
        bool looked = false;      ///< for a kept one
        bool measured = false;    ///< in part, since it was kept
        StepCurvePtr shared = {}; ///< null: it has changed since
    };
    struct Tools {
        Measure measure;
        std::optional<KeptCurves> kept;
    };
    /// What is done next for a subject: the steps in their order, as many as fit in a turn. Without
    /// steps, the whole curve is kept, or looked for if there is none.
    struct Task {
        const Tools* tools;
        CurveSubject subject;
        std::vector<std::uint32_t> steps = {};
        StepCurvePtr whole = {};
    };
    struct Done {
        CurveSubject subject;
        std::string failure = {}; ///< why the last step that failed could not be measured
        std::optional<StepCurve> kept = {};
        std::vector<std::pair<std::uint32_t, std::vector<double>>> steps =
            {}; ///< with their numbers
    };
    static Done do_task(const Task& task, const Asking& asking);
    void take();
    void ask();
    std::optional<Task> next();
    std::vector<std::uint32_t> next_steps(const StepCurve& curve) const;
    Job* job_of(const CurveSubject& subject);
    static const StepCurvePtr& share(Job& job);

    Tools tools_;
    WantedCurves wanted_;
    std::vector<Job> jobs_;             ///< in the order of the subjects
    std::optional<CurveSubject> asked_; ///< subject of the task that is being done
    std::string failure_;
    Asker<Task, Done> asker_; ///< last: its thread uses the tools
};

/// Measures in the index, with a cache of its own, so that the picture's steps stay at hand.
CurveMaker::Measure measured_in_index();

} // namespace isochron::app
