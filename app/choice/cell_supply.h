// Which cells a session asks for, how fine they are, and how they come to the GPU.
//
//     supply.request(frame);              // every frame
//     supply.take_newest(frame);
//     if (supply.choose_set(frame, picture))
//         pictures.show_cells(picture, frame.state);
//     plan.detail = supply.wanted_detail(frame, quality);   // for the sets that come next
#pragma once

#include "app/choice/frame.h"
#include "app/config/config.h"
#include "app/quality/cell_room.h"
#include "app/quality/detail_chooser.h"
#include "app/scene/cell_sets.h"
#include "app/scene/cells_picture.h"
#include "index/extraction/extractor.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace isochron::app {

class CellSupply {
  public:
    /// @param config, sets outlive the supply
    /// @param extract replaces the extraction from `file`; empty: the real one
    CellSupply(const Config& config, std::shared_ptr<const index::IndexFile> file, CellSets& sets,
               index::Extract extract, index::Shading shading);

    /// Continues with the same data that have more steps.
    void set_file(std::shared_ptr<const index::IndexFile> file);
    const index::Extractor& extractor() const { return extractor_; }
    void set_wake(const std::function<void()>& wake) { extractor_.set_wake(wake); }

    void request(const Frame& frame);
    /// Uploads what has been found, and chooses the set to draw.
    void take_newest(const Frame& frame);
    /// Why sets are not shown, each once; taken by the call.
    std::vector<std::string> take_messages();

    /// The set for pictures at rest takes longer to draw than a frame may. So it is drawn once
    /// nothing has changed for a while: a head that sways is shown the set for motion.
    /// @param now picture of this frame @return whether it shows another set than the last picture
    bool choose_set(const Frame& frame, const Picture& now);
    /// Whether the set for pictures at rest may be drawn in this frame.
    bool rests() const { return rests_; }
    /// Whether the cells of the drawn picture are kept: it is at rest, or an exact one, which may be
    /// moved.
    bool keeps_cells(const Frame& frame, const Picture& drawn) const {
        const bool is_exact = frame.report.pace == interaction::Pace::settled &&
                              drawn.footprint == render::Footprint::surface;
        return frame.is_live() && (rests_ || is_exact);
    }
    /// Whether a picture at rest of more cells than a frame can draw is made in parts.
    bool may_be_partial(const Frame& frame) const;
    /// Whether no cells finer than the drawn ones will come for this picture.
    bool is_finest(const Frame& frame) const;
    /// Whether a set that was asked for is not on the GPU yet.
    bool set_comes() const;

    /// The set that has all cells of what is asked for, if it is there.
    std::optional<CellSets::Use> finest_in_motion(const Frame& frame) const;
    /// The share of these cells that moving pictures have as quads where they have no mesh.
    double share_of_quads(const Frame& frame, CellSets::Use finest,
                          const FrameQuality& quality) const;
    /// Whether the set for pictures at rest may be drawn while the picture moves.
    bool may_move_finest(const Frame& frame, const FrameQuality& quality) const;
    /// The detail of the sets that are asked for next.
    index::DetailQuery wanted_detail(const Frame& frame, const FrameQuality& quality);
    /// Whether cells take a few pixels at most wherever they are seen.
    bool cells_look_small() const { return !details_.small() && details_.cells_look_small(); }
    /// Views of the last pictures: they tell how large each region of the volume is seen.
    void forget_views() { views_.clear(); }
    void note_views(std::span<const render::View> views) {
        views_.insert(views_.end(), views.begin(), views.end());
    }

  private:
    bool is_there(const index::SurfacesQuery& query) const;
    bool has_taken_newest() const;
    void report_cells(FrameReport& report) const;
    static bool moves_finest(const Frame& frame);
    static bool wants_all(const Frame& frame);
    bool is_half_sent(const Frame& frame) const;
    bool waits_its_turn(const index::ExtractionPtr& set, const Frame& frame) const;
    bool comes_too_late(const index::ExtractionPtr& set, const Frame& frame) const;
    bool comes_late(const index::ExtractionPtr& set) const;
    bool give_way(const index::ExtractionPtr& set, FramePlan& plan);
    void say_refused(const index::ExtractionPtr& set, const Frame& frame);
    index::DetailQuery detail_for_live(const Frame& frame, const FrameQuality& quality);
    index::DetailQuery detail_at_rest(const Frame& frame, const FrameQuality& quality,
                                      std::uint64_t moving);

    const Config& config_;
    CellSets& sets_;
    std::shared_ptr<index::NewestIndex> newest_; ///< the index, for the worker
    index::Extractor extractor_;
    DetailChooser details_;
    std::vector<render::View> views_;
    index::ExtractionPtr refused_; ///< the newest set if it is not shown; else null
    std::vector<std::string> messages_;
    interaction::Seconds constant_since_{0}; ///< when the eyes last saw something change
    std::uint64_t cells_at_first_ = 0;       ///< cells of the first set for this picture at rest
    bool rests_ = false;
};

} // namespace isochron::app
