// Asks the GL whether its memory sufficed.
#include "render/gl/gl_memory.h"

namespace isochron::render {

void expect_memory(const Gl& gl, std::string_view what) {
    bool short_of_memory = false;
    // A lost context may report its error forever.
    for (int i = 0; i < 8; ++i) {
        const GLenum error = gl.GetError();
        if (error == GL_NO_ERROR)
            break;
        short_of_memory = short_of_memory || error == GL_OUT_OF_MEMORY;
    }
    if (short_of_memory)
        throw OutOfMemory("{}: this GL has no memory left for that", what);
}

} // namespace isochron::render
