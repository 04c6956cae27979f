// Swaps all windows of a cluster at once.
#include "stereo/context/swap_group.h"

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace isochron::stereo {
namespace {

// GLX's types, as its headers define them: with these, X11 and its headers are not needed.
using XDisplay = void*;
using GlxContext = void*;
using GlxDrawable = unsigned long;
constexpr int kGlxScreen = 0x800C;

constexpr std::string_view kExtension = "GLX_NV_swap_group";
constexpr GLuint kGroup = 1, kBarrier = 1;

[[noreturn]] void refuse(const std::string& why) {
    throw render::Error("cluster.swap_group: {}; without it the windows are swapped one after the "
                        "other, as soon as all processes have drawn",
                        why);
}

template <class Function>
Function* entry(const render::GlLoader& load, const char* name) {
    auto* found = reinterpret_cast<Function*>(load(name));
    if (!found)
        refuse(fmt::format("there is no {}: expected a window of GLX, with NVIDIA's driver", name));
    return found;
}

/// Whether a list contains a word as a whole.
bool contains(std::string_view list, std::string_view word) {
    for (std::size_t at = 0; (at = list.find(word, at)) != list.npos; at += word.size()) {
        const bool starts = at == 0 || list[at - 1] == ' ';
        const std::size_t end = at + word.size();
        if (starts && (end == list.size() || list[end] == ' '))
            return true;
    }
    return false;
}

} // namespace

void join_swap_group(const render::GlLoader& load) {
    const XDisplay display = entry<XDisplay()>(load, "glXGetCurrentDisplay")();
    const GlxContext context = entry<GlxContext()>(load, "glXGetCurrentContext")();
    const GlxDrawable window = entry<GlxDrawable()>(load, "glXGetCurrentDrawable")();
    if (!display || !context || !window)
        refuse("expected a window of GLX");
    int screen = 0;
    entry<int(XDisplay, GlxContext, int, int*)>(load, "glXQueryContext")(display, context,
                                                                         kGlxScreen, &screen);
    // Drivers return entry points even for extensions that they do not have.
    const char* extensions =
        entry<const char*(XDisplay, int)>(load, "glXQueryExtensionsString")(display, screen);
    if (!extensions || !contains(extensions, kExtension))
        refuse(fmt::format("the driver has no {}", kExtension));

    GLuint groups = 0, barriers = 0;
    entry<int(XDisplay, int, GLuint*, GLuint*)>(load, "glXQueryMaxSwapGroupsNV")(
        display, screen, &groups, &barriers);
    if (groups < kGroup || barriers < kBarrier)
        refuse(fmt::format("the driver offers {} swap groups and {} swap barriers, expected one of "
                           "each",
                           groups, barriers));
    if (!entry<int(XDisplay, GlxDrawable, GLuint)>(load, "glXJoinSwapGroupNV")(display, window,
                                                                               kGroup))
        refuse("the driver does not let the window join a swap group");
    if (!entry<int(XDisplay, GLuint, GLuint)>(load, "glXBindSwapBarrierNV")(display, kGroup,
                                                                            kBarrier))
        refuse("the driver does not bind the swap group to a swap barrier: is there a "
               "synchronization board?");
}

} // namespace isochron::stereo
