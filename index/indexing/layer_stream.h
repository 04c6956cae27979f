// Streams the values of steps, one layer of chunks after the other.
#pragma once

#include "index/volume/volume_series.h"

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace isochron::index {

/// The planes of a layer of chunks and the planes next to them, which packing needs.
struct LayerView {
    std::uint32_t begin = 0, end = 0;  ///< the layer's planes: `begin` to `end` - 1
    std::uint32_t first = 0, last = 0; ///< planes in memory: `first` to `last` - 1
    std::size_t plane = 0;             ///< [bytes] of a plane
    const std::byte* held = nullptr;   ///< plane `first`, aligned for the type

    /// Planes `from` to `to` - 1.
    std::span<const std::byte> planes(std::uint32_t from, std::uint32_t to) const {
        return {held + (from - first) * plane, (to - from) * plane};
    }
    std::span<const std::byte> own() const { return planes(begin, end); }
};

/// Cuts the values of steps, as they arrive, into layers, each with the plane before it and the
/// plane after it if the step has them. Holds two layers.
class LayerCutter {
  public:
    LayerCutter(const Grid& grid, ValueType type);

    /// Receives the layers in order; a view is valid until the second call after.
    using Take = std::function<void(const LayerView&)>;
    /// Takes the next values of a step; after the last values of a step the next step begins.
    void add(std::span<const std::byte> piece, const Take& take);

  private:
    LayerView view() const;
    void advance();

    std::uint32_t planes_;
    std::size_t plane_; ///< [bytes]
    std::uint32_t layer_ = 0;
    std::size_t filled_ = 0; ///< bytes of the current buffer
    unsigned current_ = 0;
    std::array<std::vector<std::uint64_t>, 2> buffers_;
};

/// Receives a layer of a step of one of several arrays, which count from 0.
using TakeLayer = std::function<void(std::size_t array, std::size_t step, const LayerView& layer)>;

/// Calls `take` for all layers of the steps `begin` to `end` - 1, step after step, while the next
/// layer is read. The arrays of a step come one right after the other, so that a file with several
/// arrays is read from disk once.
/// @param arrays of the same grid and as many steps
/// @param threads at most this many small steps are read in parallel
/// @param progress may throw; gets the fraction that is done
void stream_layers(std::span<VolumeSeries* const> arrays, std::size_t begin, std::size_t end,
                   unsigned threads, const TakeLayer& take,
                   const std::function<void(double)>& progress);

} // namespace isochron::index
