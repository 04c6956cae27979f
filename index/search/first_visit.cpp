// Adds up what the tables of chunks and cells say.
#include "index/search/first_visit.h"

#include "index/search/layer_candidates.h"

namespace isochron::index {

MissingBytes missing_bytes(const IndexFile& file, const Query& query, bool shaded) {
    const StepView step = step_of(file, query.instant);
    MissingBytes bytes;
    // The values of a small step come in one request, and with planes they are needed in any case:
    // then nothing of the cells is read to find out how many bytes they have.
    if (!file.cells()->holds_some(query.instant.step) &&
        (shaded || (!file.referral() && step.store().is_small())))
        return {.cells = 1, .bricks = 0};
    {
        const auto held = file.cells()->hold();
        bytes.cells = file.cells()->missing_bytes(query.instant.step);
    }
    if (bytes.cells == 0)
        return bytes; // needs no comparison
    if (!step.by_chunks()) {
        bytes.bricks = step.store().missing_bytes(query.instant.step);
        if (file.referral()) // the values are in the source
            bytes.bricks += file.info().step_bytes();
    } else if (const auto cut = step.cut(query.isovalue)) {
        for (std::uint32_t layer = 0; layer < step.chunk_grid().layers(); ++layer)
            bytes.bricks += step.store().missing_bytes(
                query.instant.step, layer, LayerCandidates::places_of(*step.layer(layer), *cut));
    }
    if (shaded)
        bytes.cells += bytes.bricks;
    return bytes;
}

} // namespace isochron::index
