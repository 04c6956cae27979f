// Programs from the shader files in render/shaders, whose text is compiled into the library.
//
// A line `#include "name.glsl"` is replaced by that file's text. The driver's messages name files
// by their number in `shader_files()`. VERTEX_STAGE, FRAGMENT_STAGE or COMPUTE_STAGE is defined, so
// that stages can share declarations, and MOST_SURFACES, the largest number of isosurfaces shown
// together.
#pragma once

#include "render/gl/gl_objects.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace isochron::render {

struct ShaderSource {
    std::string_view name; ///< file name; the extension (.vert, .frag, .comp) says the stage
    std::string_view text; ///< GLSL 4.50 core
    /// The file below render/shaders, as `cells/cell.vert`; empty if the text is of no file.
    std::string_view path = {};
};

/// Every shader file, in the order of their names.
const std::vector<ShaderSource>& shader_files();

/// The file of that name. @throws Error when there is none
const ShaderSource& shader_file(std::string_view name);

/// The extension that programs need to draw two views in one pass.
inline constexpr std::string_view kTwoEyesExtension = "GL_ARB_shader_viewport_layer_array";

/// Prelude of programs that draw two views in one pass, see frame.glsl.
inline constexpr std::string_view kTwoEyes =
    "#extension GL_ARB_shader_viewport_layer_array : require\n"
    "#define TWO_EYES\n";

/// Compiles and links.
/// @param prelude lines after #version in every stage: extensions and definitions
/// @throws Error with the file's name and the driver's log
Program link_program(const Gl& gl, const std::vector<ShaderSource>& sources,
                     std::string_view prelude = {});

/// Programs that were linked on this thread so far.
std::size_t linked_programs();

/// A program that is linked when it is first used: a picture uses a dozen of some sixty, and drivers
/// take a tenth of a second for one.
class LazyProgram {
  public:
    /// As `link_program`, later. @param linked called once with the program's name, to set uniforms
    /// that stay; empty: nothing is set
    LazyProgram(const Gl& gl, std::vector<ShaderSource> sources, std::string_view prelude = {},
                std::function<void(GLuint)> linked = {})
        : gl_(&gl), sources_(std::move(sources)), prelude_(prelude), linked_(std::move(linked)) {
        if (gl.links_at_once)
            program_.emplace(link_program(gl, sources_, prelude_));
    }

    /// @throws Error as `link_program`, on the first call
    GLuint name() const;
    const Gl& gl() const { return *gl_; }

  private:
    const Gl* gl_;
    std::vector<ShaderSource> sources_;
    std::string prelude_;
    std::function<void(GLuint)> linked_;
    mutable std::optional<Program> program_;
};

/// Whether the context has the extension (`GL_ARB_shader_viewport_layer_array`).
bool has_extension(const Gl& gl, std::string_view name);

} // namespace isochron::render
