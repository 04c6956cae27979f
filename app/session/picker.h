// What a ray meets among what is shown, and the data at a place.
#pragma once

#include "app/frame/background_work.h"
#include "app/frame/explorer_state.h"
#include "index/extraction/extraction.h"
#include "index/file/index_file.h"
#include "interaction/device_reading.h"
#include "interaction/pointed.h"
#include "interaction/tracked_input.h"

#include <memory>
#include <mutex>
#include <optional>

namespace isochron::app {

/// A ray is followed through the cells that are shown, at once: the eye's under the cursor where
/// mouse and keyboard emulate head and wand, else the wand's. Data at a place are read by a thread
/// of its own, which may wait for a disk. Both depend on what had come from a disk by then,
/// so a recording keeps what was found beside what the panel did, and a replay obeys it.
class Picker {
  public:
    explicit Picker(std::shared_ptr<const index::IndexFile> file);

    /// The same data with more steps.
    void set_file(std::shared_ptr<const index::IndexFile> file) { file_ = std::move(file); }

    /// Once a frame.
    /// @param input what the panel in the room has left of it
    /// @param shown cells that are drawn; may be null
    /// @return what has been read
    interaction::Commands update(const interaction::InputState& input, const ExplorerState& state,
                                 const index::ExtractionPtr& shown);

    /// Where a ray first meets a surface that is shown and not cut away.
    std::optional<interaction::Pointed> hit_by(const interaction::Pose& ray,
                                               const ExplorerState& state,
                                               const index::ExtractionPtr& shown) const;

    /// What is under the cursor, without a click. Nothing for a wand, whose ray is followed only
    /// when its button says so.
    std::optional<interaction::Pointed> pointed(const interaction::InputState& input, bool aims,
                                                const ExplorerState& state,
                                                const index::ExtractionPtr& shown) const;

    /// What was not found, and why something could not be read, since the last call.
    std::vector<std::string> messages();

  private:
    /// What the thread that reads leaves for the thread that draws.
    struct Slot {
        std::mutex mutex;
        std::optional<interaction::Mark> mark;
    };

    std::optional<glm::dvec3> place_to_read(const interaction::InputState& input,
                                            const ExplorerState& state,
                                            const index::ExtractionPtr& shown) const;
    void read_at(const glm::dvec3& at, const ExplorerState& state);

    std::shared_ptr<const index::IndexFile> file_;
    std::shared_ptr<Slot> read_ = std::make_shared<Slot>();
    interaction::ButtonLevels before_;
    std::vector<std::string> notes_;
    BackgroundWork reading_;
};

} // namespace isochron::app
