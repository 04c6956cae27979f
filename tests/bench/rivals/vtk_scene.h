// What there is today: flying edges and VTK's own renderer, for every step anew.
#pragma once

#include "index/volume/query.h"
#include "index/volume/step_values.h"
#include "tests/bench/measures/render_camera.h"

#include <memory>
#include <span>

namespace isochron::bench {

/// `vtkFlyingEdges3D` with normals, `vtkPolyDataMapper` and `vtkOpenGLRenderer`, in the GL context
/// that is current, so that both draw with the very same GL.
class VtkScene {
  public:
    virtual ~VtkScene() = default;
    /// Contours the step from the start and draws it for every camera, side by side, into VTK's own
    /// framebuffer; GL may still be at it when it returns. Leaves GL's state undefined.
    virtual void draw(const index::Query& query) = 0;
    /// Of the last draw: the share of pixels that show the surface.
    virtual double covered() = 0;
};

/// @param values must outlive it, and so must the context
/// @param size pixels of each camera's picture, across and up
/// @param threads that VTK may contour with
/// @throws index::Error when the module with VTK cannot be loaded, or not with this context
std::unique_ptr<VtkScene> vtk_scene(const index::StepValues& values,
                                    std::span<const CameraPose> cameras, int size,
                                    unsigned threads);

} // namespace isochron::bench
