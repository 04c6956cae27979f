// The states of quality: their names, and which of them there are.
#include "app/quality/picture_state.h"

#include <array>

namespace isochron::app {

const char* name_of(Shown shown) {
    constexpr std::array<const char*, kShown> kNames{"moving", "trial", "resting",
                                                     "moved",  "held",  "stays"};
    return kNames[static_cast<std::size_t>(shown)];
}

const char* name_of(Beside beside) {
    constexpr std::array<const char*, kBeside> kNames{"nothing", "ahead", "parts"};
    return kNames[static_cast<std::size_t>(beside)];
}

bool PictureState::is_legal(Shown shown, Beside beside) {
    constexpr std::array<std::array<bool, kBeside>, kShown> kLegal{{
        {true, true, true},  // moving
        {true, true, false}, // trial
        {true, true, false}, // resting
        {true, true, true},  // moved
        {true, false, true}, // held
        {true, false, false} // stays
    }};
    return kLegal[static_cast<std::size_t>(shown)][static_cast<std::size_t>(beside)];
}

std::optional<PictureState> PictureState::of(Shown shown, Beside beside, render::Footprint parts,
                                             bool parts_are_whole) {
    if (!is_legal(shown, beside))
        return std::nullopt;
    PictureState state;
    state.shown_ = shown;
    state.beside_ = beside;
    if (beside == Beside::parts) {
        state.parts_ = parts;
        state.parts_are_whole_ = parts_are_whole;
    }
    return state;
}

} // namespace isochron::app
