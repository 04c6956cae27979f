// A second array beside the moving sphere of session_fixture.h.
#pragma once

#include "index/volume/volume_series.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace isochron::app {

/// Stored as bytes: how near a point is to the middle of the volume.
class NearnessSeries final : public index::VolumeSeries {
  public:
    explicit NearnessSeries(const index::SeriesInfo& volume) : info_(volume) {
        info_.array = "nearness";
        info_.value_unit = "%";
        info_.type = index::ValueType::u8;
    }
    const index::SeriesInfo& info() const override { return info_; }
    void read(std::size_t step, std::span<std::byte> out) override {
        const auto& n = info_.grid.vertices;
        for (std::size_t at = 0; at < out.size(); ++at) {
            const double x = static_cast<double>(at % n[0]) - 15.5;
            const double y = static_cast<double>(at / n[0] % n[1]) - 15.5;
            const std::size_t slice = at / n[0] / n[1];
            const double z = static_cast<double>(slice) - 10.0 - double(step);
            out[at] = static_cast<std::byte>(std::max(0.0, 100 - 4 * std::hypot(x, y, z)));
        }
    }

  private:
    index::SeriesInfo info_;
};

} // namespace isochron::app
