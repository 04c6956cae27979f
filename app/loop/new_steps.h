// Shows new steps of the index when they come.
#pragma once

#include "app/loop/companion.h"
#include "index/file/index_watch.h"

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <utility>

namespace isochron::app {

class NewSteps final : public Companion {
  public:
    /// @param path of the open index @param wake ends the loop's wait
    NewSteps(std::filesystem::path path, std::shared_ptr<const index::IndexFile> file,
             std::function<void()> wake)
        : watch_(std::move(path), std::move(file), std::move(wake)) {}

    /// Reports new steps as commands, so that recordings and all processes of a cluster get them.
    void before_frame(Session& session, const interaction::Commands&,
                      interaction::Commands& asked) override {
        auto newer = watch_.take();
        if (!newer)
            return;
        const auto steps = static_cast<std::uint32_t>(newer->info().steps());
        session.grow(std::move(newer));
        session.show_messages({fmt::format("{} steps now", steps)});
        asked.steps = steps;
        if (session.state().follow)
            asked.instant.emplace(steps - 1);
    }

  private:
    index::IndexWatch watch_;
};

} // namespace isochron::app
