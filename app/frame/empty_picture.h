// Why a picture shows no surface, in a sentence, and the way out of it.
#pragma once

#include "app/frame/explorer_state.h"
#include "app/frame/step_survey.h"
#include "interaction/commands.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

/// Why nothing is seen: the first of these that is true.
enum class EmptyBecause : std::uint8_t {
    no_values,         ///< the array has none at any step
    constant,          ///< the array has one value everywhere, at all steps
    hidden,            ///< the opacity of every surface is 0
    pieces_hidden,     ///< all pieces of the surfaces are hidden
    no_values_in_step, ///< all values of the step are missing
    constant_in_step,  ///< the step has one value everywhere
    outside,           ///< the isovalue is outside the range of the values
    no_cells,          ///< the isovalue is within the range, and yet no cell is active
    cut_away,          ///< the clip plane cuts all of the surfaces away
    behind,            ///< the data are behind the eyes
    out_of_view,       ///< the data are beside the view
    surface_aside,     ///< the data are in view, their surfaces are not
    too_small          ///< the data take hardly a pixel
};
inline constexpr std::size_t kEmptyBecause = 13;

/// How the data lie in the view of the eyes.
enum class Sight : std::uint8_t { in_view, behind, out_of_view, surface_aside, too_small };

/// What is known of a picture whose cells are the ones that were asked for.
struct PictureFacts {
    const interaction::Settings& settings;
    std::string array, unit;          ///< name of the array, unit of its values
    double low = 0, high = 0;         ///< range of its values at all steps
    bool has_values = true;           ///< at any step
    std::vector<std::uint64_t> cells; ///< active cells of each surface, of pieces that are shown
    bool pieces_hidden = false;       ///< there are pieces, and none is shown
    const StepSurvey* step = nullptr; ///< null: not known
    bool cut_away = false;            ///< the clip plane leaves nothing of what is visible
    Sight sight = Sight::in_view;
    /// Another array that has surfaces, and commands that show it.
    std::string other_array;
    interaction::Commands to_other_array;
    interaction::Similarity all_in_view; ///< where the data are ahead of the viewer, and whole
};

struct EmptyPicture {
    EmptyBecause why{};
    std::string sentence;
    std::string way; ///< what the way out is called; empty: there is none
    interaction::Commands commands;
    bool operator==(const EmptyPicture&) const = default;
};

/// Empty: something is seen.
std::optional<EmptyPicture> why_empty(const PictureFacts& facts);

/// What stands in the place of how exact the picture is: `no surface`, `hidden`, ...
const char* short_words(EmptyBecause why);

/// `FlowDensity is 1000 everywhere`, `Pressure has no values`.
std::string nothing_to_show(const std::string& array, bool has_values, double value,
                            const std::string& unit);

} // namespace isochron::app
