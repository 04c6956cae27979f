// Lists the pieces of the picked surface beside the frames, while a panel shows them.
#pragma once

#include "app/choice/frame.h"
#include "app/frame/asker.h"
#include "app/frame/piece_list.h"
#include "app/panel/panel_model.h"
#include "app/session/shown_arrays.h"
#include "index/extraction/extraction.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace isochron::app {

/// One list is made at a time; the newest wish follows it.
class PieceLister {
  public:
    PieceLister();

    /// Sets the function that is called, on the lister's thread, when a list is there.
    void set_wake(std::function<void()> wake) { listing_.set_wake(std::move(wake)); }
    /// Called once a frame. Never waits in a live session; a replay waits for what it asks for.
    void update(const Frame& frame, const ShownArrays& arrays);
    /// @param shown the cells that are drawn; may be null
    PanelPieces in_panel(const FrameReport& report, const index::ExtractionPtr& shown);

  private:
    struct Wanted {
        std::shared_ptr<const index::IndexFile> array;
        index::Query query;
        index::PieceFilter kept;
        std::uint32_t surface = 0;
        PieceOrder order;
        bool operator==(const Wanted&) const = default;
    };
    struct Listed {
        Wanted wanted;
        PieceListPtr list;   ///< null: it could not be made
        std::string failure; ///< why
    };
    static Listed list(const Wanted& wanted, const Asking& asking);
    void take();

    std::optional<PieceOrder> looked_at_; ///< by a panel in the last frame
    Listed last_;
    bool lists_ = false;
    Asker<Wanted, Listed> listing_;
};

} // namespace isochron::app
