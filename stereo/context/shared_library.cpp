// Loads system libraries and their symbols.
#include "stereo/context/shared_library.h"

#include "render/gl/gl.h"

#include <dlfcn.h>

namespace isochron::stereo {

SharedLibrary::SharedLibrary(const std::string& file)
    : file_(file), handle_(dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL)) {
    if (!handle_)
        throw render::Error(dlerror());
}

void* SharedLibrary::symbol(const char* name) const {
    if (void* address = dlsym(handle_, name))
        return address;
    throw render::Error("{} has no {}", file_, name);
}

} // namespace isochron::stereo
