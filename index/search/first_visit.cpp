// Adds up what the tables of chunks and cells say.
#include "index/search/first_visit.h"

#include "index/search/layer_candidates.h"

namespace isochron::index {

MissingBytes missing_bytes(const IndexFile& file, const Query& query, bool shaded) {
    const ChunkStore& store = file.chunks();
    MissingBytes bytes;
    {
        const auto held = file.cells()->hold();
        bytes.cells = file.cells()->missing_bytes(query.step);
    }
    if (bytes.cells == 0)
        return bytes; // needs no comparison
    if (file.better_whole(query.step)) {
        bytes.bricks = store.missing_bytes(query.step);
        if (file.referral()) // the values are in the source
            bytes.bricks += file.info().step_bytes();
    } else if (const auto cut =
                   store.levels(query.step)->cut(file.info().scaling, query.isovalue)) {
        for (std::uint32_t layer = 0; layer < store.grid().layers(); ++layer)
            bytes.bricks += store.missing_bytes(
                query.step, layer,
                LayerCandidates::places_of(*store.layer(query.step, layer), *cut));
    }
    if (shaded)
        bytes.cells += bytes.bricks;
    return bytes;
}

} // namespace isochron::index
