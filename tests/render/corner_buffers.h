// What SurfacePass reads of a set's corners, found on the CPU.
#pragma once

#include "render/gl_objects.h"
#include "render/surface_pass.h"
#include "tests/render/vertex_field.h"

namespace isochron::render {

class CornerBuffers {
  public:
    CornerBuffers(const Gl& gl, const VertexField& field, const index::CellSet& set);
    CornerData data() const { return {values_texture_.name(), gradients_texture_.name()}; }

  private:
    Buffer values_, gradients_;
    Texture values_texture_, gradients_texture_;
};

} // namespace isochron::render
