// Compiles and links shader files.
#include "render/gl/shader.h"

#include "index/volume/query.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

namespace isochron::render {

namespace {

thread_local std::size_t links = 0; ///< programs that this thread has linked

struct Stage {
    std::string_view extension, definition;
    GLenum kind;
};
constexpr std::array kStages{Stage{".vert", "VERTEX_STAGE", GL_VERTEX_SHADER},
                             Stage{".frag", "FRAGMENT_STAGE", GL_FRAGMENT_SHADER},
                             Stage{".comp", "COMPUTE_STAGE", GL_COMPUTE_SHADER}};

const Stage& stage_of(std::string_view name) {
    for (const Stage& stage : kStages)
        if (name.ends_with(stage.extension))
            return stage;
    throw Error("{}: unknown kind of shader, expected .vert, .frag or .comp", name);
}

/// The number of a file for #line, as GLSL names files by numbers.
std::size_t number_of(std::string_view name) {
    const auto named = [&](const ShaderSource& file) { return file.name == name; };
    return static_cast<std::size_t>(std::ranges::find_if(shader_files(), named) -
                                    shader_files().begin());
}

std::string line_of(int line, const ShaderSource& source) {
    return fmt::format("#line {} {}\n", line, number_of(source.name));
}

/// The text with every #include line replaced by the file's text. #line directives keep the line
/// numbers of the files, so that the driver's messages name the right lines.
/// @param included takes the names of these files
std::string with_includes(const ShaderSource& source, std::vector<std::string_view>& included) {
    constexpr std::string_view kInclude = "#include \"";
    std::string result;
    std::string_view text = source.text;
    for (int line = 1; !text.empty(); ++line) {
        const std::size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
        const std::string_view current = text.substr(0, end);
        if (current.starts_with(kInclude)) {
            const std::string_view name = current.substr(kInclude.size());
            const ShaderSource& file = shader_file(name.substr(0, name.find('"')));
            included.push_back(file.name);
            result += line_of(1, file) + with_includes(file, included) + line_of(line + 1, source);
        } else {
            result += current;
        }
        text.remove_prefix(end);
    }
    return result;
}

/// The complete text for the driver, with `#version` as its first line.
std::string complete_text(const ShaderSource& source, std::string_view prelude,
                          std::string_view definition, std::vector<std::string_view>& included) {
    const std::string text = with_includes(source, included);
    const std::size_t version_end = text.find('\n') + 1;
    return fmt::format("{}#define {}\n#define MOST_SURFACES {}\n{}{}{}",
                       text.substr(0, version_end), definition, index::kMostSurfaces, prelude,
                       line_of(2, source), text.substr(version_end));
}

/// Explains the numbers of files in the driver's messages.
std::string numbers_of(const ShaderSource& source, const std::vector<std::string_view>& included) {
    std::string text = fmt::format("{} is {}", number_of(source.name), source.name);
    for (const std::string_view name : included)
        text += fmt::format(", {} is {}", number_of(name), name);
    return text;
}

Shader compile(const Gl& gl, const ShaderSource& source, std::string_view prelude) {
    const Stage& stage = stage_of(source.name);
    Shader shader(gl, stage.kind);
    std::vector<std::string_view> included;
    const std::string complete = complete_text(source, prelude, stage.definition, included);
    const GLchar* text = complete.data();
    const auto length = static_cast<GLint>(complete.size());
    gl.ShaderSource(shader.name(), 1, &text, &length);
    gl.CompileShader(shader.name());
    GLint compiled = 0, log_length = 0;
    gl.GetShaderiv(shader.name(), GL_COMPILE_STATUS, &compiled);
    if (!compiled) {
        gl.GetShaderiv(shader.name(), GL_INFO_LOG_LENGTH, &log_length);
        std::string log(std::max(log_length, 1), '\0');
        gl.GetShaderInfoLog(shader.name(), log_length, nullptr, log.data());
        throw Error("{}: shader does not compile, where {}: {}", source.name,
                    numbers_of(source, included), log.c_str());
    }
    return shader;
}

} // namespace

const ShaderSource& shader_file(std::string_view name) {
    for (const ShaderSource& file : shader_files())
        if (file.name == name)
            return file;
    throw Error("{}: no such shader file", name);
}

bool has_extension(const Gl& gl, std::string_view name) {
    GLint count = 0;
    gl.GetIntegerv(GL_NUM_EXTENSIONS, &count);
    for (GLint i = 0; i < count; ++i)
        if (reinterpret_cast<const char*>(gl.GetStringi(GL_EXTENSIONS, i)) == name)
            return true;
    return false;
}

Program link_program(const Gl& gl, const std::vector<ShaderSource>& sources,
                     std::string_view prelude) {
    Program program(gl);
    std::vector<Shader> shaders;
    for (const ShaderSource& source : sources)
        gl.AttachShader(program.name(), shaders.emplace_back(compile(gl, source, prelude)).name());
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
        names.reserve(sources.size());
        for (const ShaderSource& source : sources)
            names.push_back(source.name);
        throw Error("{}: shaders do not link: {}", fmt::join(names, ", "), log.c_str());
    }
    ++links;
    return program;
}

GLuint LazyProgram::name() const {
    if (!program_) {
        program_.emplace(link_program(*gl_, sources_, prelude_));
        if (linked_)
            linked_(program_->name());
    }
    return program_->name();
}

std::size_t linked_programs() {
    return links;
}

} // namespace isochron::render
