// How much the driver can do: asked for before it matters, never assumed.
//
// GL promises little: 65,536 texels of a buffer texture, where drivers have 2^27 and more. What
// grows with the data is held against `Limits` where it grows and then fails with one line, or is
// split; what never changes is held against `expect_enough` once, at the start.
#pragma once

#include "render/gl/gl.h"

#include <glm/vec2.hpp>

#include <cstddef>

namespace isochron::render {

struct Limits {
    /// Asks the driver of the current context.
    explicit Limits(const Gl& gl);

    glm::ivec2 target;         ///< pixels of what is drawn into: texture, renderbuffer and viewport
    int texture_side;          ///< pixels
    float largest_point;       ///< pixels
    std::size_t buffer_texels; ///< of a buffer texture
    std::size_t storage_block_bytes; ///< that a shader sees of a buffer
    std::size_t storage_alignment;   ///< bytes: where such a part of a buffer may begin
    std::size_t work_groups;         ///< of a dispatch, along x
};

/// Bytes of the largest uniform block.
inline constexpr std::size_t kUniformBlockBytes = 1280;
/// Invocations of a work group, all along x: local_size_x of work.glsl.
inline constexpr std::size_t kWorkGroup = 64;

/// @throws Error naming what the driver has too little of: what, needed, got
void expect_enough(const Gl& gl);

/// @param what is drawn into: "render target"
/// @throws Error where it is empty or larger than `limits.target`
void expect_target(const Limits& limits, const char* what, glm::ivec2 size);
/// The same for what is only looked at: `limits.texture_side`.
void expect_texture(const Limits& limits, const char* what, glm::ivec2 size);

/// How many things one dispatch may do, one each invocation, where each has `bytes` of its own in a
/// storage block: such that the parts of the buffers for the next dispatch begin where they may.
/// @throws Error where not even a group's fit
std::size_t work_at_once(const Limits& limits, std::size_t bytes);

} // namespace isochron::render
