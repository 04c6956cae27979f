// Extractions from values in memory, as the worker makes them from a file.
#pragma once

#include "index/extraction/extraction.h"
#include "index/scan/scan.h"
#include "tests/support/test_field.h"

#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace isochron::render {

class Extractions {
  public:
    explicit Extractions(const index::StepValues& values)
        : values_(values), blocks_(block_values(values)), gatherer_(values.grid, blocks_) {}

    /// An extraction of the active cells.
    index::ExtractionPtr active(std::uint32_t step, std::vector<double> isovalues) {
        auto made = std::make_shared<index::Extraction>();
        for (const double isovalue : isovalues)
            index::scan(values_, {index::Instant(step), isovalue},
                        made->surfaces.emplace_back().ids);
        made->query = {index::Instant(step), std::move(isovalues)};
        return complete(std::move(made));
    }
    /// An extraction of any cells, one ascending list for each surface.
    index::ExtractionPtr of_cells(std::uint32_t step,
                                  std::vector<std::vector<index::CellId>> surfaces,
                                  double isovalue = 0.0) {
        auto made = std::make_shared<index::Extraction>();
        made->query = {index::Instant(step), std::vector<double>(surfaces.size(), isovalue)};
        for (auto& ids : surfaces)
            made->surfaces.emplace_back().ids = std::move(ids);
        return complete(std::move(made));
    }

    /// The extraction with the points that the worker makes where they are asked for.
    index::ExtractionPtr shaded(const index::ExtractionPtr& set) {
        auto with_points = std::make_shared<index::Extraction>(*set);
        for (std::size_t i = 0; i < with_points->surfaces.size(); ++i) {
            index::CellSet& surface = with_points->surfaces[i];
            surface.query = {set->query.instant, set->query.isovalues[i]};
            index::shade_cells(values_, surface);
        }
        return with_points;
    }

    const index::BlockValues& block_values() const { return blocks_; }

  private:
    static index::BlockValues block_values(const index::StepValues& values) {
        const auto sorted = index::sorted_values(values);
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const double value : sorted)
            if (std::isfinite(value)) {
                low = std::min(low, value);
                high = std::max(high, value);
            }
        return {values.type, values.scaling, low, high};
    }
    index::ExtractionPtr complete(std::shared_ptr<index::Extraction> made) {
        const index::BlockLevels levels = blocks_.levels(made->query.isovalues);
        made->levels = levels.units;
        for (const index::CellSet& surface : made->surfaces)
            gatherer_.need(surface);
        gatherer_.gather(values_, made->query.instant, levels, made->blocks);
        return made;
    }

    index::StepValues values_;
    index::BlockValues blocks_;
    index::BlockGatherer gatherer_;
};

} // namespace isochron::render
