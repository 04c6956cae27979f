// What a newcomer is offered: a hint, and a tour of six steps that can be left at any point; and
// the offer to go on with the session before.
#pragma once

#include "app/panel/panel_model.h"
#include "app/panel/parts/panel_layout.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace isochron::app {

/// What the user answers to an offer.
enum class Answer : std::uint8_t { none, yes, no };

/// The hint for newcomers, with the offer of the tour.
/// @param held the pointer is on it, so that a press there is an answer
Answer hint_card(const PanelBox& picture, bool& held);
inline constexpr const char *kHintCard = "###first use", *kRoomCard = "###room",
                            *kTourCard = "###tour";
/// Whether there is room for a card at the bottom of the picture; else it waits.
/// @param lowest what lies at the top of the picture ends there
bool has_room_for(const char* card, const PanelBox& picture, float lowest);

/// What the window of an emulated room shows. @return whether the user has read it
bool room_card(const PanelBox& picture);

/// The offer to go on with one of the sessions before: the first one, or another one of the list.
/// @param chosen number of the session that the user wants
Answer earlier_card(const PanelBox& picture, std::span<const OfferedSession> earlier,
                    std::size_t& chosen);
/// The question for the name of this session. @return yes: `name` is its name
Answer name_card(const PanelBox& picture, float top, std::string& name);

/// Each step says what to do, and notices when it is done.
class Tour {
  public:
    static constexpr std::size_t kSteps = 6;

    void start() { step_ = 0; }
    void leave() { step_.reset(); }
    bool goes_on() const { return step_.has_value(); }
    std::size_t step() const { return step_.value_or(kSteps); }

    /// Lays the card of its step out at the bottom of the picture.
    void draw(const PanelModel& model, const PanelBox& picture);

  private:
    std::optional<std::size_t> step_;      ///< none: no tour goes on
    std::optional<std::size_t> before_of_; ///< the step that `before_` is of
    ExplorerState before_;                 ///< when the step began
    bool done_ = false;
};

} // namespace isochron::app
