// Why a frame was drawn with its footprint, as reports and the panel say it.
#pragma once

#include <cstdint>

namespace isochron::app {

/// Why a footprint was chosen.
enum class QualityReason : std::uint8_t {
    moving,       ///< the picture moves: the best that fits the budget with room to spare, or quads
    fast_mode,    ///< the mode asks for quads
    quality_mode, ///< the mode asks for the best, whatever it costs
    paper_mode,   ///< as in the paper: splats once the picture is settled
    configured,   ///< the footprint of settled pictures is configured
    fits,         ///< the best of all fits the budget
    trial,        ///< a better one than before is being measured
    in_parts,     ///< the exact picture at rest is made over several frames
    over_budget   ///< a better one does not fit
};
/// `moving`, `fast mode`, `quality mode`, `paper mode`, `configured`, `fits`, `trial`, `in parts`,
/// `over budget`.
const char* name_of(QualityReason reason);

} // namespace isochron::app
