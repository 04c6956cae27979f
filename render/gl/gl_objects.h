// Owners of GL objects: each deletes its object when destroyed; it can be moved but not copied.
#pragma once

#include "render/gl/gl_memory.h"

#include <string>
#include <utility>

namespace isochron::render {

struct BufferKind {
    static constexpr const char* kName = "buffer";
    static GLuint create(const Gl& gl);
    static void destroy(const Gl& gl, GLuint name);
};
struct VertexArrayKind {
    static constexpr const char* kName = "vertex array";
    static GLuint create(const Gl& gl);
    static void destroy(const Gl& gl, GLuint name);
};
struct TextureKind {
    static constexpr const char* kName = "texture";
    static GLuint create(const Gl& gl, GLenum target);
    static void destroy(const Gl& gl, GLuint name);
};
struct FramebufferKind {
    static constexpr const char* kName = "framebuffer";
    static GLuint create(const Gl& gl);
    static void destroy(const Gl& gl, GLuint name);
};
struct RenderbufferKind {
    static constexpr const char* kName = "renderbuffer";
    static GLuint create(const Gl& gl);
    static void destroy(const Gl& gl, GLuint name);
};
struct ProgramKind {
    static constexpr const char* kName = "shader program";
    static GLuint create(const Gl& gl);
    static void destroy(const Gl& gl, GLuint name);
};
struct QueryKind {
    static constexpr const char* kName = "query";
    static GLuint create(const Gl& gl, GLenum target);
    static void destroy(const Gl& gl, GLuint name);
};

/// Owns one GL object of the table's context, which must be current when the owner is constructed
/// and destroyed. A moved-from owner holds name 0.
/// @throws OutOfMemory when the GL makes no object
template <class Kind>
class GlObject {
  public:
    template <class... Arguments>
    explicit GlObject(const Gl& gl, Arguments... arguments)
        : gl_(&gl), name_(Kind::create(gl, arguments...)) {
        if (name_ == 0)
            throw OutOfMemory(std::string(Kind::kName) + ": this GL cannot make one more");
    }
    GlObject(GlObject&& other) noexcept : gl_(other.gl_), name_(std::exchange(other.name_, 0)) {}
    GlObject& operator=(GlObject&& other) noexcept {
        std::swap(gl_, other.gl_);
        std::swap(name_, other.name_);
        return *this;
    }
    ~GlObject() {
        if (name_ != 0)
            Kind::destroy(*gl_, name_);
    }

    GLuint name() const { return name_; }
    const Gl& gl() const { return *gl_; }

  private:
    const Gl* gl_;
    GLuint name_;
};

using Buffer = GlObject<BufferKind>;
using VertexArray = GlObject<VertexArrayKind>;
using Texture = GlObject<TextureKind>; ///< `Texture(gl, GL_TEXTURE_2D)`
using Framebuffer = GlObject<FramebufferKind>;
using Renderbuffer = GlObject<RenderbufferKind>;
using Program = GlObject<ProgramKind>;
using Query = GlObject<QueryKind>; ///< `Query(gl, GL_TIMESTAMP)`

} // namespace isochron::render
