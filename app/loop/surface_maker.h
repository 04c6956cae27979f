// Surfaces that a session exports as files: in the background, so that no frame waits.
#pragma once

#include "app/frame/asker.h"
#include "app/frame/explorer_state.h"
#include "app/loop/companion.h"
#include "app/scene/color_scale.h"
#include "index/file/index_file.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace isochron::app {

struct ExportTask;

/// Makes one export at a time, under names that no file has: `isochron_surface_0001.ply`, and of
/// several steps `isochron_surface_0001_0007.ply` and so on. An export that is canceled or fails
/// leaves the whole files that it has written, and no part of one. The maker's end cancels an export.
class SurfaceMaker final : public Companion {
  public:
    /// @param file all its arrays
    /// @param folder of the files, unless the user chooses another one
    SurfaceMaker(std::shared_ptr<const index::IndexFile> file, std::filesystem::path folder);

    void set_wake(std::function<void()> wake) override { exports_.set_wake(std::move(wake)); }
    /// Begins or cancels an export as the state asks for, and tells how far it is.
    void before_frame(Session& session, const interaction::Commands& by_user,
                      interaction::Commands& asked) override;

    /// Once a frame; never waits. Begins the export that the state asks for, of what the state shows,
    /// or cancels the one that it no longer asks for. @param scale of the picture's colors, if it has
    /// one: called when an export begins; may be null. @return how far the export is, if that is new
    std::optional<interaction::ExportWork>
    update(const ExplorerState& state,
           const std::function<std::optional<ColorScale>()>& scale = {});
    /// One line for each export that has ended since the last call: its files, or the error.
    std::vector<std::string> messages() override { return std::exchange(messages_, {}); }
    /// Cancels an unfinished export, and waits for its end. @return as `messages`
    std::vector<std::string> finish();
    std::vector<std::string> finish(const Session&) override { return finish(); }
    void save(const Session&) override {} ///< an export that goes on ends with its process

  private:
    void begin(const ExplorerState& state, std::optional<ColorScale> scale);
    void take_ended();

    std::shared_ptr<const index::IndexFile> file_;
    const std::filesystem::path folder_;
    bool goes_on_ = false;   ///< an export
    std::uint32_t told_ = 0; ///< how far it is [%]
    std::vector<std::string> messages_;
    Asker<ExportTask, std::string> exports_;
};

} // namespace isochron::app
