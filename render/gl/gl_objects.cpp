// Creation and deletion of each kind of GL object.
#include "render/gl/gl_objects.h"

namespace isochron::render {

GLuint BufferKind::create(const Gl& gl) {
    GLuint name = 0;
    gl.CreateBuffers(1, &name);
    return name;
}
void BufferKind::destroy(const Gl& gl, GLuint name) {
    gl.DeleteBuffers(1, &name);
}

GLuint VertexArrayKind::create(const Gl& gl) {
    GLuint name = 0;
    gl.CreateVertexArrays(1, &name);
    return name;
}
void VertexArrayKind::destroy(const Gl& gl, GLuint name) {
    gl.DeleteVertexArrays(1, &name);
}

GLuint TextureKind::create(const Gl& gl, GLenum target) {
    GLuint name = 0;
    gl.CreateTextures(target, 1, &name);
    return name;
}
void TextureKind::destroy(const Gl& gl, GLuint name) {
    gl.DeleteTextures(1, &name);
}

GLuint FramebufferKind::create(const Gl& gl) {
    GLuint name = 0;
    gl.CreateFramebuffers(1, &name);
    return name;
}
void FramebufferKind::destroy(const Gl& gl, GLuint name) {
    gl.DeleteFramebuffers(1, &name);
}

GLuint RenderbufferKind::create(const Gl& gl) {
    GLuint name = 0;
    gl.CreateRenderbuffers(1, &name);
    return name;
}
void RenderbufferKind::destroy(const Gl& gl, GLuint name) {
    gl.DeleteRenderbuffers(1, &name);
}

GLuint ProgramKind::create(const Gl& gl) {
    return gl.CreateProgram();
}
void ProgramKind::destroy(const Gl& gl, GLuint name) {
    gl.DeleteProgram(name);
}

GLuint QueryKind::create(const Gl& gl, GLenum target) {
    GLuint name = 0;
    gl.CreateQueries(target, 1, &name);
    return name;
}
void QueryKind::destroy(const Gl& gl, GLuint name) {
    gl.DeleteQueries(1, &name);
}

} // namespace isochron::render
