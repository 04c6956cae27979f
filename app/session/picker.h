// Picking with the wand: the surface where it points, and the data at its tip.
#pragma once

#include "app/frame/background_work.h"
#include "app/frame/explorer_state.h"
#include "index/extraction/extraction.h"
#include "index/file/index_file.h"
#include "interaction/tracked_input.h"

#include <memory>
#include <mutex>
#include <optional>

namespace isochron::app {

/// A ray is followed through the cells that are shown, at once. Data at the tip are read by a
/// thread of its own, which may wait for a disk. Both depend on what had come from a disk by then,
/// so a recording keeps what was found beside what the panel did, and a replay obeys it.
class Picker {
  public:
    explicit Picker(std::shared_ptr<const index::IndexFile> file);

    /// Once a frame.
    /// @param input what the panel in the room has left of it
    /// @param aims the wand points at nothing that is nearer than the data
    /// @param shown cells that are drawn; may be null
    /// @return what has been found
    interaction::Commands update(const interaction::InputState& input, bool aims,
                                 const ExplorerState& state, const index::ExtractionPtr& shown);

    /// Why something could not be read, since the last call.
    std::vector<std::string> messages() { return reading_.messages(); }

  private:
    /// What the thread that reads leaves for the thread that draws.
    struct Slot {
        std::mutex mutex;
        std::optional<interaction::Mark> mark;
    };

    interaction::Mark picked(const interaction::Pose& wand, const ExplorerState& state,
                             const index::Extraction& shown) const;
    void read_at(const interaction::Pose& wand, const ExplorerState& state);

    std::shared_ptr<const index::IndexFile> file_;
    std::shared_ptr<Slot> read_ = std::make_shared<Slot>();
    bool picked_before_ = false, probed_before_ = false; ///< the buttons were down
    BackgroundWork reading_;
};

} // namespace isochron::app
