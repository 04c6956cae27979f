// Picking: the shown surface that a ray meets, and the data at a place.
#pragma once

#include "app/frame/asker.h"
#include "app/frame/explorer_state.h"
#include "app/scene/picture.h"
#include "index/extraction/cell_ray.h"
#include "index/extraction/extraction.h"
#include "index/extraction/instant_surfaces.h"
#include "index/file/index_file.h"
#include "interaction/input/device_reading.h"
#include "interaction/input/tracked_input.h"
#include "interaction/pointed.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace isochron::app {

/// Follows a ray through the shown cells at once: the ray from the eye through the cursor if mouse
/// and keyboard emulate head and wand, else the wand's. A background thread, which may wait for a
/// disk, reads the data at a place. Both results depend on what the disk has delivered by then, so
/// recordings hold them, like the commands of the operator's panel, and a replay obeys them.
class Picker {
  public:
    explicit Picker(std::shared_ptr<const index::IndexFile> file);

    /// Sets the function that is called, on the reading thread, when data have been read.
    void set_wake(std::function<void()> wake) { reading_.set_wake(std::move(wake)); }

    /// Continues with the same data that have more steps.
    void set_file(std::shared_ptr<const index::IndexFile> file) { file_ = std::move(file); }

    /// Called once a frame.
    /// @param input that the panel in the room does not use
    /// @param shown cells that are drawn; may be null
    void update(const interaction::InputState& input, const ExplorerState& state,
                const index::ExtractionPtr& shown);
    /// Commands with the mark, if data were read; kept until they are taken.
    interaction::Commands take_found() { return std::exchange(found_, {}); }

    /// Sets the slices that are shown, and the names and units of their values: all of one array.
    void set_slices(const std::vector<index::SliceValuesPtr>& slices,
                    const index::SeriesInfo& info);

    /// Sets the ghosts that are shown.
    void set_ghosts(const std::vector<index::InstantSurfacesPtr>& ghosts) { ghosts_ = ghosts; }

    /// Sets the surfaces of other arrays that are shown.
    void set_further(std::vector<ShownFurther> further) { further_ = std::move(further); }

    /// Where a ray first meets a slice, or a visible surface or ghost that is not cut away; empty if
    /// it meets none.
    std::optional<interaction::Pointed> hit_by(const interaction::Pose& ray,
                                               const ExplorerState& state,
                                               const index::ExtractionPtr& shown) const;

    /// The place under the cursor, without a click; empty for a wand, whose ray is followed only
    /// when its button is pressed. @param aims the panel in the room is not in the way
    std::optional<interaction::Pointed> pointed(const interaction::InputState& input, bool aims,
                                                const ExplorerState& state,
                                                const index::ExtractionPtr& shown) const;

    /// Messages since the last call: places without data, and errors of reading.
    std::vector<std::string> messages() { return std::exchange(messages_, {}); }

  private:
    /// A place whose data are read, and what was read.
    struct Place {
        std::shared_ptr<const index::IndexFile> file;
        glm::dvec3 at;
        index::Instant instant;
    };
    struct Read {
        std::optional<interaction::Mark> mark; ///< empty: reading has failed
        std::string message;                   ///< empty: none
    };
    static Read read(const Place& place, const Asking& asking);
    std::optional<interaction::Pointed> surface_hit(const index::Ray& ray,
                                                    const ExplorerState& state,
                                                    const index::ExtractionPtr& shown) const;
    std::optional<interaction::Pointed> slice_hit(const index::Ray& ray) const;

    std::optional<glm::dvec3> place_to_read(const interaction::InputState& input,
                                            const ExplorerState& state,
                                            const index::ExtractionPtr& shown) const;

    std::shared_ptr<const index::IndexFile> file_;
    std::vector<index::SliceValuesPtr> slices_;
    std::vector<index::InstantSurfacesPtr> ghosts_;
    std::vector<ShownFurther> further_;
    std::string sliced_, sliced_unit_; ///< the array of the slices
    interaction::ButtonLevels before_;
    interaction::Commands found_;
    std::vector<std::string> messages_;
    Asker<Place, Read> reading_;
};

} // namespace isochron::app
