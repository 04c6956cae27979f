// Surveys the step that is shown beside the frames, once it stands still.
#pragma once

#include "app/frame/asker.h"
#include "app/frame/step_survey.h"
#include "index/file/index_file.h"
#include "index/volume/instant.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

namespace isochron::app {

class StepSurveyor {
  public:
    StepSurveyor();

    /// Sets the function that is called, on the surveying thread, when a survey is there.
    void set_wake(std::function<void()> wake) { asking_.set_wake(std::move(wake)); }

    /// Called once a frame. Asks for the survey of a step, unless it is there or on its way, and takes
    /// what has come. @param rests no other step is shown soon: only then is anything asked
    void update(const std::shared_ptr<const index::IndexFile>& array, std::uint32_t step,
                bool rests);
    /// The survey of the step of the last `update`; null before it is there.
    const StepSurvey* survey() const {
        return found_ && found_->what == wanted_ ? &*found_->survey : nullptr;
    }
    /// Blocks until what was asked is there, and takes it.
    void finish();

  private:
    struct What {
        std::shared_ptr<const index::IndexFile> array;
        std::uint32_t step = 0;
        bool operator==(const What&) const = default;
    };
    struct Found {
        What what;
        std::optional<StepSurvey> survey; ///< empty: it could not be read, or nobody waits for it
    };
    static Found survey_one(const What& what, const Asking& asking);
    void take();

    What wanted_;
    std::optional<What> asked_;  ///< the newest question
    std::optional<Found> found_; ///< with a survey
    Asker<What, Found> asking_;
};

} // namespace isochron::app
