// Writes every shader as a driver gets it, for glslangValidator: all passes are made with a driver
// that keeps what it is given and says yes to it.
//
//     shader_texts FOLDER
//
// fills FOLDER with one file for each text, numbered: 07.cell.vert.
#include "app/panel/imgui/panel_layer.h"
#include "render/cells/cell_compute.h"
#include "render/drawing/cell_pass.h"
#include "render/gl/shader.h"
#include "render/passes/background_pass.h"
#include "render/passes/enlarge_pass.h"
#include "render/passes/layer_pass.h"
#include "render/passes/line_pass.h"
#include "render/passes/panel_pass.h"
#include "render/passes/picture_pass.h"
#include "render/passes/reproject_pass.h"
#include "render/passes/sample_sum.h"
#include "render/drawing/ghost_pass.h"
#include "render/drawing/slice_pass.h"
#include "render/drawing/triangle_pass.h"
#include "render/passes/solid_pass.h"
#include "render/passes/text_pass.h"
#include "render/passes/veil_pass.h"
#include "stereo/multiplex.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <string_view>

namespace isochron {
namespace {

using render::Gl;

/// Texts of shaders, each once. GL's functions have no room for state.
std::set<std::string> given;

void APIENTRY take_source(GLuint, GLsizei, const GLchar* const* text, const GLint* length) {
    given.emplace(*text, static_cast<std::size_t>(*length));
}
void APIENTRY say_yes(GLuint, GLenum, GLint* answer) {
    *answer = GL_TRUE;
}
/// One extension, and room for everything.
void APIENTRY much(GLenum name, GLint* value) {
    *value = name == GL_NUM_EXTENSIONS ? 1 : 1 << 30;
    if (name == GL_MAX_VIEWPORT_DIMS)
        value[1] = *value;
}
void APIENTRY much_more(GLenum, GLint64* value) {
    *value = GLint64{1} << 40;
}
void APIENTRY much_of_each(GLenum, GLuint, GLint* value) {
    *value = 1 << 30;
}
GLenum APIENTRY complete(GLuint, GLenum) {
    return GL_FRAMEBUFFER_COMPLETE;
}
GLuint APIENTRY some_object() {
    return 1;
}
GLuint APIENTRY some_shader(GLenum) {
    return 1;
}
void APIENTRY some_objects(GLsizei count, GLuint* names) {
    std::fill_n(names, count, 1u);
}
void APIENTRY some_objects_of(GLenum, GLsizei count, GLuint* names) {
    std::fill_n(names, count, 1u);
}
/// Whatever was to be drawn is there.
void APIENTRY all_white(GLuint, GLint, GLint, GLint, GLint, GLsizei, GLsizei, GLsizei, GLenum,
                        GLenum, GLsizei size, void* pixels) {
    std::memset(pixels, 255, static_cast<std::size_t>(size));
}
const GLubyte* APIENTRY extension(GLenum, GLuint) {
    return reinterpret_cast<const GLubyte*>("GL_ARB_shader_viewport_layer_array");
}

/// An entry point of the same type that does nothing.
template <class Function>
struct Silent;
template <class Result, class... Arguments>
struct Silent<Result(APIENTRYP)(Arguments...)> {
    static Result APIENTRY call(Arguments...) { return Result(); }
};

Gl listening_driver() {
    std::map<std::string_view, void*> entries;
#define SILENT_ENTRY(type, name) entries["gl" #name] = reinterpret_cast<void*>(&Silent<type>::call);
    ISOCHRON_GL_ENTRY_POINTS(SILENT_ENTRY)
#undef SILENT_ENTRY
    Gl gl([&](const char* name) { return entries.at(name); });
    gl.links_at_once = true;
    gl.ShaderSource = take_source;
    gl.GetShaderiv = say_yes;
    gl.GetProgramiv = say_yes;
    gl.GetIntegerv = much;
    gl.GetInteger64v = much_more;
    gl.GetIntegeri_v = much_of_each;
    gl.GetStringi = extension;
    gl.CreateProgram = some_object;
    gl.CreateShader = some_shader;
    for (auto create : {&gl.CreateBuffers, &gl.CreateVertexArrays, &gl.CreateFramebuffers,
                        &gl.CreateRenderbuffers})
        *create = some_objects;
    for (auto create : {&gl.CreateTextures, &gl.CreateQueries})
        *create = some_objects_of;
    gl.CheckNamedFramebufferStatus = complete;
    gl.GetTextureSubImage = all_white;
    return gl;
}

/// Everything that links programs, in each of its variants.
void make_all_passes(const Gl& gl) {
    using index::ValueType;
    const index::Grid even{.vertices = {2, 2, 2}};
    index::Grid uneven{.vertices = {3, 2, 2}, .spacing = {1.5, 1, 1}};
    uneven.positions[0] = index::AxisPositions({0, 1, 3});
    for (const index::Grid& grid : {even, uneven})
        for (const ValueType held : {ValueType::u8, ValueType::i16, ValueType::f32}) {
            const render::AxisTable axes(gl, grid);
            const render::CellCompute compute(gl, grid, axes, held);
        }
    const render::CellPass cells(gl), spheres(gl, {.shape = render::CellShape::voxel});
    const render::CellPass uneven_cells(gl, {}, render::prelude_for(uneven)),
        uneven_spheres(gl, {.shape = render::CellShape::voxel}, render::prelude_for(uneven));
    if (!cells.draws_two_views_at_once())
        throw render::Error("shader_texts: cells should be drawn for two eyes at once, too");
    const render::BackgroundPass background(gl);
    const render::EnlargePass enlarge(gl);
    const render::ReprojectPass reproject(gl);
    const render::LayerPass layers(gl);
    const render::LinePass lines(gl);
    const render::PanelPass panels(gl);
    const render::PicturePass pictures(gl);
    const render::SlicePass slices(gl, even), uneven_slices(gl, uneven);
    const render::TrianglePass triangles(gl, even);
    const render::GhostPass ghosts(gl, even), uneven_ghosts(gl, uneven),
        opaque(gl, even, render::GhostKind::opaque), opaque_uneven(gl, uneven, render::GhostKind::opaque);
    const render::SolidPass solids(gl);
    const render::TextPass text(
        gl, render::GlyphAtlas{.size = {1, 1}, .coverage = {0}, .halo = {}, .glyphs = {}});
    const render::SampleSum sum(gl);
    const render::VeilPass veil(gl);
    const stereo::Multiplex multiplex(gl);
    const app::PanelLayer layer(gl);
}

/// A shader's text for glslangValidator, which knows files by their names where this extension is
/// on, and the name of the file that it was made of.
struct Text {
    std::string file, text;
};
Text with_names(const std::string& given_text) {
    constexpr std::string_view kLine = "#line ", kVersion = "#version";
    Text result;
    std::istringstream lines(given_text);
    for (std::string line; std::getline(lines, line);) {
        std::size_t number = 0, file = 0;
        if (line.starts_with(kLine) &&
            std::sscanf(line.c_str(), "#line %zu %zu", &number, &file) == 2) {
            const render::ShaderSource& source = render::shader_files().at(file);
            if (result.file.empty())
                result.file = source.name;
            line = fmt::format("#line {} \"render/shaders/{}\"", number, source.path);
        }
        result.text += line + '\n';
        if (line.starts_with(kVersion))
            result.text += "#extension GL_GOOGLE_cpp_style_line_directive : require\n";
    }
    return result;
}

void write(const std::filesystem::path& path, const std::string& text) {
    std::ofstream file(path, std::ios::binary);
    if (!(file << text).flush())
        throw render::Error(path.string() + ": cannot be written");
}

void write_all(const std::filesystem::path& folder) {
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    std::set<std::string> found;
    int number = 0;
    for (const std::string& given_text : given) {
        const Text text = with_names(given_text);
        found.insert(text.file);
        write(folder / fmt::format("{:02}.{}", ++number, text.file), text.text);
    }
    for (const render::ShaderSource& file : render::shader_files())
        if (!file.name.ends_with(".glsl") && !found.contains(std::string(file.name)))
            throw render::Error(
                "render/shaders/{}: used by no pass that tests/shaders/shader_texts.cpp makes",
                file.path);
}

} // namespace
} // namespace isochron

int main(int count, char** arguments) {
    if (count != 2) {
        std::fputs("usage: shader_texts FOLDER\n", stderr);
        return 2;
    }
    try {
        const isochron::render::Gl gl = isochron::listening_driver();
        isochron::make_all_passes(gl);
        isochron::write_all(arguments[1]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
    return 0;
}
