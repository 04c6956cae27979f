// Loads the GL entry points.
#include "render/gl/gl.h"

namespace isochron::render {

namespace {

template <class Function>
void load_entry(const GlLoader& load, const char* name, Function& entry) {
    entry = reinterpret_cast<Function>(load(name));
    if (!entry)
        throw Error("{}: the GL context lacks this entry point, OpenGL 4.5 core is needed", name);
}

} // namespace

Gl::Gl(const GlLoader& load, DrawnBy by) : drawn_by(by) {
#define ISOCHRON_GL_LOAD(type, name) load_entry(load, "gl" #name, name);
    ISOCHRON_GL_ENTRY_POINTS(ISOCHRON_GL_LOAD)
#undef ISOCHRON_GL_LOAD
}

} // namespace isochron::render
