// A context in plain memory: Mesa's off-screen interface, without any window system or device.
#include "stereo/context/gl_context_backends.h"
#include "stereo/context/shared_library.h"

// Only types and values of this header are used; its functions are loaded at run time.
#include <GL/osmesa.h>

#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

namespace isochron::stereo {
namespace {

struct OsMesa {
    SharedLibrary library{"libOSMesa.so.8"};
    decltype(&OSMesaCreateContextAttribs) create_context;
    decltype(&OSMesaMakeCurrent) make_current;
    decltype(&OSMesaGetCurrentContext) current_context;
    decltype(&OSMesaDestroyContext) destroy_context;
    decltype(&OSMesaGetProcAddress) proc_address;

    OsMesa() {
        library.get(create_context, "OSMesaCreateContextAttribs");
        library.get(make_current, "OSMesaMakeCurrent");
        library.get(current_context, "OSMesaGetCurrentContext");
        library.get(destroy_context, "OSMesaDestroyContext");
        library.get(proc_address, "OSMesaGetProcAddress");
    }
};

/// Hides the environment's choice of a Mesa driver: OSMesa draws on the processor, and crashes if
/// the environment asks for another driver (22.3 with GALLIUM_DRIVER=zink).
class WithoutDriverOfChoice {
  public:
    WithoutDriverOfChoice() {
        if (const char* driver = std::getenv(kVariable)) {
            driver_ = driver;
            unsetenv(kVariable);
        }
    }
    ~WithoutDriverOfChoice() {
        if (driver_)
            setenv(kVariable, driver_->c_str(), 1);
    }
    WithoutDriverOfChoice(const WithoutDriverOfChoice&) = delete;
    WithoutDriverOfChoice& operator=(const WithoutDriverOfChoice&) = delete;

  private:
    static constexpr const char* kVariable = "GALLIUM_DRIVER";
    std::optional<std::string> driver_;
};

class OsMesaContext final : public OffscreenContext {
  public:
    explicit OsMesaContext(const ContextOptions& options) : OffscreenContext(options.size) {
        const int attributes[] = {OSMESA_FORMAT,
                                  OSMESA_RGBA,
                                  OSMESA_PROFILE,
                                  OSMESA_CORE_PROFILE,
                                  OSMESA_CONTEXT_MAJOR_VERSION,
                                  4,
                                  OSMESA_CONTEXT_MINOR_VERSION,
                                  5,
                                  0};
        {
            const WithoutDriverOfChoice processor;
            context_ = osmesa_.create_context(attributes, nullptr);
        }
        if (!context_)
            throw render::Error("libOSMesa does not provide OpenGL 4.5 core");
        try {
            make_current();
        } catch (...) {
            osmesa_.destroy_context(context_);
            throw;
        }
    }
    ~OsMesaContext() override {
        if (osmesa_.current_context() == context_)
            osmesa_.make_current(nullptr, nullptr, 0, 0, 0);
        osmesa_.destroy_context(context_);
    }
    OsMesaContext(const OsMesaContext&) = delete;
    OsMesaContext& operator=(const OsMesaContext&) = delete;

    void make_current() override {
        if (!osmesa_.make_current(context_, pixel_.data(), GL_UNSIGNED_BYTE, 1, 1))
            throw render::Error("OSMesaMakeCurrent failed");
    }
    render::GlLoader loader() const override {
        return [get = osmesa_.proc_address](const char* name) {
            return reinterpret_cast<void*>(get(name));
        };
    }
    std::string description() const override { return "OSMesa, " + describe_current(loader()); }

  private:
    OsMesa osmesa_;
    OSMesaContext context_ = nullptr;
    /// The default framebuffer, which OSMesa requires; nothing draws to it.
    std::vector<unsigned char> pixel_ = std::vector<unsigned char>(4);
};

} // namespace

std::unique_ptr<GlContext> make_osmesa_context(const ContextOptions& options) {
    return std::make_unique<OsMesaContext>(options);
}

} // namespace isochron::stereo
