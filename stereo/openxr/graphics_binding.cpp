// Graphics bindings of EGL and GLX.
#include "stereo/openxr/graphics_binding.h"

// Included after its own header, but before headers that conflict with Xlib's macros.
#include "stereo/openxr/openxr_platform.h"

#include "stereo/openxr/openxr_error.h"
#include "stereo/openxr/openxr_instance.h"

#include <fmt/format.h>

namespace isochron::stereo {
namespace {

constexpr XrVersion kOurs = XR_MAKE_VERSION(4, 5, 0);

void check_requirements(const OpenXrInstance& instance) {
    if (!instance.has(XR_KHR_OPENGL_ENABLE_EXTENSION_NAME))
        return; // a runtime with only XR_MNDX_egl_enable cannot be asked
    XrGraphicsRequirementsOpenGLKHR wanted{XR_TYPE_GRAPHICS_REQUIREMENTS_OPENGL_KHR};
    const auto ask = instance.function<PFN_xrGetOpenGLGraphicsRequirementsKHR>(
        "xrGetOpenGLGraphicsRequirementsKHR");
    check(ask(instance.handle(), instance.headset(), &wanted),
          "xrGetOpenGLGraphicsRequirementsKHR");
    if (wanted.minApiVersionSupported > kOurs)
        throw OpenXrError(XR_ERROR_GRAPHICS_DEVICE_INVALID,
                          fmt::format("OpenXR: the runtime wants OpenGL {}.{} or later, got 4.5",
                                      XR_VERSION_MAJOR(wanted.minApiVersionSupported),
                                      XR_VERSION_MINOR(wanted.minApiVersionSupported)));
}

XrGraphicsBindingEGLMNDX structure_of(const EglHandles& egl) {
    XrGraphicsBindingEGLMNDX structure{XR_TYPE_GRAPHICS_BINDING_EGL_MNDX};
    structure.getProcAddress = egl.get_proc_address;
    structure.display = egl.display;
    structure.config = egl.config;
    structure.context = egl.context;
    return structure;
}

XrGraphicsBindingOpenGLXlibKHR structure_of(const GlxHandles& glx) {
    XrGraphicsBindingOpenGLXlibKHR structure{XR_TYPE_GRAPHICS_BINDING_OPENGL_XLIB_KHR};
    structure.xDisplay = static_cast<Display*>(glx.display);
    structure.visualid = glx.visual_id;
    structure.glxFBConfig = static_cast<GLXFBConfig>(glx.fb_config);
    structure.glxDrawable = glx.drawable;
    structure.glxContext = static_cast<GLXContext>(glx.context);
    return structure;
}

} // namespace

struct OpenXrGraphics::Structure {
    XrGraphicsBindingEGLMNDX egl{};
    XrGraphicsBindingOpenGLXlibKHR glx{};
    const void* next = nullptr;
};

OpenXrGraphics::OpenXrGraphics(const OpenXrInstance& instance, const NativeGl& context)
    : structure_(std::make_unique<Structure>()) {
    check_requirements(instance);
    const bool by_egl = instance.binding() == OpenXrBinding::egl;
    if (const auto* egl = std::get_if<EglHandles>(&context); egl && by_egl) {
        structure_->egl = structure_of(*egl);
        structure_->next = &structure_->egl;
    } else if (const auto* glx = std::get_if<GlxHandles>(&context); glx && !by_egl) {
        structure_->glx = structure_of(*glx);
        structure_->next = &structure_->glx;
    } else {
        throw OpenXrError(XR_ERROR_GRAPHICS_DEVICE_INVALID,
                          fmt::format("OpenXR: expected a context of {}, got one of {}",
                                      by_egl ? "EGL" : "GLX",
                                      egl   ? "EGL"
                                      : glx ? "GLX"
                                            : "neither EGL nor GLX"));
    }
}

OpenXrGraphics::~OpenXrGraphics() = default;

const void* OpenXrGraphics::next() const {
    return structure_->next;
}

} // namespace isochron::stereo
