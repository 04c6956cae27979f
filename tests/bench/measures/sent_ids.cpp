// Uploads all steps, one after the other.
#include "tests/bench/measures/sent_ids.h"

#include "index/extraction/extraction.h"
#include "render/cells/cell_buffers.h"

#include <limits>

namespace isochron::bench {

std::optional<double> sent_ids_percent(const render::Gl& gl,
                                       const std::shared_ptr<const index::IndexFile>& file,
                                       double isovalue) {
    render::CellBuffers cells(gl, file->info().grid);
    const index::Extract extract = index::extract_from(file);
    render::UploadCount first;
    for (std::uint32_t step = 0; step < file->info().steps(); ++step) {
        const index::ExtractionPtr set = extract({index::Instant(step), {isovalue}}, {});
        while (cells.shown() != set)
            cells.upload(set, std::numeric_limits<std::size_t>::max());
        if (step == 0)
            first = cells.count();
    }
    const render::UploadCount sent = cells.count().since(first);
    if (sent.whole_ids == 0)
        return std::nullopt;
    return 100.0 * static_cast<double>(sent.ids) / static_cast<double>(sent.whole_ids);
}

} // namespace isochron::bench
