// Finds the active cells of a step, part by part: in the whole step, among the candidates of its
// chunks, or by a scan.
#pragma once

#include "index/file/step_view.h"
#include "index/search/layer_candidates.h"
#include "index/search/layer_results.h"
#include "index/search/layer_work.h"
#include "index/volume/query.h"

#include <cstdint>
#include <stop_token>

namespace isochron::index {

struct ActiveCellsOrder {
    const Query& query;
    bool by_bricks = false; ///< the index must have them; else by a scan
    bool shaded = false;    ///< also make points and rows, while each part is in memory
    ChunkFilter only = {};  ///< with bricks and by chunks: search these chunks alone
    /// With bricks and by chunks: cells that are not looked for.
    const StayingCells* staying = nullptr;
};

/// Number of parts of a search; the results of all parts are put together.
std::uint32_t parts_to_search(const StepView& step, bool by_bricks);
/// @param results of `parts_to_search`; may count only
/// @return false when stopped @throws Error, Stopped as ChunkStore does
bool find_active(LayerWork& work, const StepView& step, const ActiveCellsOrder& order,
                 LayerResults& results, const std::stop_token& stop);

} // namespace isochron::index
