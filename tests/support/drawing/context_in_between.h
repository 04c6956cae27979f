// A context in which tests can replace the driver's functions.
#pragma once

#include "stereo/context/gl_context.h"

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace isochron::stereo {

/// Stores the driver's function in `actual` and returns ours.
template <class Function>
void* before(void* found, Function& actual, Function ours) {
    actual = reinterpret_cast<Function>(found);
    return reinterpret_cast<void*>(ours);
}

/// Like the context itself, apart from replaced entry points, and without a window.
class ContextInBetween : public GlContext {
  public:
    /// From the name and the driver's function, returns the function that the program calls.
    using Replace = std::function<void*(std::string_view name, void* found)>;
    ContextInBetween(ContextKind kind, glm::ivec2 size, Replace replace)
        : context_(make_context(kind, {.size = size})), replace_(std::move(replace)) {}

    void make_current() override { context_->make_current(); }
    render::GlLoader loader() const override {
        return [load = context_->loader(), replace = replace_](const char* name) {
            return replace(name, load(name));
        };
    }
    glm::ivec2 framebuffer_size() const override { return context_->framebuffer_size(); }
    bool has_window() const override { return false; }
    void present() override {}
    bool should_close() const override { return false; }
    std::vector<interaction::WindowEvent> poll_events() override { return {}; }
    std::string description() const override { return context_->description(); }

  private:
    std::unique_ptr<GlContext> context_;
    Replace replace_;
};

} // namespace isochron::stereo
