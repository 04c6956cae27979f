// Surfaces that a session exports as files: in the background, so that no frame waits.
#pragma once

#include "app/frame/background_work.h"
#include "app/frame/explorer_state.h"
#include "app/scene/color_scale.h"
#include "index/file/index_file.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

/// Makes one export at a time, under names that no file has: `isochron_surface_0001.ply`, and of
/// several steps `isochron_surface_0001_0007.ply` and so on. An export that is canceled or fails
/// leaves the whole files that it has written, and no part of one.
class SurfaceMaker {
  public:
    /// @param file all its arrays
    /// @param folder of the files, unless the user chooses another one
    /// @param wake called on another thread when there is something new; may be null
    SurfaceMaker(std::shared_ptr<const index::IndexFile> file, std::filesystem::path folder,
                 std::function<void()> wake);
    ~SurfaceMaker(); ///< cancels an unfinished export
    SurfaceMaker(const SurfaceMaker&) = delete;
    SurfaceMaker& operator=(const SurfaceMaker&) = delete;

    /// Continues with the same data that have more steps.
    void set_file(std::shared_ptr<const index::IndexFile> file) { file_ = std::move(file); }

    /// Once a frame; never waits. Begins the export that the state asks for, of what the state shows,
    /// or cancels the one that it no longer asks for. @param scale of the picture's colors, if it has
    /// one: called when an export begins; may be null. @return how far the export is, if that is new
    std::optional<interaction::ExportWork>
    update(const ExplorerState& state,
           const std::function<std::optional<ColorScale>()>& scale = {});
    /// One line for each export that has ended since the last call: its files, or the error.
    std::vector<std::string> messages() { return work_.messages(); }
    /// Cancels an unfinished export, and waits for its end. @return as `messages`
    std::vector<std::string> finish();

  private:
    struct Export;
    void begin(const ExplorerState& state, std::optional<ColorScale> scale);

    std::shared_ptr<const index::IndexFile> file_;
    const std::filesystem::path folder_;
    const std::function<void()> wake_;
    std::shared_ptr<Export> now_; ///< null: none goes on
    BackgroundWork work_;
};

} // namespace isochron::app
