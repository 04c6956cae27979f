// Compiling and linking of shader files.
#include "render/shader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>

namespace isochron::render {

namespace {

struct ShaderKind {
    static GLuint create(const Gl& gl, GLenum stage) { return gl.CreateShader(stage); }
    static void destroy(const Gl& gl, GLuint name) { gl.DeleteShader(name); }
};
using Shader = GlObject<ShaderKind>;

GLenum stage_of(std::string_view name) {
    if (name.ends_with(".vert"))
        return GL_VERTEX_SHADER;
    if (name.ends_with(".frag"))
        return GL_FRAGMENT_SHADER;
    throw Error(fmt::format("{}: unknown kind of shader, expected .vert or .frag", name));
}

Shader compile(const Gl& gl, const ShaderSource& source) {
    Shader shader(gl, stage_of(source.name));
    const GLchar* text = source.text.data();
    const auto length = static_cast<GLint>(source.text.size());
    gl.ShaderSource(shader.name(), 1, &text, &length);
    gl.CompileShader(shader.name());
    GLint compiled = 0, log_length = 0;
    gl.GetShaderiv(shader.name(), GL_COMPILE_STATUS, &compiled);
    if (!compiled) {
        gl.GetShaderiv(shader.name(), GL_INFO_LOG_LENGTH, &log_length);
        std::string log(std::max(log_length, 1), '\0');
        gl.GetShaderInfoLog(shader.name(), log_length, nullptr, log.data());
        throw Error(fmt::format("{}: shader does not compile: {}", source.name, log.c_str()));
    }
    return shader;
}

} // namespace

ShaderSource shader_file(std::string_view name) {
    for (const ShaderSource& file : shader_files())
        if (file.name == name)
            return file;
    throw Error(fmt::format("{}: no such shader file", name));
}

Program link_program(const Gl& gl, const std::vector<ShaderSource>& sources) {
    Program program(gl);
    std::vector<Shader> shaders;
    for (const ShaderSource& source : sources)
        gl.AttachShader(program.name(), shaders.emplace_back(compile(gl, source)).name());
    gl.LinkProgram(program.name());
    for (const Shader& shader : shaders)
        gl.DetachShader(program.name(), shader.name());
    GLint linked = 0, log_length = 0;
    gl.GetProgramiv(program.name(), GL_LINK_STATUS, &linked);
    if (!linked) {
        gl.GetProgramiv(program.name(), GL_INFO_LOG_LENGTH, &log_length);
        std::string log(std::max(log_length, 1), '\0');
        gl.GetProgramInfoLog(program.name(), log_length, nullptr, log.data());
        std::vector<std::string_view> names;
        for (const ShaderSource& source : sources)
            names.push_back(source.name);
        throw Error(
            fmt::format("{}: shaders do not link: {}", fmt::join(names, ", "), log.c_str()));
    }
    return program;
}

} // namespace isochron::render
