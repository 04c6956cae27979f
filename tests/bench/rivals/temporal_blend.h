// The current standard between steps: VTK's temporal interpolator, which blends the whole grid.
#pragma once

#include "index/volume/instant.h"
#include "index/volume/step_values.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace isochron::bench {

/// `vtkTemporalInterpolator` of VTK 9.1, followed by `vtkFlyingEdges3D` with normals, on one thread.
/// The steps lie at times 0, 1, 2 and so on, in memory.
class TemporalBlend {
  public:
    virtual ~TemporalBlend() = default;
    /// Stored values, in the type of the steps.
    virtual std::vector<std::byte> values(index::Instant at) = 0;
    /// @param isovalue of stored values @return the number of triangles
    virtual std::uint64_t contour(index::Instant at, double isovalue) = 0;
};

/// @param values must outlive it
/// @throws index::Error when the module with VTK cannot be loaded
std::unique_ptr<TemporalBlend> temporal_blend(const index::StepValues& values);

} // namespace isochron::bench
