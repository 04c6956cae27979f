// What the frames' drawing took: GPU and processor time, brought together when both are known.
#pragma once

#include "app/frame/draw_cost.h"
#include "render/cells/cell_pass.h"
#include "render/gl/gpu_timer.h"

#include <algorithm>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

namespace isochron::app {

/// One frame that was drawn.
struct DrawSample {
    std::uint64_t frame = 0;
    render::Footprint footprint = render::Footprint::quad;
    DrawLoad load;
    Milliseconds processor{0};       ///< until the last command was given
    std::optional<Milliseconds> gpu; ///< from the first to the last command's execution
    bool operator==(const DrawSample&) const = default;

    /// What the frame rate feels: both work at the same time, so the slower one counts.
    Milliseconds cost() const { return std::max(processor, gpu.value_or(processor)); }
};

/// Where the driver has no timestamps that can be true, the processor's time stands alone. Software
/// GL draws on the processor, partly while commands are given: there too the slower one counts.
class DrawMeter {
  public:
    explicit DrawMeter(const render::Gl& gl) : timer_(gl) {}

    void begin(std::uint64_t frame);
    /// @param processor time of giving the commands
    void end(render::Footprint footprint, const DrawLoad& load, Milliseconds processor);

    /// Frames whose times are known by now, in their order, each once. Waits for nothing; a frame
    /// drawn while the GPU is far behind is left out.
    std::vector<DrawSample> finished();

  private:
    using Clock = render::GpuTimer::Clock;
    render::GpuTimer timer_;
    std::deque<DrawSample> under_way_;
    std::vector<DrawSample> finished_;
    std::uint64_t frame_ = 0; ///< between begin and end
    bool timed_ = false;      ///< likewise
};

} // namespace isochron::app
