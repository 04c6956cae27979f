// The current standard: flying edges and VTK's own renderer, anew for every step.
#pragma once

#include "index/volume/query.h"
#include "index/volume/step_values.h"
#include "tests/bench/measures/render_camera.h"

#include <memory>
#include <span>

namespace isochron::bench {

/// `vtkFlyingEdges3D` with normals, `vtkPolyDataMapper` and `vtkOpenGLRenderer`, in the current GL
/// context, so that both draw with the same GL.
class VtkScene {
  public:
    virtual ~VtkScene() = default;
    /// Contours the step from the start and draws it for every camera, side by side, into VTK's
    /// framebuffer; GL may still be drawing when it returns. Leaves GL's state undefined.
    virtual void draw(const index::Query& query) = 0;
    /// Share of pixels that show the surface in the last draw.
    virtual double covered() = 0;
};

/// @param values must outlive it, and so must the context
/// @param size of both sides of each camera's picture, pixels
/// @param threads that VTK may use for contouring
/// @throws index::Error when the module with VTK cannot be loaded, or cannot use this context
std::unique_ptr<VtkScene> vtk_scene(const index::StepValues& values,
                                    std::span<const CameraPose> cameras, int size,
                                    unsigned threads);

} // namespace isochron::bench
