// Counts the calls that make something, and lets one of them fail.
#include "tests/support/drawing/faulty_driver.h"

#include <map>

namespace isochron::test_support {
namespace {

struct {
    long at = 0, calls = 0;
    std::string failed;
    bool out_of_memory = false; ///< not told yet
    std::map<std::string, void*, std::less<>> found;
} faults;

/// Counts a call. @return whether it is to fail
bool fails(const char* name) {
    if (++faults.calls != faults.at)
        return false;
    faults.failed = name;
    return true;
}

template <class Function>
Function actual(const char* name) {
    return reinterpret_cast<Function>(faults.found.find(name)->second);
}

// clang-format off
#define ISOCHRON_NAMES(type, name)                                                                  \
    void APIENTRY name(GLsizei count, GLuint* names) {                                              \
        if (!fails("gl" #name)) return actual<type>("gl" #name)(count, names);                      \
        faults.out_of_memory = true;                                                                \
    }
#define ISOCHRON_TARGET_NAMES(type, name)                                                           \
    void APIENTRY name(GLenum target, GLsizei count, GLuint* names) {                               \
        if (!fails("gl" #name)) return actual<type>("gl" #name)(target, count, names);              \
        faults.out_of_memory = true;                                                                \
    }
ISOCHRON_NAMES(PFNGLCREATEBUFFERSPROC, CreateBuffers)
ISOCHRON_NAMES(PFNGLCREATEVERTEXARRAYSPROC, CreateVertexArrays)
ISOCHRON_NAMES(PFNGLCREATEFRAMEBUFFERSPROC, CreateFramebuffers)
ISOCHRON_NAMES(PFNGLCREATERENDERBUFFERSPROC, CreateRenderbuffers)
ISOCHRON_TARGET_NAMES(PFNGLCREATETEXTURESPROC, CreateTextures)
ISOCHRON_TARGET_NAMES(PFNGLCREATEQUERIESPROC, CreateQueries)
#undef ISOCHRON_NAMES
#undef ISOCHRON_TARGET_NAMES
// clang-format on

// NOLINTBEGIN(readability-identifier-naming): named as the entry points of GL are
GLuint APIENTRY CreateProgram() {
    return fails("glCreateProgram") ? 0 : actual<PFNGLCREATEPROGRAMPROC>("glCreateProgram")();
}
GLuint APIENTRY CreateShader(GLenum stage) {
    return fails("glCreateShader") ? 0 : actual<PFNGLCREATESHADERPROC>("glCreateShader")(stage);
}

/// Memory: the call does nothing but set GL's error.
template <class Function, class... Arguments>
void allocate(const char* name, Arguments... arguments) {
    if (fails(name))
        faults.out_of_memory = true;
    else
        actual<Function>(name)(arguments...);
}
void APIENTRY NamedBufferStorage(GLuint buffer, GLsizeiptr bytes, const void* data,
                                 GLbitfield flags) {
    allocate<PFNGLNAMEDBUFFERSTORAGEPROC>("glNamedBufferStorage", buffer, bytes, data, flags);
}
void APIENTRY NamedBufferData(GLuint buffer, GLsizeiptr bytes, const void* data, GLenum usage) {
    allocate<PFNGLNAMEDBUFFERDATAPROC>("glNamedBufferData", buffer, bytes, data, usage);
}
void APIENTRY TextureStorage1D(GLuint texture, GLsizei levels, GLenum format, GLsizei width) {
    allocate<PFNGLTEXTURESTORAGE1DPROC>("glTextureStorage1D", texture, levels, format, width);
}
void APIENTRY TextureStorage2D(GLuint texture, GLsizei levels, GLenum format, GLsizei width,
                               GLsizei height) {
    allocate<PFNGLTEXTURESTORAGE2DPROC>("glTextureStorage2D", texture, levels, format, width,
                                        height);
}
void APIENTRY TextureStorage3D(GLuint texture, GLsizei levels, GLenum format, GLsizei width,
                               GLsizei height, GLsizei depth) {
    allocate<PFNGLTEXTURESTORAGE3DPROC>("glTextureStorage3D", texture, levels, format, width,
                                        height, depth);
}
void APIENTRY NamedRenderbufferStorageMultisample(GLuint buffer, GLsizei samples, GLenum format,
                                                  GLsizei width, GLsizei height) {
    allocate<PFNGLNAMEDRENDERBUFFERSTORAGEMULTISAMPLEPROC>("glNamedRenderbufferStorageMultisample",
                                                           buffer, samples, format, width, height);
}

void* APIENTRY MapNamedBufferRange(GLuint buffer, GLintptr offset, GLsizeiptr bytes,
                                   GLbitfield access) {
    constexpr const char* kName = "glMapNamedBufferRange";
    return fails(kName)
               ? nullptr
               : actual<PFNGLMAPNAMEDBUFFERRANGEPROC>(kName)(buffer, offset, bytes, access);
}
GLsync APIENTRY FenceSync(GLenum condition, GLbitfield flags) {
    return fails("glFenceSync") ? nullptr
                                : actual<PFNGLFENCESYNCPROC>("glFenceSync")(condition, flags);
}
GLenum APIENTRY CheckNamedFramebufferStatus(GLuint framebuffer, GLenum target) {
    constexpr const char* kName = "glCheckNamedFramebufferStatus";
    return fails(kName) ? GL_FRAMEBUFFER_UNSUPPORTED
                        : actual<PFNGLCHECKNAMEDFRAMEBUFFERSTATUSPROC>(kName)(framebuffer, target);
}
void APIENTRY GetShaderiv(GLuint shader, GLenum what, GLint* value) {
    actual<PFNGLGETSHADERIVPROC>("glGetShaderiv")(shader, what, value);
    if (what == GL_COMPILE_STATUS && fails("glCompileShader"))
        *value = GL_FALSE;
}
void APIENTRY GetProgramiv(GLuint program, GLenum what, GLint* value) {
    actual<PFNGLGETPROGRAMIVPROC>("glGetProgramiv")(program, what, value);
    if (what == GL_LINK_STATUS && fails("glLinkProgram"))
        *value = GL_FALSE;
}
GLenum APIENTRY GetError() {
    if (faults.out_of_memory) {
        faults.out_of_memory = false;
        return GL_OUT_OF_MEMORY;
    }
    return actual<PFNGLGETERRORPROC>("glGetError")();
}
// NOLINTEND(readability-identifier-naming)

} // namespace

std::function<void*(std::string_view, void*)> with_fault(long at) {
    faults = {};
    faults.at = at;
    return [](std::string_view name, void* found) -> void* {
        faults.found.insert_or_assign(std::string(name), found);
#define ISOCHRON_FAULTY(entry)                                                                     \
    if (name == "gl" #entry)                                                                       \
        return reinterpret_cast<void*>(entry);
        ISOCHRON_FAULTY(CreateBuffers)
        ISOCHRON_FAULTY(CreateVertexArrays)
        ISOCHRON_FAULTY(CreateFramebuffers)
        ISOCHRON_FAULTY(CreateRenderbuffers)
        ISOCHRON_FAULTY(CreateTextures)
        ISOCHRON_FAULTY(CreateQueries)
        ISOCHRON_FAULTY(CreateProgram)
        ISOCHRON_FAULTY(CreateShader)
        ISOCHRON_FAULTY(NamedBufferStorage)
        ISOCHRON_FAULTY(NamedBufferData)
        ISOCHRON_FAULTY(TextureStorage1D)
        ISOCHRON_FAULTY(TextureStorage2D)
        ISOCHRON_FAULTY(TextureStorage3D)
        ISOCHRON_FAULTY(NamedRenderbufferStorageMultisample)
        ISOCHRON_FAULTY(MapNamedBufferRange)
        ISOCHRON_FAULTY(FenceSync)
        ISOCHRON_FAULTY(CheckNamedFramebufferStatus)
        ISOCHRON_FAULTY(GetShaderiv)
        ISOCHRON_FAULTY(GetProgramiv)
        ISOCHRON_FAULTY(GetError)
#undef ISOCHRON_FAULTY
        return found;
    };
}

std::string failed_call() {
    return faults.failed;
}

} // namespace isochron::test_support
