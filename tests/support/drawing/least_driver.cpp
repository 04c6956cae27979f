// The limits of the least driver, and the checks that calls keep to them.
#include "tests/support/drawing/least_driver.h"

#include "tests/support/drawing/context_in_between.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string_view>
#include <utility>

namespace isochron::test_support {
namespace {

struct {
    std::map<GLenum, GLint64> limits;
    PFNGLGETSTRINGPROC string = nullptr;
    PFNGLGETINTEGERVPROC integer = nullptr;
    PFNGLGETINTEGER64VPROC integer64 = nullptr;
    PFNGLGETINTEGERI_VPROC indexed = nullptr;
    PFNGLGETFLOATVPROC number = nullptr;
    PFNGLBINDBUFFERBASEPROC bind_base = nullptr;
    PFNGLBINDBUFFERRANGEPROC bind_range = nullptr;
    PFNGLNAMEDBUFFERDATAPROC buffer_data = nullptr;
    PFNGLTEXTUREBUFFERPROC texture_buffer = nullptr;
    PFNGLTEXTURESTORAGE2DPROC storage = nullptr;
    PFNGLNAMEDRENDERBUFFERSTORAGEMULTISAMPLEPROC samples = nullptr;
    PFNGLBINDTEXTUREUNITPROC bind_texture = nullptr;
    PFNGLVIEWPORTINDEXEDFPROC viewport = nullptr;
    PFNGLDISPATCHCOMPUTEPROC dispatch = nullptr;
    PFNGLDRAWARRAYSINSTANCEDPROC draw_points = nullptr;
    std::map<GLuint, GLint64> bytes; ///< sizes of buffers
} driver;

GLint64 most(GLenum name) {
    const auto found = driver.limits.find(name);
    return found == driver.limits.end() ? std::numeric_limits<GLint64>::max() : found->second;
}

const GLubyte* APIENTRY string(GLenum name) {
    return name == GL_RENDERER ? reinterpret_cast<const GLubyte*>("a GPU") : driver.string(name);
}

void APIENTRY integer(GLenum name, GLint* value) {
    driver.integer(name, value);
    if (const auto found = driver.limits.find(name); found != driver.limits.end()) {
        value[0] = static_cast<GLint>(found->second);
        if (name == GL_MAX_VIEWPORT_DIMS)
            value[1] = value[0];
    }
}
void APIENTRY integer64(GLenum name, GLint64* value) {
    driver.integer64(name, value);
    if (const auto found = driver.limits.find(name); found != driver.limits.end())
        *value = found->second;
}
void APIENTRY indexed(GLenum name, GLuint index, GLint* value) {
    driver.indexed(name, index, value);
    if (const auto found = driver.limits.find(name); found != driver.limits.end())
        *value = static_cast<GLint>(found->second);
}
void APIENTRY number(GLenum name, GLfloat* value) {
    driver.number(name, value);
    if (const auto found = driver.limits.find(name); found != driver.limits.end())
        value[1] = static_cast<GLfloat>(found->second); // a range of point sizes
}

void expect_binding(GLenum target, GLuint index, GLint64 bytes) {
    const bool storage = target == GL_SHADER_STORAGE_BUFFER;
    EXPECT_LT(index, most(storage ? GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS
                                  : GL_MAX_UNIFORM_BUFFER_BINDINGS));
    EXPECT_LE(bytes, most(storage ? GL_MAX_SHADER_STORAGE_BLOCK_SIZE : GL_MAX_UNIFORM_BLOCK_SIZE));
}
void APIENTRY bind_base(GLenum target, GLuint index, GLuint buffer) {
    expect_binding(target, index, driver.bytes[buffer]);
    driver.bind_base(target, index, buffer);
}
void APIENTRY bind_range(GLenum target, GLuint index, GLuint buffer, GLintptr offset,
                         GLsizeiptr size) {
    expect_binding(target, index, size);
    const GLenum alignment = target == GL_SHADER_STORAGE_BUFFER
                                 ? GL_SHADER_STORAGE_BUFFER_OFFSET_ALIGNMENT
                                 : GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT;
    if (driver.limits.contains(alignment)) {
        EXPECT_EQ(offset % most(alignment), 0);
    }
    driver.bind_range(target, index, buffer, offset, size);
}
void APIENTRY buffer_data(GLuint buffer, GLsizeiptr size, const void* data, GLenum usage) {
    driver.bytes[buffer] = size;
    driver.buffer_data(buffer, size, data, usage);
}
GLint64 texel_bytes(GLenum format) {
    switch (format) {
    case GL_R8I:
    case GL_R8UI: return 1;
    case GL_R16I:
    case GL_R16UI: return 2;
    case GL_R32F:
    case GL_R32UI: return 4;
    case GL_RG32UI: return 8;
    case GL_RGB32UI: return 12;
    case GL_RGBA32F:
    case GL_RGBA32UI: return 16;
    default: ADD_FAILURE() << "texels of an unknown format " << format; return 1;
    }
}
void APIENTRY texture_buffer(GLuint texture, GLenum format, GLuint buffer) {
    EXPECT_LE(driver.bytes[buffer] / texel_bytes(format), most(GL_MAX_TEXTURE_BUFFER_SIZE));
    driver.texture_buffer(texture, format, buffer);
}
void APIENTRY storage(GLuint texture, GLsizei levels, GLenum format, GLsizei width,
                      GLsizei height) {
    EXPECT_LE(std::max(width, height), most(GL_MAX_TEXTURE_SIZE));
    driver.storage(texture, levels, format, width, height);
}
void APIENTRY samples(GLuint renderbuffer, GLsizei count, GLenum format, GLsizei width,
                      GLsizei height) {
    EXPECT_LE(count, most(GL_MAX_SAMPLES));
    EXPECT_LE(std::max(width, height), most(GL_MAX_RENDERBUFFER_SIZE));
    driver.samples(renderbuffer, count, format, width, height);
}
void APIENTRY bind_texture(GLuint unit, GLuint texture) {
    EXPECT_LT(unit, most(GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS));
    driver.bind_texture(unit, texture);
}
void APIENTRY viewport(GLuint index, GLfloat x, GLfloat y, GLfloat width, GLfloat height) {
    EXPECT_LT(index, most(GL_MAX_VIEWPORTS));
    EXPECT_LE(std::max(width, height), static_cast<GLfloat>(most(GL_MAX_VIEWPORT_DIMS)));
    driver.viewport(index, x, y, width, height);
}
void APIENTRY dispatch(GLuint x, GLuint y, GLuint z) {
    EXPECT_LE(std::max({x, y, z}), most(GL_MAX_COMPUTE_WORK_GROUP_COUNT));
    driver.dispatch(x, y, z);
}
/// Only cells are drawn as points; tests draw none that is smaller than two pixels.
void APIENTRY draw_points(GLenum mode, GLint first, GLsizei count, GLsizei instances) {
    if (mode == GL_POINTS) {
        EXPECT_GE(most(GL_POINT_SIZE_RANGE), 2);
    }
    driver.draw_points(mode, first, count, instances);
}

} // namespace

std::map<GLenum, GLint64> least_limits() {
    return {
        {GL_MAX_TEXTURE_SIZE, 16384},
        {GL_MAX_RENDERBUFFER_SIZE, 16384},
        {GL_MAX_VIEWPORT_DIMS, 16384},
        {GL_MAX_VIEWPORTS, 16},
        {GL_MAX_SAMPLES, 4},
        {GL_POINT_SIZE_RANGE, 1},
        {GL_MAX_TEXTURE_BUFFER_SIZE, 65536},
        {GL_MAX_TEXTURE_IMAGE_UNITS, 16},
        {GL_MAX_VERTEX_TEXTURE_IMAGE_UNITS, 16},
        {GL_MAX_COMPUTE_TEXTURE_IMAGE_UNITS, 16},
        {GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS, 96},
        {GL_MAX_UNIFORM_BUFFER_BINDINGS, 84},
        {GL_MAX_UNIFORM_BLOCK_SIZE, 16384},
        {GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT, 256},
        {GL_MAX_VERTEX_UNIFORM_BLOCKS, 14},
        {GL_MAX_FRAGMENT_UNIFORM_BLOCKS, 14},
        {GL_MAX_COMPUTE_UNIFORM_BLOCKS, 14},
        {GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS, 8},
        {GL_MAX_SHADER_STORAGE_BLOCK_SIZE, 1 << 24}, // as GL 4.3 has it, where 4.5 has 2^27
        {GL_SHADER_STORAGE_BUFFER_OFFSET_ALIGNMENT, 256},
        {GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS, 0},
        {GL_MAX_FRAGMENT_SHADER_STORAGE_BLOCKS, 8},
        {GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS, 8},
        {GL_MAX_COMPUTE_WORK_GROUP_COUNT, 65535},
        {GL_MAX_COMPUTE_WORK_GROUP_SIZE, 1024},
        {GL_MAX_COMPUTE_WORK_GROUP_INVOCATIONS, 1024},
        {GL_MAX_VERTEX_ATTRIBS, 16},
        {GL_MAX_VARYING_VECTORS, 15},
        {GL_MAX_VERTEX_OUTPUT_COMPONENTS, 64},
        {GL_MAX_FRAGMENT_INPUT_COMPONENTS, 128},
    };
}

std::function<void*(std::string_view, void*)> with_limits(std::map<GLenum, GLint64> limits) {
    driver = {};
    driver.limits = std::move(limits);
    return [](std::string_view name, void* found) {
#define STAND_BEFORE(entry, place)                                                                 \
    if (name == "gl" #entry)                                                                       \
        return stereo::before(found, driver.place, &(place));
        STAND_BEFORE(GetString, string)
        STAND_BEFORE(GetIntegerv, integer)
        STAND_BEFORE(GetInteger64v, integer64)
        STAND_BEFORE(GetIntegeri_v, indexed)
        STAND_BEFORE(GetFloatv, number)
        STAND_BEFORE(BindBufferBase, bind_base)
        STAND_BEFORE(BindBufferRange, bind_range)
        STAND_BEFORE(NamedBufferData, buffer_data)
        STAND_BEFORE(TextureBuffer, texture_buffer)
        STAND_BEFORE(TextureStorage2D, storage)
        STAND_BEFORE(NamedRenderbufferStorageMultisample, samples)
        STAND_BEFORE(BindTextureUnit, bind_texture)
        STAND_BEFORE(ViewportIndexedf, viewport)
        STAND_BEFORE(DispatchCompute, dispatch)
        STAND_BEFORE(DrawArraysInstanced, draw_points)
#undef STAND_BEFORE
        return found;
    };
}

} // namespace isochron::test_support
