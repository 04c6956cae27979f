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

[[noreturn]] void end(const char* why) {
    const char* display = std::getenv("DISPLAY"); // nobody sets it
    fmt::print(stderr, "isochron: the X server {} {}\n", display ? display : "", why);
    if (const auto save = std::exchange(what_saves(), {}))
        save();
    std::fflush(nullptr);
    _exit(EXIT_FAILURE); // exit handlers of the driver would talk to the server
}

// Xlib's handlers, which must not return. Xlib's types stay out of here: nothing of them is used.

int end_without_display(void*) {
    end("is gone");
}

/// Zink tells a lost server in this way. Xlib's own handler would end the program, too, without
/// saving anything.
int end_by_error(void*, void*) {
    end("is gone, or has refused a request");
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
    using ErrorHandler = int (*)(void*, void*);
    void* library = dlopen("libX11.so.6", RTLD_LAZY | RTLD_NOLOAD);
    if (!library) // another window system
        return;
    if (auto* set = reinterpret_cast<Handler (*)(Handler)>(dlsym(library, "XSetIOErrorHandler")))
        set(end_without_display);
    if (auto* set =
            reinterpret_cast<ErrorHandler (*)(ErrorHandler)>(dlsym(library, "XSetErrorHandler")))
        set(end_by_error);
}

} // namespace isochron::stereo
