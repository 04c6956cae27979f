// A series of which a chosen share stays as it is from step to step.
#pragma once

#include "index/volume/volume_series.h"

#include <cstdint>
#include <span>
#include <vector>

namespace isochron::bench {

/// How the chunks that change lie among those that the surface passes through.
enum class Changing { together, scattered };

/// The distance from a sphere, with ripples. From one step to the next the chunks that change get
/// other ripples, the others keep their bytes.
class ChangingSeries final : public index::VolumeSeries {
  public:
    /// @param size vertices along each axis @param cells about as many as the surface 0 passes through
    /// @param stay for each step but the first: the share of the chunks with cells that stay
    ChangingSeries(std::uint32_t size, double cells, std::vector<double> stay, Changing changing);

    void call(const char* array) { info_.array = array; }
    const index::SeriesInfo& info() const override { return info_; }
    void read(std::size_t step, std::span<std::byte> out) override;

  private:
    std::uint32_t size_, along_; ///< vertices and chunks along each axis
    double radius_;
    index::SeriesInfo info_;
    std::vector<std::vector<std::uint16_t>> versions_; ///< by step, of each chunk
};

} // namespace isochron::bench
