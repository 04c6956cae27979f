// Draws surfaces that light shines through by the nearest layer of each: for what moves.
#pragma once

#include "index/volume/query.h"
#include "render/gl/gl_objects.h"
#include "render/gl/render_target.h"
#include "render/gl/shader.h"
#include "render/gl/view.h"

#include <glm/mat4x4.hpp>

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace isochron::render {

/// The nearest layer of a surface hides the others of that surface while it is drawn, so that it
/// takes no longer than an opaque one, and triangles need no order.
class LayerPass {
  public:
    static constexpr std::size_t kMost = index::kMostSurfaces;

    /// @param gl outlives the pass @throws Error when a shader does not compile
    explicit LayerPass(const Gl& gl);

    /// Draws the layers over the views of the bound framebuffer, which has one sample in each pixel.
    /// Leaves depth test, depth writes and GL_FRAMEBUFFER_SRGB on, blending off, and the viewports
    /// of the views set.
    /// @param opacities of the layers, 0 to 1; at most `kMost`
    /// @param draw draws the surface of a layer into the views of the framebuffer that is bound then,
    ///   as an opaque one, with depth and an opacity of 1
    /// @param hidden opaque surfaces in the bound framebuffer hide what is behind them
    /// @param linear layers are blended in linear light; else by display values
    /// @param room_from_box all layers lie in the box of 0 to 1 along each axis
    /// @throws Error when the driver cannot make a target
    void draw(std::span<const View> views, std::span<const float> opacities,
              const std::function<void(std::size_t layer)>& draw, bool hidden, bool linear,
              const glm::mat4& room_from_box);

    /// Links the programs for all numbers of layers.
    void link() const;

  private:
    const Gl* gl_;
    std::vector<LazyProgram> programs_; ///< by the number of layers, less one
    VertexArray no_attributes_;
    std::vector<RenderTarget> layers_;
};

} // namespace isochron::render
