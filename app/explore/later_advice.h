// Takes the advice on what is shown between two steps again, once all steps are indexed: the first
// steps alone say nothing of it.
#pragma once

#include "app/frame/asker.h"
#include "app/indexing/indexing.h"
#include "app/loop/companion.h"
#include "index/file/index_file.h"
#include "interaction/setting_values.h"

#include <functional>
#include <memory>
#include <optional>

namespace isochron::app {

class LaterAdvice final : public Companion {
  public:
    /// @param is_whole whether the index has all steps, and they are shown
    explicit LaterAdvice(std::function<bool(const Session&)> is_whole);

    void set_wake(std::function<void()> wake) override { asking_.set_wake(std::move(wake)); }
    /// Obeys the advice, and says so, unless the user has chosen meanwhile.
    void before_frame(Session& session, const interaction::Commands& by_user,
                      interaction::Commands& asked) override;

  private:
    using Question = std::shared_ptr<const index::IndexFile>;
    using Answer = std::optional<interaction::BetweenSteps>; ///< empty: it could not be told

    std::function<bool(const Session&)> is_whole_;
    bool asked_ = false, over_ = false;
    Asker<Question, Answer> asking_;
};

/// Whether all steps are indexed, and shown.
std::function<bool(const Session&)> is_whole(const Indexing& indexing);

} // namespace isochron::app
