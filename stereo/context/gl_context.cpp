// Chooses a context by name, and makes the checks that every kind of context must pass.
#include "stereo/context/gl_context.h"

#include "stereo/context/gl_context_backends.h"
#include "stereo/context/raster_memory.h"
#include "stereo/context/raster_threads.h"

#include <fmt/format.h>

#include <array>

namespace isochron::stereo {
namespace {

struct KindRow {
    ContextKind kind;
    std::string_view name;
    std::unique_ptr<GlContext> (*make)(const ContextOptions&);
};
constexpr std::array kKinds{
    KindRow{ContextKind::glfw, "glfw", make_glfw_context},
    KindRow{ContextKind::egl, "egl", make_egl_context},
    KindRow{ContextKind::osmesa, "osmesa", make_osmesa_context},
};

std::string other_kinds(ContextKind kind) {
    std::string names;
    for (const KindRow& row : kKinds)
        if (row.kind != kind)
            names += (names.empty() ? "" : ", ") + std::string(row.name);
    return names;
}

template <typename Function>
Function entry_point(const render::GlLoader& loader, const char* name) {
    void* address = loader(name);
    if (!address)
        throw render::Error("the context has no {}", name);
    return reinterpret_cast<Function>(address);
}

/// A picture with its own size that is drawn in another context.
class BesideContext final : public OffscreenContext {
  public:
    BesideContext(GlContext& drawing, glm::ivec2 size)
        : OffscreenContext(size), drawing_(drawing) {}
    void make_current() override { drawing_.make_current(); }
    render::GlLoader loader() const override { return drawing_.loader(); }
    std::string description() const override { return drawing_.description(); }

  private:
    GlContext& drawing_;
};

void require_gl_4_5_core(const render::GlLoader& loader) {
    const auto get_integer = entry_point<PFNGLGETINTEGERVPROC>(loader, "glGetIntegerv");
    GLint major = 0, minor = 0, profile = 0;
    get_integer(GL_MAJOR_VERSION, &major);
    get_integer(GL_MINOR_VERSION, &minor);
    get_integer(GL_CONTEXT_PROFILE_MASK, &profile);
    if (major * 10 + minor < 45 || !(profile & GL_CONTEXT_CORE_PROFILE_BIT))
        throw render::Error("OpenGL 4.5 core is needed, got {}.{}{}", major, minor,
                            profile & GL_CONTEXT_CORE_PROFILE_BIT ? " core" : "");
}

} // namespace

std::string_view name_of(ContextKind kind) {
    for (const KindRow& row : kKinds)
        if (row.kind == kind)
            return row.name;
    return "?";
}

std::optional<ContextKind> context_kind_from_name(std::string_view name) {
    for (const KindRow& row : kKinds)
        if (row.name == name)
            return row.kind;
    return std::nullopt;
}

std::unique_ptr<GlContext> make_context(ContextKind kind, const ContextOptions& options) {
    for (const KindRow& row : kKinds)
        if (row.kind == kind) {
            try {
                if (options.size.x <= 0 || options.size.y <= 0)
                    throw render::Error("size {}x{} is not positive", options.size.x,
                                        options.size.y);
                auto context = row.make(options);
                require_gl_4_5_core(context->loader());
                if (describe_current(context->loader()).find("llvmpipe") != std::string::npos) {
                    spread_raster_threads();
                    keep_raster_memory();
                }
                return context;
            } catch (const NoDisplay&) {
                throw;
            } catch (const render::Error& error) {
                throw render::Error("context {}: {}; other contexts: {}", row.name, error.what(),
                                    other_kinds(kind));
            }
        }
    throw render::Error("context of an unknown kind");
}

void GlContext::wait(const Wake& wake, interaction::Seconds longest) {
    wake.wait(-1, longest);
    wake.take();
}

std::unique_ptr<GlContext> offscreen_beside(GlContext& drawing, glm::ivec2 size) {
    return std::make_unique<BesideContext>(drawing, size);
}

std::string describe_current(const render::GlLoader& loader) {
    const auto get_string = entry_point<PFNGLGETSTRINGPROC>(loader, "glGetString");
    const auto text = [&](GLenum name) {
        const GLubyte* value = get_string(name);
        return std::string(value ? reinterpret_cast<const char*>(value) : "?");
    };
    const std::string version = text(GL_VERSION);
    return fmt::format("OpenGL {}, {}", version.substr(0, version.find(' ')), text(GL_RENDERER));
}

} // namespace isochron::stereo
