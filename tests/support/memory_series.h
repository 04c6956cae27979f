// A series in memory, for tests of the index file.
#pragma once

#include "index/volume/volume_series.h"
#include "tests/support/test_field.h"

#include <fmt/format.h>

#include <cstring>
#include <functional>

namespace isochron::index {

class MemorySeries : public VolumeSeries {
  public:
    explicit MemorySeries(const StepValues& values) : values_(values) {
        info_.array = "test";
        info_.grid = values.grid;
        info_.type = values.type;
        info_.scaling = values.scaling;
        for (std::size_t t = 0; t < values.steps; ++t) {
            info_.times.push_back(0.5 * static_cast<double>(t));
            info_.sources.push_back(fmt::format("t{}.raw", t));
        }
    }

    const SeriesInfo& info() const override { return info_; }
    SeriesInfo& info() { return info_; }

    void read(std::size_t step, std::span<std::byte> out) override {
        if (before_read)
            before_read(step);
        std::memcpy(out.data(), values_.first + step * values_.stride, out.size());
    }

    std::function<void(std::size_t)> before_read; ///< called with the step; may throw

  private:
    StepValues values_;
    SeriesInfo info_;
};

} // namespace isochron::index
