// A context without any window system: EGL on a GPU, or on Mesa's surfaceless platform.
#include "stereo/context/gl_context_backends.h"
#include "stereo/context/shared_library.h"

#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <algorithm>
#include <memory>
#include <string_view>
#include <vector>

namespace isochron::stereo {
namespace {

bool lists(const char* extensions, std::string_view wanted) {
    std::string_view rest = extensions ? extensions : "";
    while (!rest.empty()) {
        const std::string_view word = rest.substr(0, rest.find(' '));
        if (word == wanted)
            return true;
        rest.remove_prefix(std::min(rest.size(), word.size() + 1));
    }
    return false;
}

/// libEGL and its display, one object per process that all contexts share: the display of the first
/// GPU that can be used, else Mesa's surfaceless one, which also draws in software.
class EglDisplay {
  public:
    decltype(&eglMakeCurrent) make_current;
    decltype(&eglCreateContext) create_context;
    decltype(&eglDestroyContext) destroy_context;
    decltype(&eglGetProcAddress) proc_address;
    decltype(&eglGetError) error;
    decltype(&eglGetCurrentContext) current_context;
    decltype(&eglBindAPI) bind_api;

    static std::shared_ptr<EglDisplay> shared() {
        static std::weak_ptr<EglDisplay> opened;
        std::shared_ptr<EglDisplay> display = opened.lock();
        if (!display)
            opened = display = std::make_shared<EglDisplay>();
        return display;
    }

    EglDisplay() {
        library_.get(make_current, "eglMakeCurrent");
        library_.get(create_context, "eglCreateContext");
        library_.get(destroy_context, "eglDestroyContext");
        library_.get(proc_address, "eglGetProcAddress");
        library_.get(error, "eglGetError");
        library_.get(current_context, "eglGetCurrentContext");
        library_.get(bind_api, "eglBindAPI");
        library_.get(terminate_, "eglTerminate");
        library_.get(query_, "eglQueryString");
        library_.get(initialize_, "eglInitialize");
        library_.get(get_platform_display_, "eglGetPlatformDisplay");

        for (EGLDeviceEXT gpu : gpus())
            if (opens(get_platform_display_(EGL_PLATFORM_DEVICE_EXT, gpu, nullptr)))
                return;
        if (!lists(query_(EGL_NO_DISPLAY, EGL_EXTENSIONS), "EGL_MESA_platform_surfaceless"))
            throw render::Error(
                "libEGL opens no GPU without a window and has no EGL_MESA_platform_surfaceless");
        if (!opens(
                get_platform_display_(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr)))
            throw render::Error("the surfaceless display does not open, or not without a "
                                "configuration and a surface (EGL error {:#x})",
                                error());
    }
    ~EglDisplay() { terminate_(display_); }
    EglDisplay(const EglDisplay&) = delete;
    EglDisplay& operator=(const EglDisplay&) = delete;

    EGLDisplay handle() const { return display_; }

  private:
    /// Devices that are not software renderers; empty if EGL cannot tell.
    std::vector<EGLDeviceEXT> gpus() const {
        const auto query_devices =
            reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(proc_address("eglQueryDevicesEXT"));
        const auto query_device = reinterpret_cast<PFNEGLQUERYDEVICESTRINGEXTPROC>(
            proc_address("eglQueryDeviceStringEXT"));
        constexpr EGLint kMost = 32;
        EGLDeviceEXT devices[kMost];
        EGLint count = 0;
        if (!lists(query_(EGL_NO_DISPLAY, EGL_EXTENSIONS), "EGL_EXT_platform_device") ||
            !query_devices || !query_device || !query_devices(kMost, devices, &count))
            return {};
        std::vector<EGLDeviceEXT> found(devices, devices + count);
        std::erase_if(found, [&](EGLDeviceEXT device) {
            return lists(query_device(device, EGL_EXTENSIONS), "EGL_MESA_device_software");
        });
        return found;
    }

    /// Tries a display, and keeps it if it has what we need.
    bool opens(EGLDisplay display) {
        if (display == EGL_NO_DISPLAY || !initialize_(display, nullptr, nullptr))
            return false;
        const char* extensions = query_(display, EGL_EXTENSIONS);
        if (!lists(extensions, "EGL_KHR_no_config_context") ||
            !lists(extensions, "EGL_KHR_surfaceless_context")) {
            terminate_(display);
            return false;
        }
        display_ = display;
        return true;
    }

    SharedLibrary library_{"libEGL.so.1"};
    decltype(&eglTerminate) terminate_;
    decltype(&eglQueryString) query_;
    decltype(&eglInitialize) initialize_;
    decltype(&eglGetPlatformDisplay) get_platform_display_;
    EGLDisplay display_ = EGL_NO_DISPLAY;
};

class EglContext final : public OffscreenContext {
  public:
    explicit EglContext(const ContextOptions& options)
        : OffscreenContext(options.size), egl_(EglDisplay::shared()) {
        egl_->bind_api(EGL_OPENGL_API);
        // Not every driver reports resets of the GPU.
        for (const EGLint told : {EGL_LOSE_CONTEXT_ON_RESET, EGL_NO_RESET_NOTIFICATION}) {
            const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                         4,
                                         EGL_CONTEXT_MINOR_VERSION,
                                         5,
                                         EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                         EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                         EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY,
                                         told,
                                         EGL_NONE};
            context_ =
                egl_->create_context(egl_->handle(), EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
            if (context_ != EGL_NO_CONTEXT)
                break;
        }
        if (context_ == EGL_NO_CONTEXT)
            throw render::Error("EGL does not provide OpenGL 4.5 core (EGL error {:#x})",
                                egl_->error());
        try {
            make_current();
        } catch (...) {
            egl_->destroy_context(egl_->handle(), context_);
            throw;
        }
    }
    ~EglContext() override {
        if (egl_->current_context() == context_)
            release();
        egl_->destroy_context(egl_->handle(), context_);
    }
    EglContext(const EglContext&) = delete;
    EglContext& operator=(const EglContext&) = delete;

    void make_current() override {
        // EGL does not notice that OSMesa was made current on this thread, and would do nothing.
        if (egl_->current_context() == context_)
            release();
        if (!egl_->make_current(egl_->handle(), EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
            throw render::Error("eglMakeCurrent failed (EGL error {:#x})", egl_->error());
    }
    void leave() override { release(); }
    render::GlLoader loader() const override {
        return [get = egl_->proc_address](const char* name) {
            return reinterpret_cast<void*>(get(name));
        };
    }
    NativeGl native() const override {
        return EglHandles{egl_->handle(), nullptr, context_, egl_->proc_address};
    }
    std::string description() const override { return "EGL, " + describe_current(loader()); }

  private:
    void release() {
        egl_->make_current(egl_->handle(), EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }

    std::shared_ptr<EglDisplay> egl_;
    EGLContext context_ = EGL_NO_CONTEXT;
};

} // namespace

std::unique_ptr<GlContext> make_egl_context(const ContextOptions& options) {
    return std::make_unique<EglContext>(options);
}

} // namespace isochron::stereo
