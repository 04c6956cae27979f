// Surveys the step that is shown beside the frames.
#include "app/session/step_surveyor.h"

#include "index/file/chunks/chunk_store.h"

#include <algorithm>
#include <cstddef>
#include <string>

namespace isochron::app {
namespace {

using index::IndexFile;

/// Vertices that are surveyed: a step of more is surveyed at a coarser level of detail.
constexpr std::uint64_t kMostSurveyed = 3'000'000;
/// Steps on either side that are looked at for other values.
constexpr std::uint32_t kFarthestStep = 256;

StepSurvey survey_at(const IndexFile& array, std::uint32_t step, std::size_t level,
                     const std::stop_token& stop) {
    const index::LoadedStep loaded =
        level > 0 ? array.chunks(level).whole(step) : array.load(step, stop);
    return survey_of(loaded.values, step, level == 0);
}

/// The nearest step that has different values at the coarsest level of detail.
std::optional<std::uint32_t> step_with_surface(const IndexFile& array, std::uint32_t step,
                                               const std::stop_token& stop) {
    const std::size_t coarsest = array.detail_levels() - 1;
    const auto steps = static_cast<std::uint32_t>(array.info().steps());
    const auto serves = [&](std::uint32_t other) {
        const StepSurvey there = survey_at(array, other, coarsest, stop);
        return there.has_values() && !there.is_constant();
    };
    for (std::uint32_t away = 1; away <= kFarthestStep && !stop.stop_requested(); ++away) {
        if (step + away < steps && serves(step + away))
            return step + away;
        if (step >= away && serves(step - away))
            return step - away;
    }
    return std::nullopt;
}

} // namespace

StepSurveyor::StepSurveyor()
    : asking_(survey_one, [](const What& what, const std::string&, bool) {
          return Found{what, std::nullopt}; // the search for the picture tells what cannot be read
      }) {}

StepSurveyor::Found StepSurveyor::survey_one(const What& what, const Asking& asking) {
    const IndexFile& array = *what.array;
    std::size_t level = 0;
    while (level + 1 < array.detail_levels() &&
           array.chunks(level).info().grid.vertex_count() > kMostSurveyed)
        ++level;
    Found found{what, survey_at(array, what.step, level, asking.stop)};
    if (!found.survey->has_values() || found.survey->is_constant())
        found.survey->other_step = step_with_surface(array, what.step, asking.stop);
    return found;
}

void StepSurveyor::take() {
    for (Found& found : asking_.take())
        if (found.survey)
            found_ = std::move(found);
}

void StepSurveyor::update(const std::shared_ptr<const IndexFile>& array, std::uint32_t step,
                          bool rests) {
    take();
    wanted_ = {array, step};
    if (!rests || asked_ == wanted_)
        return;
    asking_.cancel();
    asking_.ask(wanted_);
    asked_ = wanted_;
}

void StepSurveyor::finish() {
    asking_.finish();
    take();
}

} // namespace isochron::app
