// The states of quality: how a frame comes to its picture, and what is drawn beside it.
//
//     PictureState state = PictureState::drawn(choice.final, choice.measure);
//     if (moves_exact)
//         state.move();
//     state.draw_ahead(sways);
//     if (finer_cells_wait)
//         state.hold();
#pragma once

#include "render/cells/footprints.h"

#include <cstdint>
#include <optional>

namespace isochron::app {

/// How a frame comes to its picture.
enum class Shown : std::uint8_t {
    moving,  ///< drawn if something has changed; a better picture is to come
    trial,   ///< drawn even if nothing has changed, so that its cost gets known
    resting, ///< drawn if something has changed, and as good as it gets for these cells
    moved,   ///< the last exact picture is moved, in the place of a worse one
    held,    ///< what was drawn last stays until a better picture is there
    stays    ///< what was drawn last stays, and is as good as it gets while the head sways
};
inline constexpr std::size_t kShown = 6;
/// What is drawn beside the picture of a frame, for later frames.
enum class Beside : std::uint8_t {
    nothing,
    ahead, ///< the exact picture for a head that sways: it will be moved, and its cost gets known
    parts  ///< the exact picture at rest, in parts; also while it is on show once they are whole
};
inline constexpr std::size_t kBeside = 3;
/// `moving`, `trial`, ... and `nothing`, `ahead`, `parts`.
const char* name_of(Shown shown);
const char* name_of(Beside beside);

/// Any of the states in the table of docs/ARCHITECTURE.md, and no other one: what is final is not
/// measured, and a picture in parts is neither.
class PictureState {
  public:
    /// Moving, with nothing beside it.
    PictureState() = default;
    /// A picture that is drawn. What is final needs no measuring.
    static PictureState drawn(bool final, bool measures) {
        PictureState state;
        state.shown_ = final ? Shown::resting : measures ? Shown::trial : Shown::moving;
        return state;
    }
    /// @param parts footprint of the picture in parts; whatever without parts
    /// @return empty: there is no such state
    static std::optional<PictureState> of(Shown shown, Beside beside, render::Footprint parts,
                                          bool parts_are_whole);
    static bool is_legal(Shown shown, Beside beside);

    Shown shown() const { return shown_; }
    Beside beside() const { return beside_; }
    /// Whether the picture is as good as it gets for these cells.
    bool is_final() const { return shown_ == Shown::resting || shown_ == Shown::stays; }
    bool is_trial() const { return shown_ == Shown::trial; }
    bool is_moved() const { return shown_ == Shown::moved; }
    bool is_held() const { return shown_ == Shown::held || shown_ == Shown::stays; }
    bool draws_ahead() const { return beside_ == Beside::ahead; }
    /// Footprint of the picture that is made in parts, or shown; empty: there is none.
    std::optional<render::Footprint> in_parts() const {
        return beside_ == Beside::parts ? std::optional(parts_) : std::nullopt;
    }
    /// Whether the picture in parts may be shown once it is whole here: it is whole everywhere.
    bool parts_are_whole() const { return beside_ == Beside::parts && parts_are_whole_; }

    /// A better picture of these cells is to come.
    void improve() {
        if (shown_ == Shown::resting)
            shown_ = Shown::moving;
    }
    /// What is drawn stands in for a better picture, and is not measured.
    void stand_in() {
        if (shown_ == Shown::resting || shown_ == Shown::trial)
            shown_ = Shown::moving;
        if (shown_ == Shown::stays)
            shown_ = Shown::held;
    }
    /// The exact picture at rest is made in parts, beside what is drawn meanwhile.
    void make_parts(render::Footprint footprint) {
        stand_in();
        beside_ = Beside::parts;
        parts_ = footprint;
    }
    void share_parts(bool are_whole) { parts_are_whole_ = in_parts() && are_whole; }
    void give_up_parts() {
        share_parts(false);
        if (in_parts())
            beside_ = Beside::nothing;
        parts_ = {};
    }
    /// @param wanted false: no longer
    void draw_ahead(bool wanted) {
        if (beside_ != Beside::parts && !is_held())
            beside_ = wanted ? Beside::ahead : Beside::nothing;
    }
    void move() { shown_ = Shown::moved; }
    /// What was drawn last stays; nothing is drawn ahead beside it.
    void hold() {
        shown_ = is_final() ? Shown::stays : Shown::held;
        if (draws_ahead())
            beside_ = Beside::nothing;
    }
    bool operator==(const PictureState&) const = default;

  private:
    Shown shown_ = Shown::moving;
    Beside beside_ = Beside::nothing;
    render::Footprint parts_{};
    bool parts_are_whole_ = false;
};

} // namespace isochron::app
