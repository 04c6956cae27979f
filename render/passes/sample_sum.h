// Adds up pictures of the same views, each of another sample in every pixel, and gives their mean.
#pragma once

#include "render/gl/gl_objects.h"
#include "render/gl/render_target.h"

#include <glm/vec2.hpp>

#include <optional>

namespace isochron::render {

/// Where sample n of `of` samples lies in its pixel, from the middle [pixel]: -0.5 to 0.5 on each axis,
/// 0 for the first. Any first 4, 8 or 16 are as even as can be: the (0, 2)-sequence of I. M. Sobol,
/// "On the distribution of points in a cube", USSR Comp. Math. 7 (4), 1967, moved around.
/// @param within side of the square in which they lie, 1 for samples of one point
glm::vec2 sample_place(int n, float within = 1.0f);

class SampleSum {
  public:
    /// @param gl outlives the sum @throws Error when a shader does not compile
    explicit SampleSum(const Gl& gl);

    /// Begins a new sum with a resolved picture, whose size all others have.
    void begin(const RenderTarget& picture);
    void add(const RenderTarget& picture);
    int count() const { return count_; } ///< pictures in the sum
    /// Replaces a target's resolved picture, of the same size, by the mean of the light of all.
    void write_mean(const RenderTarget& target) const;

  private:
    void draw(GLuint framebuffer, GLuint from, float factor, bool adds) const;

    const Gl* gl_;
    Program program_;
    VertexArray no_attributes_;
    glm::ivec2 size_{0};
    int count_ = 0;
    std::optional<Texture> light_; ///< linear
    Framebuffer framebuffer_;
};

} // namespace isochron::render
