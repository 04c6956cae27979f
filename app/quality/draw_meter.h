// GPU and processor time of drawing each frame, combined when both are known.
#pragma once

#include "app/quality/draw_cost.h"
#include "render/drawing/cell_pass.h"
#include "render/gl/gpu_timer.h"

#include <algorithm>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

namespace isochron::app {

/// One drawn frame.
struct DrawSample {
    std::uint64_t frame = 0;
    render::Footprint footprint = render::Footprint::quad;
    DrawLoad load;
    Milliseconds processor{0};       ///< to give all commands
    std::optional<Milliseconds> gpu; ///< to execute them, from the first to the last
    std::size_t resolution = 0;      ///< number of the cells' resolution: see `kCellResolutions`
    bool operator==(const DrawSample&) const = default;

    /// The time that limits the frame rate: both work at the same time, so the slower one counts.
    Milliseconds cost() const { return std::max(processor, gpu.value_or(processor)); }
};

/// If the driver has no credible timestamps, only the processor's time is measured. Software GL
/// draws on the processor, partly while commands are given: there, too, the slower time counts.
class DrawMeter {
  public:
    explicit DrawMeter(const render::Gl& gl) : timer_(gl) {}

    void begin(std::uint64_t frame);
    /// @param processor time of giving the commands
    /// @param resolution of the cells, by number
    void end(render::Footprint footprint, const DrawLoad& load, Milliseconds processor,
             std::size_t resolution = 0);

    /// Frames whose times have become known since the last call, in order. Does not wait; leaves
    /// out frames that were drawn while the GPU was far behind.
    std::vector<DrawSample> finished();

  private:
    using Clock = render::GpuTimer::Clock;
    render::GpuTimer timer_;
    std::deque<DrawSample> under_way_;
    std::vector<DrawSample> finished_;
    std::uint64_t frame_ = 0; ///< between begin and end
    bool timed_ = false;      ///< the GPU timer measures this frame
};

} // namespace isochron::app
