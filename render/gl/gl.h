// The table of GL entry points, loaded from the current context; tests can replace entries by
// fakes.
//
//     const render::Gl gl(context.loader());
//     gl.Clear(GL_COLOR_BUFFER_BIT);
#pragma once

#include "render/gl/drawn_by.h"

#include <fmt/core.h>

#include <functional>
#include <stdexcept>
#include <utility>

#include <GL/glcorearb.h>

namespace isochron::render {

/// The only exception type of `render` and `stereo`. One line says what failed, where, what was
/// expected and what was got; a shader's log may follow on more lines.
class Error : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
    /// The message as a format with its values.
    template <class... Values>
    explicit Error(fmt::format_string<Values...> text, Values&&... values)
        : std::runtime_error(fmt::format(text, std::forward<Values>(values)...)) {}
};

/// Returns the address of a GL entry point by its full name (`glClear`), or null.
using GlLoader = std::function<void*(const char*)>;

// clang-format off
/// Every entry point that the program calls, as ENTRY(type, name without `gl`): GL 4.5 core.
#define ISOCHRON_GL_ENTRY_POINTS(ENTRY)                                                                      \
    /* State */                                                                                              \
    ENTRY(PFNGLENABLEPROC, Enable)                                                                           \
    ENTRY(PFNGLDISABLEPROC, Disable)                                                                         \
    ENTRY(PFNGLISENABLEDPROC, IsEnabled)                                                                     \
    ENTRY(PFNGLBLENDFUNCPROC, BlendFunc)                                                                     \
    ENTRY(PFNGLBLENDFUNCSEPARATEPROC, BlendFuncSeparate)                                                     \
    ENTRY(PFNGLBLENDEQUATIONPROC, BlendEquation)                                                             \
    ENTRY(PFNGLDEPTHFUNCPROC, DepthFunc)                                                                     \
    ENTRY(PFNGLDEPTHMASKPROC, DepthMask)                                                                     \
    ENTRY(PFNGLDEPTHRANGEPROC, DepthRange)                                                                   \
    ENTRY(PFNGLCOLORMASKPROC, ColorMask)                                                                     \
    ENTRY(PFNGLSCISSORPROC, Scissor)                                                                         \
    ENTRY(PFNGLVIEWPORTPROC, Viewport)                                                                       \
    ENTRY(PFNGLVIEWPORTINDEXEDFPROC, ViewportIndexedf)                                                       \
    ENTRY(PFNGLSCISSORINDEXEDPROC, ScissorIndexed)                                                           \
    ENTRY(PFNGLPIXELSTOREIPROC, PixelStorei)                                                                 \
    ENTRY(PFNGLCLEARCOLORPROC, ClearColor)                                                                   \
    ENTRY(PFNGLCLEARDEPTHPROC, ClearDepth)                                                                   \
    ENTRY(PFNGLCLEARPROC, Clear)                                                                             \
    ENTRY(PFNGLGETINTEGERVPROC, GetIntegerv)                                                                 \
    ENTRY(PFNGLGETINTEGER64VPROC, GetInteger64v)                                                             \
    ENTRY(PFNGLGETINTEGERI_VPROC, GetIntegeri_v)                                                             \
    ENTRY(PFNGLGETFLOATVPROC, GetFloatv)                                                                     \
    ENTRY(PFNGLGETSTRINGPROC, GetString)                                                                     \
    ENTRY(PFNGLGETSTRINGIPROC, GetStringi)                                                                   \
    ENTRY(PFNGLGETERRORPROC, GetError)                                                                       \
    ENTRY(PFNGLGETGRAPHICSRESETSTATUSPROC, GetGraphicsResetStatus)                                           \
    ENTRY(PFNGLFINISHPROC, Finish)                                                                           \
    ENTRY(PFNGLFLUSHPROC, Flush)                                                                             \
    /* Buffers */                                                                                            \
    ENTRY(PFNGLCREATEBUFFERSPROC, CreateBuffers)                                                             \
    ENTRY(PFNGLDELETEBUFFERSPROC, DeleteBuffers)                                                             \
    ENTRY(PFNGLBINDBUFFERPROC, BindBuffer)                                                                   \
    ENTRY(PFNGLBINDBUFFERBASEPROC, BindBufferBase)                                                           \
    ENTRY(PFNGLBINDBUFFERRANGEPROC, BindBufferRange)                                                         \
    ENTRY(PFNGLNAMEDBUFFERSTORAGEPROC, NamedBufferStorage)                                                   \
    ENTRY(PFNGLNAMEDBUFFERDATAPROC, NamedBufferData)                                                         \
    ENTRY(PFNGLNAMEDBUFFERSUBDATAPROC, NamedBufferSubData)                                                   \
    ENTRY(PFNGLCOPYNAMEDBUFFERSUBDATAPROC, CopyNamedBufferSubData)                                           \
    ENTRY(PFNGLMAPNAMEDBUFFERRANGEPROC, MapNamedBufferRange)                                                 \
    ENTRY(PFNGLGETNAMEDBUFFERSUBDATAPROC, GetNamedBufferSubData)                                             \
    /* Vertex arrays */                                                                                      \
    ENTRY(PFNGLCREATEVERTEXARRAYSPROC, CreateVertexArrays)                                                   \
    ENTRY(PFNGLDELETEVERTEXARRAYSPROC, DeleteVertexArrays)                                                   \
    ENTRY(PFNGLBINDVERTEXARRAYPROC, BindVertexArray)                                                         \
    ENTRY(PFNGLENABLEVERTEXARRAYATTRIBPROC, EnableVertexArrayAttrib)                                         \
    ENTRY(PFNGLVERTEXARRAYATTRIBFORMATPROC, VertexArrayAttribFormat)                                         \
    ENTRY(PFNGLVERTEXARRAYATTRIBIFORMATPROC, VertexArrayAttribIFormat)                                       \
    ENTRY(PFNGLVERTEXARRAYATTRIBBINDINGPROC, VertexArrayAttribBinding)                                       \
    ENTRY(PFNGLVERTEXARRAYVERTEXBUFFERPROC, VertexArrayVertexBuffer)                                         \
    ENTRY(PFNGLVERTEXARRAYELEMENTBUFFERPROC, VertexArrayElementBuffer)                                       \
    /* Drawing */                                                                                            \
    ENTRY(PFNGLDRAWARRAYSPROC, DrawArrays)                                                                   \
    ENTRY(PFNGLDRAWARRAYSINSTANCEDPROC, DrawArraysInstanced)                                                 \
    ENTRY(PFNGLDRAWELEMENTSPROC, DrawElements)                                                               \
    ENTRY(PFNGLDRAWELEMENTSBASEVERTEXPROC, DrawElementsBaseVertex)                                           \
    ENTRY(PFNGLDRAWELEMENTSINSTANCEDPROC, DrawElementsInstanced)                                             \
    ENTRY(PFNGLDRAWELEMENTSINSTANCEDBASEVERTEXPROC, DrawElementsInstancedBaseVertex)                         \
    /* Textures */                                                                                           \
    ENTRY(PFNGLCREATETEXTURESPROC, CreateTextures)                                                           \
    ENTRY(PFNGLDELETETEXTURESPROC, DeleteTextures)                                                           \
    ENTRY(PFNGLBINDTEXTUREUNITPROC, BindTextureUnit)                                                         \
    ENTRY(PFNGLACTIVETEXTUREPROC, ActiveTexture)                                                             \
    ENTRY(PFNGLTEXTURESTORAGE1DPROC, TextureStorage1D)                                                       \
    ENTRY(PFNGLTEXTURESTORAGE2DPROC, TextureStorage2D)                                                       \
    ENTRY(PFNGLTEXTURESTORAGE3DPROC, TextureStorage3D)                                                       \
    ENTRY(PFNGLTEXTURESUBIMAGE1DPROC, TextureSubImage1D)                                                     \
    ENTRY(PFNGLTEXTURESUBIMAGE2DPROC, TextureSubImage2D)                                                     \
    ENTRY(PFNGLTEXTURESUBIMAGE3DPROC, TextureSubImage3D)                                                     \
    ENTRY(PFNGLTEXTUREBUFFERPROC, TextureBuffer)                                                             \
    ENTRY(PFNGLTEXTUREPARAMETERIPROC, TextureParameteri)                                                     \
    ENTRY(PFNGLGETTEXTURESUBIMAGEPROC, GetTextureSubImage)                                                   \
    ENTRY(PFNGLGENERATETEXTUREMIPMAPPROC, GenerateTextureMipmap)                                             \
    /* Framebuffers */                                                                                       \
    ENTRY(PFNGLCREATEFRAMEBUFFERSPROC, CreateFramebuffers)                                                   \
    ENTRY(PFNGLDELETEFRAMEBUFFERSPROC, DeleteFramebuffers)                                                   \
    ENTRY(PFNGLBINDFRAMEBUFFERPROC, BindFramebuffer)                                                         \
    ENTRY(PFNGLNAMEDFRAMEBUFFERTEXTUREPROC, NamedFramebufferTexture)                                         \
    ENTRY(PFNGLNAMEDFRAMEBUFFERRENDERBUFFERPROC, NamedFramebufferRenderbuffer)                               \
    ENTRY(PFNGLCHECKNAMEDFRAMEBUFFERSTATUSPROC, CheckNamedFramebufferStatus)                                 \
    ENTRY(PFNGLBLITNAMEDFRAMEBUFFERPROC, BlitNamedFramebuffer)                                               \
    ENTRY(PFNGLCLEARNAMEDFRAMEBUFFERFVPROC, ClearNamedFramebufferfv)                                         \
    ENTRY(PFNGLCREATERENDERBUFFERSPROC, CreateRenderbuffers)                                                 \
    ENTRY(PFNGLDELETERENDERBUFFERSPROC, DeleteRenderbuffers)                                                 \
    ENTRY(PFNGLNAMEDRENDERBUFFERSTORAGEMULTISAMPLEPROC, NamedRenderbufferStorageMultisample)                 \
    ENTRY(PFNGLDRAWBUFFERPROC, DrawBuffer)                                                                   \
    ENTRY(PFNGLREADPIXELSPROC, ReadPixels)                                                                   \
    /* Compute */                                                                                            \
    ENTRY(PFNGLDISPATCHCOMPUTEPROC, DispatchCompute)                                                         \
    ENTRY(PFNGLMEMORYBARRIERPROC, MemoryBarrier)                                                             \
    /* Programs */                                                                                           \
    ENTRY(PFNGLCREATESHADERPROC, CreateShader)                                                               \
    ENTRY(PFNGLDELETESHADERPROC, DeleteShader)                                                               \
    ENTRY(PFNGLSHADERSOURCEPROC, ShaderSource)                                                               \
    ENTRY(PFNGLCOMPILESHADERPROC, CompileShader)                                                             \
    ENTRY(PFNGLGETSHADERIVPROC, GetShaderiv)                                                                 \
    ENTRY(PFNGLGETSHADERINFOLOGPROC, GetShaderInfoLog)                                                       \
    ENTRY(PFNGLCREATEPROGRAMPROC, CreateProgram)                                                             \
    ENTRY(PFNGLDELETEPROGRAMPROC, DeleteProgram)                                                             \
    ENTRY(PFNGLATTACHSHADERPROC, AttachShader)                                                               \
    ENTRY(PFNGLDETACHSHADERPROC, DetachShader)                                                               \
    ENTRY(PFNGLLINKPROGRAMPROC, LinkProgram)                                                                 \
    ENTRY(PFNGLGETPROGRAMIVPROC, GetProgramiv)                                                               \
    ENTRY(PFNGLGETPROGRAMINFOLOGPROC, GetProgramInfoLog)                                                     \
    ENTRY(PFNGLUSEPROGRAMPROC, UseProgram)                                                                   \
    ENTRY(PFNGLGETUNIFORMLOCATIONPROC, GetUniformLocation)                                                   \
    ENTRY(PFNGLPROGRAMUNIFORM1IPROC, ProgramUniform1i)                                                       \
    ENTRY(PFNGLPROGRAMUNIFORM1FPROC, ProgramUniform1f)                                                       \
    ENTRY(PFNGLPROGRAMUNIFORM2FPROC, ProgramUniform2f)                                                       \
    ENTRY(PFNGLPROGRAMUNIFORM2IPROC, ProgramUniform2i)                                                       \
    ENTRY(PFNGLPROGRAMUNIFORM3FPROC, ProgramUniform3f)                                                       \
    ENTRY(PFNGLPROGRAMUNIFORM4FPROC, ProgramUniform4f)                                                       \
    ENTRY(PFNGLPROGRAMUNIFORM1FVPROC, ProgramUniform1fv)                                                     \
    ENTRY(PFNGLPROGRAMUNIFORM3FVPROC, ProgramUniform3fv)                                                     \
    ENTRY(PFNGLPROGRAMUNIFORM4FVPROC, ProgramUniform4fv)                                                     \
    ENTRY(PFNGLPROGRAMUNIFORMMATRIX4FVPROC, ProgramUniformMatrix4fv)                                         \
    /* Queries, fences and debug output */                                                                   \
    ENTRY(PFNGLCREATEQUERIESPROC, CreateQueries)                                                             \
    ENTRY(PFNGLDELETEQUERIESPROC, DeleteQueries)                                                             \
    ENTRY(PFNGLBEGINQUERYPROC, BeginQuery)                                                                   \
    ENTRY(PFNGLENDQUERYPROC, EndQuery)                                                                       \
    ENTRY(PFNGLGETQUERYIVPROC, GetQueryiv)                                                                   \
    ENTRY(PFNGLQUERYCOUNTERPROC, QueryCounter)                                                               \
    ENTRY(PFNGLGETQUERYOBJECTIVPROC, GetQueryObjectiv)                                                       \
    ENTRY(PFNGLGETQUERYOBJECTUI64VPROC, GetQueryObjectui64v)                                                 \
    ENTRY(PFNGLFENCESYNCPROC, FenceSync)                                                                     \
    ENTRY(PFNGLDELETESYNCPROC, DeleteSync)                                                                   \
    ENTRY(PFNGLCLIENTWAITSYNCPROC, ClientWaitSync)                                                           \
    ENTRY(PFNGLWAITSYNCPROC, WaitSync)                                                                       \
    ENTRY(PFNGLDEBUGMESSAGECALLBACKPROC, DebugMessageCallback)
// clang-format on

/// A plain value: copies call the same context; tests replace entries by fakes that count.
/// Objects made with a table keep a pointer to it, so it outlives them.
struct Gl {
    /// Loads every entry point. @throws Error naming the first one that is missing
    explicit Gl(const GlLoader& load, DrawnBy drawn_by = DrawnBy::automatic);

#define ISOCHRON_GL_MEMBER(type, name) type name = nullptr;
    ISOCHRON_GL_ENTRY_POINTS(ISOCHRON_GL_MEMBER)
#undef ISOCHRON_GL_MEMBER

    /// Whether passes draw as suits a GPU or a processor, see `is_drawn_for_processor`.
    DrawnBy drawn_by;
    /// Programs are linked when their pass is made, not when they are first used: for who wants them all.
    bool links_at_once = false;
};

} // namespace isochron::render
