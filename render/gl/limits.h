// The driver's limits: asked for, never assumed.
//
// GL guarantees little, such as buffer textures of 65,536 texels, while drivers have 2^27 and more.
// Code whose needs grow with the data checks `Limits`, and then fails with one line or splits the
// work. Fixed needs are checked once at the start, by `expect_enough`.
#pragma once

#include "render/gl/gl.h"

#include <glm/vec2.hpp>

#include <cstddef>

namespace isochron::render {

struct Limits {
    /// Asks the driver of the current context.
    explicit Limits(const Gl& gl);

    glm::ivec2 target;         ///< largest texture, renderbuffer and viewport to draw into [pixel]
    int texture_side;          ///< largest side of a texture [pixel]
    float largest_point;       ///< [pixel]
    std::size_t buffer_texels; ///< most texels of a buffer texture
    std::size_t storage_block_bytes; ///< most bytes of a storage block
    std::size_t storage_alignment;   ///< bytes: storage blocks begin at multiples of this
    std::size_t work_groups;         ///< most work groups of a dispatch, along x
};

/// Bytes of the largest uniform block.
inline constexpr std::size_t kUniformBlockBytes = 1280;
/// Invocations of a work group, all along x: local_size_x of work.glsl.
inline constexpr std::size_t kWorkGroup = 64;

/// @throws Error when a limit of the driver is too small; it names the limit, the need and the
/// value
void expect_enough(const Gl& gl);

/// Checks the size of a target to draw into. @param what its name for the error: "render target"
/// @throws Error when it is empty or larger than `limits.target`
void expect_target(const Limits& limits, const char* what, glm::ivec2 size);
/// Checks the size of a texture that is only read against `limits.texture_side`.
void expect_texture(const Limits& limits, const char* what, glm::ivec2 size);

/// Most items for one dispatch (one per invocation), if each has `bytes` in a storage block. It is
/// a multiple at which the next dispatch's range of the buffer is aligned.
/// @throws Error when not even one work group's items fit
std::size_t work_at_once(const Limits& limits, std::size_t bytes);

} // namespace isochron::render
