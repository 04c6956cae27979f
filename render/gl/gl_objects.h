// Owners of GL objects: each deletes its object when destroyed; it can be moved but not copied.
#pragma once

#include "render/gl/gl_memory.h"

#include <string>
#include <utility>

namespace isochron::render {

/// How objects of a kind are made and deleted: one at a time, or as many as are asked for.
template <class Create, class Delete>
struct GlKind {
    const char* name;
    Create Gl::* create;
    Delete Gl::* destroy;
};
inline constexpr GlKind kBufferKind{"buffer", &Gl::CreateBuffers, &Gl::DeleteBuffers};
inline constexpr GlKind kVertexArrayKind{"vertex array", &Gl::CreateVertexArrays,
                                         &Gl::DeleteVertexArrays};
inline constexpr GlKind kTextureKind{"texture", &Gl::CreateTextures, &Gl::DeleteTextures};
inline constexpr GlKind kFramebufferKind{"framebuffer", &Gl::CreateFramebuffers,
                                         &Gl::DeleteFramebuffers};
inline constexpr GlKind kRenderbufferKind{"renderbuffer", &Gl::CreateRenderbuffers,
                                          &Gl::DeleteRenderbuffers};
inline constexpr GlKind kShaderKind{"shader", &Gl::CreateShader, &Gl::DeleteShader};
inline constexpr GlKind kProgramKind{"shader program", &Gl::CreateProgram, &Gl::DeleteProgram};
inline constexpr GlKind kQueryKind{"query", &Gl::CreateQueries, &Gl::DeleteQueries};

/// Owns one GL object of the table's context, which must be current when the owner is constructed
/// and destroyed. A moved-from owner holds name 0.
/// @throws OutOfMemory when the GL makes no object
template <const auto& kKind>
class GlObject {
  public:
    template <class... Arguments>
    explicit GlObject(const Gl& gl, Arguments... arguments) : gl_(&gl) {
        if constexpr (requires { (gl.*kKind.create)(arguments..., 1, &name_); })
            (gl.*kKind.create)(arguments..., 1, &name_);
        else
            name_ = (gl.*kKind.create)(arguments...);
        if (name_ == 0)
            throw OutOfMemory(std::string(kKind.name) + ": this GL cannot make one more");
    }
    GlObject(GlObject&& other) noexcept : gl_(other.gl_), name_(std::exchange(other.name_, 0)) {}
    GlObject& operator=(GlObject&& other) noexcept {
        std::swap(gl_, other.gl_);
        std::swap(name_, other.name_);
        return *this;
    }
    ~GlObject() {
        if (name_ == 0)
            return;
        if constexpr (requires { (gl_->*kKind.destroy)(1, &name_); })
            (gl_->*kKind.destroy)(1, &name_);
        else
            (gl_->*kKind.destroy)(name_);
    }

    GLuint name() const { return name_; }
    const Gl& gl() const { return *gl_; }

  private:
    const Gl* gl_;
    GLuint name_ = 0;
};

using Buffer = GlObject<kBufferKind>;
using VertexArray = GlObject<kVertexArrayKind>;
using Texture = GlObject<kTextureKind>; ///< `Texture(gl, GL_TEXTURE_2D)`
using Framebuffer = GlObject<kFramebufferKind>;
using Renderbuffer = GlObject<kRenderbufferKind>;
using Shader = GlObject<kShaderKind>; ///< `Shader(gl, GL_VERTEX_SHADER)`
using Program = GlObject<kProgramKind>;
using Query = GlObject<kQueryKind>; ///< `Query(gl, GL_TIMESTAMP)`

} // namespace isochron::render
