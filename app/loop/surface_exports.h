// Exports surfaces beside a live session.
#pragma once

#include "app/loop/companion.h"
#include "app/loop/surface_maker.h"

#include <filesystem>
#include <memory>
#include <utility>

namespace isochron::app {

class SurfaceExports final : public Companion {
  public:
    /// @param file that is shown @param folder of what is exported
    SurfaceExports(std::shared_ptr<const index::IndexFile> file, std::filesystem::path folder)
        : surfaces_(std::move(file), std::move(folder)) {}

    void set_wake(std::function<void()> wake) override { surfaces_.set_wake(std::move(wake)); }
    /// Begins or cancels an export as the state asks for, and tells how far it is.
    void before_frame(Session& session, const interaction::Commands& by_user,
                      interaction::Commands& asked) override {
        surfaces_.set_file(session.file());
        const auto exported = surfaces_.update(session.state(), [&] { return session.scale(); });
        if (!by_user.exporting && !asked.exporting) // what somebody asks for counts
            asked.exporting = exported;
    }
    std::vector<std::string> messages() override { return surfaces_.messages(); }
    std::vector<std::string> finish(const Session&) override { return surfaces_.finish(); }

  private:
    SurfaceMaker surfaces_;
};

} // namespace isochron::app
