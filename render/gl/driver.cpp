// Properties of the driver, from what it tells.
#include "render/gl/driver.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>
#include <string_view>

namespace isochron::render {

bool draws_in_software(const Gl& gl) {
    constexpr std::array<std::string_view, 4> kSoftware{"llvmpipe", "softpipe", "swr",
                                                        "SwiftShader"};
    const auto* text = reinterpret_cast<const char*>(gl.GetString(GL_RENDERER));
    const std::string_view renderer = text ? text : "";
    return std::ranges::any_of(kSoftware, [&](std::string_view name) {
        return renderer.find(name) != std::string_view::npos;
    });
}

bool is_drawn_for_processor(const Gl& gl) {
    if (gl.drawn_by != DrawnBy::automatic)
        return gl.drawn_by == DrawnBy::processor;
    const char* text = std::getenv("ISOCHRON_DRAWN_BY");
    const std::string_view wanted = text ? text : "";
    if (wanted == "gpu" || wanted == "processor")
        return wanted == "processor";
    return draws_in_software(gl);
}

void expect_context(const Gl& gl) {
    const auto lost = [&](const char* why) {
        return Error(std::string("the GL context is lost: ") + why +
                     "; what was recorded is kept, start again to go on");
    };
    switch (gl.GetGraphicsResetStatus()) {
    case GL_NO_ERROR: return;
    case GL_GUILTY_CONTEXT_RESET: throw lost("the GPU was reset because of what this program drew");
    case GL_INNOCENT_CONTEXT_RESET: throw lost("another program made the GPU reset");
    default: throw lost("the GPU was reset");
    }
}

int max_samples(const Gl& gl) {
    GLint most = 1;
    gl.GetIntegerv(GL_MAX_SAMPLES, &most);
    return std::max(most, 1);
}

} // namespace isochron::render
