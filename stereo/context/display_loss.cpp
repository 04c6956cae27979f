// What happens when the X server is gone.
#include "stereo/context/display_loss.h"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <utility>

#include <dlfcn.h>
#include <unistd.h>

namespace isochron::stereo {
namespace {

std::function<void()>& what_saves() {
    static std::function<void()> save;
    return save;
}

/// Xlib's handler; it must not return. Its types stay out of here: nothing of them is used.
int end_without_display(void*) {
    const char* display = std::getenv("DISPLAY"); // NOLINT(concurrency-mt-unsafe): nobody sets it
    fmt::print(stderr, "isochron: the X server {} is gone\n", display ? display : "");
    if (const auto save = std::exchange(what_saves(), {}))
        save();
    std::fflush(nullptr);
    _exit(EXIT_FAILURE); // exit handlers of the driver would talk to the server
}

} // namespace

DisplayLoss::DisplayLoss(std::function<void()> save) {
    what_saves() = std::move(save);
}

DisplayLoss::~DisplayLoss() {
    what_saves() = {};
}

void watch_display() {
    using Handler = int (*)(void*);
    void* library = dlopen("libX11.so.6", RTLD_LAZY | RTLD_NOLOAD);
    if (!library) // another window system
        return;
    if (auto* set = reinterpret_cast<Handler (*)(Handler)>(dlsym(library, "XSetIOErrorHandler")))
        set(end_without_display);
}

} // namespace isochron::stereo
