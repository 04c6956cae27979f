// A context with a window, by GLFW; translates GLFW's events.
#include "stereo/context/display_loss.h"
#include "stereo/context/gl_context_backends.h"
#include "stereo/context/gl_context_glfw_native.h"
#include "stereo/context/window_events.h"

#include "index/error.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <utility>

namespace isochron::stereo {
namespace {

using namespace interaction;

/// GLFW's last error message; static because GLFW's callback has no user pointer.
std::string& glfw_complaint() {
    static std::string text;
    return text;
}

[[noreturn]] void fail(const std::string& what) {
    throw render::Error(glfw_complaint().empty() ? what
                                                 : fmt::format("{}: {}", what, glfw_complaint()));
}

/// What a session of Wayland alone needs where GLFW knows X11 alone, as Debian 12's; else empty.
std::string way_to_wayland() {
    const auto is_set = [](const char* name) {
        const char* const value = std::getenv(name);
        return value && *value;
    };
    if (!is_set("WAYLAND_DISPLAY") || is_set("DISPLAY") ||
        std::strstr(glfwGetVersionString(), "Wayland"))
        return {};
    return "; this session is of Wayland alone: on Debian 12, `apt install libglfw3-wayland`";
}

/// The initialization of GLFW, which all windows share.
class GlfwLibrary {
  public:
    static std::shared_ptr<GlfwLibrary> shared() {
        std::shared_ptr<GlfwLibrary> library = opened().lock();
        if (!library)
            opened() = library = std::make_shared<GlfwLibrary>();
        return library;
    }
    /// Null while no window is open and nobody holds it.
    static std::weak_ptr<GlfwLibrary>& opened() {
        static std::weak_ptr<GlfwLibrary> library;
        return library;
    }
    GlfwLibrary() {
        glfw_complaint().clear();
        try { // the first call loads GLFW
            glfwSetErrorCallback([](int, const char* text) { glfw_complaint() = text; });
        } catch (const index::Error& error) {
            throw render::Error(error.what());
        }
        if (!glfwInit())
            throw NoDisplay("no display to open a window on, see DISPLAY ({}){}; `isochron replay` "
                            "draws pictures of a recording without one",
                            glfw_complaint(), way_to_wayland());
        watch_display();
    }
    ~GlfwLibrary() { glfwTerminate(); }
    GlfwLibrary(const GlfwLibrary&) = delete;
    GlfwLibrary& operator=(const GlfwLibrary&) = delete;
};

/// `Key` uses GLFW's numbers. Keys of the number pad become the keys that they repeat.
Key key_from_glfw(int key) {
    if (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_9)
        return static_cast<Key>('0' + key - GLFW_KEY_KP_0);
    switch (key) {
    case GLFW_KEY_KP_DECIMAL: return Key::period;
    case GLFW_KEY_KP_SUBTRACT: return Key::minus;
    case GLFW_KEY_KP_ADD: return Key::equal;
    case GLFW_KEY_KP_ENTER: return Key::enter;
    default: break;
    }
    const bool named = (key >= GLFW_KEY_SPACE && key <= GLFW_KEY_GRAVE_ACCENT) ||
                       (key >= GLFW_KEY_ESCAPE && key <= GLFW_KEY_END) ||
                       (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F12) ||
                       (key >= GLFW_KEY_LEFT_SHIFT && key <= GLFW_KEY_LEFT_ALT) ||
                       (key >= GLFW_KEY_RIGHT_SHIFT && key <= GLFW_KEY_RIGHT_ALT);
    return named ? static_cast<Key>(key) : Key::unknown;
}
static_assert(int(Key::escape) == GLFW_KEY_ESCAPE && int(Key::end) == GLFW_KEY_END &&
              int(Key::f1) == GLFW_KEY_F1 && int(Key::f12) == GLFW_KEY_F12 &&
              int(Key::left_shift) == GLFW_KEY_LEFT_SHIFT &&
              int(Key::left_alt) == GLFW_KEY_LEFT_ALT &&
              int(Key::right_shift) == GLFW_KEY_RIGHT_SHIFT &&
              int(Key::right_alt) == GLFW_KEY_RIGHT_ALT && int(Key::space) == GLFW_KEY_SPACE);

std::optional<MouseButton> button_from_glfw(int button) {
    switch (button) {
    case GLFW_MOUSE_BUTTON_LEFT: return MouseButton::left;
    case GLFW_MOUSE_BUTTON_RIGHT: return MouseButton::right;
    case GLFW_MOUSE_BUTTON_MIDDLE: return MouseButton::middle;
    default: return std::nullopt;
    }
}

std::uint8_t modifiers_from_glfw(int modifiers) {
    const auto bit = [modifiers](int glfw, Modifier modifier) {
        return (modifiers & glfw) != 0 ? static_cast<unsigned>(modifier) : 0u;
    };
    return static_cast<std::uint8_t>(bit(GLFW_MOD_CONTROL, Modifier::control) |
                                     bit(GLFW_MOD_ALT, Modifier::alt) |
                                     bit(GLFW_MOD_SUPER, Modifier::super));
}

GamepadEvent first_gamepad() {
    GamepadEvent event{};
    for (int joystick = GLFW_JOYSTICK_1; joystick <= GLFW_JOYSTICK_LAST; ++joystick) {
        GLFWgamepadstate state;
        if (!glfwJoystickIsGamepad(joystick) || !glfwGetGamepadState(joystick, &state))
            continue;
        event.present = true;
        std::copy(std::begin(state.axes), std::end(state.axes), event.axes);
        for (std::size_t i = 0; i < std::size(state.buttons); ++i)
            if (state.buttons[i] == GLFW_PRESS)
                event.buttons |= 1u << i;
        break;
    }
    return event;
}

bool same(const GamepadEvent& a, const GamepadEvent& b) {
    return a.present == b.present && a.buttons == b.buttons &&
           std::equal(std::begin(a.axes), std::end(a.axes), b.axes);
}

/// Whether the axes differ by no more than sticks tremble while nobody touches them.
bool about_the_same(const GamepadEvent& a, const GamepadEvent& b) {
    constexpr float kTremble = 0.05f;
    return a.present == b.present && a.buttons == b.buttons &&
           std::equal(std::begin(a.axes), std::end(a.axes), b.axes,
                      [](float one, float other) { return std::abs(one - other) <= kTremble; });
}

/// Counts what GLFW tells of any window; static as in `glfw_complaint`.
unsigned& glfw_events() {
    static unsigned count = 0;
    return count;
}

/// The place of a window before it covered its monitor, in screen units.
struct WindowedPlace {
    glm::ivec2 corner{100}, size{1280, 720};
};

class GlfwContext final : public GlContext {
  public:
    explicit GlfwContext(const ContextOptions& options) : library_(GlfwLibrary::shared()) {
        glfw_complaint().clear();
        glfwDefaultWindowHints();
        glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
        glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
        // Without robustness, which not every driver has, resets of the GPU are not reported.
        glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, GLFW_LOSE_CONTEXT_ON_RESET);
        glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
        // Pictures are composed in textures; the window itself needs only color.
        glfwWindowHint(GLFW_DEPTH_BITS, 0);
        glfwWindowHint(GLFW_STENCIL_BITS, 0);
        glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
        glfwWindowHint(GLFW_DECORATED, options.border ? GLFW_TRUE : GLFW_FALSE);
        glfwWindowHint(GLFW_STEREO, options.stereo_buffers ? GLFW_TRUE : GLFW_FALSE);
        GLFWmonitor* monitor = options.fullscreen ? monitor_of(options.monitor) : nullptr;
        glm::ivec2 size = options.size;
        if (monitor) {
            // Use the monitor's current mode: a switch could break genlock and layout.
            const GLFWvidmode* mode = glfwGetVideoMode(monitor);
            glfwWindowHint(GLFW_RED_BITS, mode->redBits);
            glfwWindowHint(GLFW_GREEN_BITS, mode->greenBits);
            glfwWindowHint(GLFW_BLUE_BITS, mode->blueBits);
            glfwWindowHint(GLFW_REFRESH_RATE, mode->refreshRate);
            size = {mode->width, mode->height};
        }
        if (!monitor && options.fits)
            size = fitting(size, options.scales);
        if (options.api == ContextApi::egl)
            glfwWindowHint(GLFW_CONTEXT_CREATION_API, GLFW_EGL_CONTEXT_API);
        auto* share = static_cast<GlfwContext*>(options.share);
        window_ = glfwCreateWindow(size.x, size.y, options.title.c_str(), monitor,
                                   share ? share->window_ : nullptr);
        if (!window_ && options.stereo_buffers)
            fail("no window with a left and a right buffer, which stereo mode quadbuffer needs; "
                 "--stereo chooses another mode, --emulate shows the installation in one window");
        if (!window_)
            fail("no window with an OpenGL 4.5 core context");
        glfwSetWindowUserPointer(window_, this);
        set_callbacks();
        if (!monitor && options.position != glm::ivec2(-1))
            glfwSetWindowPos(window_, options.position.x, options.position.y);
        if (options.visible)
            glfwShowWindow(window_);
        glfwMakeContextCurrent(window_);
        glfwSwapInterval(options.vsync ? 1 : 0);
        stereo_buffers_ = options.stereo_buffers;
        if (share)
            share->make_current();
    }
    ~GlfwContext() override { glfwDestroyWindow(window_); }
    GlfwContext(const GlfwContext&) = delete;
    GlfwContext& operator=(const GlfwContext&) = delete;

    void make_current() override { glfwMakeContextCurrent(window_); }
    void leave() override { glfwMakeContextCurrent(nullptr); }
    render::GlLoader loader() const override {
        return [](const char* name) { return reinterpret_cast<void*>(glfwGetProcAddress(name)); };
    }
    glm::ivec2 framebuffer_size() const override {
        glm::ivec2 size;
        glfwGetFramebufferSize(window_, &size.x, &size.y);
        return size;
    }
    bool has_window() const override { return true; }
    bool has_stereo_buffers() const override { return stereo_buffers_; }
    void present() override { glfwSwapBuffers(window_); }
    float content_scale() const override {
        float x = 1, y = 1;
        glfwGetWindowContentScale(window_, &x, &y);
        return std::clamp(std::min(x, y), 0.5f, 4.0f);
    }
    std::optional<double> refresh_rate() const override {
        GLFWmonitor* monitor = monitor_under_window();
        const GLFWvidmode* mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
        if (!mode || mode->refreshRate <= 0)
            return std::nullopt;
        return mode->refreshRate;
    }
    bool should_close() const override { return glfwWindowShouldClose(window_); }
    void keep_open() override { glfwSetWindowShouldClose(window_, GLFW_FALSE); }
    void toggle_fullscreen() override {
        if (glfwGetWindowMonitor(window_)) {
            glfwSetWindowMonitor(window_, nullptr, before_.corner.x, before_.corner.y,
                                 before_.size.x, before_.size.y, GLFW_DONT_CARE);
            return;
        }
        GLFWmonitor* monitor = monitor_under_window();
        const GLFWvidmode* mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
        if (!mode)
            return;
        glfwGetWindowPos(window_, &before_.corner.x, &before_.corner.y);
        glfwGetWindowSize(window_, &before_.size.x, &before_.size.y);
        glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
    }
    std::vector<WindowEvent> poll_events() override {
        glfwPollEvents();
        if (const GamepadEvent gamepad = first_gamepad(); !same(gamepad, gamepad_))
            events_.push_back(gamepad_ = gamepad);
        return std::exchange(events_, {});
    }
    void wait(const Wake& wake, Seconds longest) override {
        using Clock = std::chrono::steady_clock;
        constexpr Seconds kLook{1.0 / 30};
        constexpr Seconds kLookForNew{1}; // GLFW finds them only when it is asked for events
        const auto begun = Clock::now();
        const unsigned before = glfw_events();
        for (;;) {
            const GamepadEvent gamepad = first_gamepad();
            const Seconds left = longest - (Clock::now() - begun);
            if (!about_the_same(gamepad, gamepad_) || left <= Seconds(0))
                return;
            const Seconds look = gamepad.present ? kLook : kLookForNew;
            if (wait_for_window_events(wake, std::min(left, look)))
                return;
            glfwPollEvents();
            if (glfw_events() != before)
                return;
        }
    }
    bool take_damage() override { return std::exchange(damaged_, false); }
    void set_clipboard(const std::string& text) override {
        glfwSetClipboardString(window_, text.c_str());
    }
    std::vector<std::filesystem::path> take_dropped() override {
        return std::exchange(dropped_, {});
    }
    NativeGl native() const override { return native_of(window_); }
    std::string description() const override { return "GLFW, " + describe_current(loader()); }

  private:
    static GLFWmonitor* monitor_of(int index) {
        int count = 0;
        GLFWmonitor** monitors = glfwGetMonitors(&count);
        if (index < 0 || index >= count)
            throw render::Error("monitor {} does not exist, there {} {}", index,
                                count == 1 ? "is" : "are", count);
        return monitors[index];
    }

    static glm::ivec2 fitting(glm::ivec2 size, bool scales) {
        GLFWmonitor* monitor = glfwGetPrimaryMonitor();
        if (!monitor)
            return size;
        glm::vec2 scale(1.0f);
        glfwGetMonitorContentScale(monitor, &scale.x, &scale.y);
        glm::ivec2 corner, room;
        glfwGetMonitorWorkarea(monitor, &corner.x, &corner.y, &room.x, &room.y);
        return size_on_desktop(
            size, scales ? std::clamp(std::min(scale.x, scale.y), 0.5f, 4.0f) : 1.0f, room);
    }

    /// The monitor that shows the middle of the window, else the first one; null without any.
    GLFWmonitor* monitor_under_window() const {
        glm::ivec2 corner, size;
        glfwGetWindowPos(window_, &corner.x, &corner.y);
        glfwGetWindowSize(window_, &size.x, &size.y);
        const glm::ivec2 middle = corner + size / 2;
        int count = 0;
        GLFWmonitor** monitors = glfwGetMonitors(&count);
        for (int i = 0; i < count; ++i) {
            glm::ivec2 from, extent;
            glfwGetMonitorPos(monitors[i], &from.x, &from.y);
            const GLFWvidmode* mode = glfwGetVideoMode(monitors[i]);
            extent = mode ? glm::ivec2(mode->width, mode->height) : glm::ivec2(0);
            const glm::ivec2 at = middle - from;
            if (at.x >= 0 && at.y >= 0 && at.x < extent.x && at.y < extent.y)
                return monitors[i];
        }
        return glfwGetPrimaryMonitor();
    }

    static GlfwContext& context_of(GLFWwindow* window) {
        return *static_cast<GlfwContext*>(glfwGetWindowUserPointer(window));
    }
    static void push(GLFWwindow* window, const WindowEvent& event) {
        ++glfw_events();
        context_of(window).events_.push_back(event);
    }

    void set_callbacks() {
        glfwSetKeyCallback(window_, [](GLFWwindow* window, int glfw_key, int, int action,
                                       int modifiers) {
            const Key key = key_from_glfw(glfw_key);
            context_of(window).super_ = (modifiers & GLFW_MOD_SUPER) != 0;
            if (key != Key::unknown && action != GLFW_REPEAT)
                push(window, KeyEvent{key, action == GLFW_PRESS, modifiers_from_glfw(modifiers)});
        });
        // GLFW leaves out what is typed with Ctrl and Alt, but not what is typed with Super.
        glfwSetCharCallback(window_, [](GLFWwindow* window, unsigned character) {
            if (!context_of(window).super_)
                push(window, TextEvent{static_cast<char32_t>(character)});
        });
        glfwSetMouseButtonCallback(
            window_, [](GLFWwindow* window, int glfw_button, int action, int) {
                if (const auto button = button_from_glfw(glfw_button))
                    push(window, MouseButtonEvent{*button, action == GLFW_PRESS});
            });
        glfwSetCursorPosCallback(window_, [](GLFWwindow* window, double x, double y) {
            int width = 0, height = 0;
            glfwGetWindowSize(window, &width, &height);
            if (width > 0 && height > 0)
                push(window, MouseMoveEvent{static_cast<float>(x / width),
                                            static_cast<float>(y / height), width, height});
        });
        glfwSetScrollCallback(window_, [](GLFWwindow* window, double dx, double dy) {
            push(window, ScrollEvent{static_cast<float>(dx), static_cast<float>(dy)});
        });
        glfwSetDropCallback(window_, [](GLFWwindow* window, int count, const char** paths) {
            ++glfw_events();
            GlfwContext& context = context_of(window);
            context.dropped_.insert(context.dropped_.end(), paths, paths + count);
        });
        glfwSetWindowFocusCallback(window_, [](GLFWwindow* window, int focused) {
            push(window, FocusEvent{focused == GLFW_TRUE});
        });
        glfwSetWindowCloseCallback(window_, [](GLFWwindow*) { ++glfw_events(); });
        glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* window, int, int) {
            ++glfw_events();
            context_of(window).damaged_ = true;
        });
        glfwSetWindowRefreshCallback(window_, [](GLFWwindow* window) {
            ++glfw_events();
            context_of(window).damaged_ = true;
        });
    }

    std::shared_ptr<GlfwLibrary> library_;
    GLFWwindow* window_ = nullptr;
    std::vector<WindowEvent> events_;
    std::vector<std::filesystem::path> dropped_;
    GamepadEvent gamepad_{};
    WindowedPlace before_;
    bool stereo_buffers_ = false;
    bool super_ = false;   ///< is held with the last key
    bool damaged_ = false; ///< what it showed is lost
};

} // namespace

std::shared_ptr<const void> open_display() {
    return GlfwLibrary::opened().lock();
}

std::unique_ptr<GlContext> make_glfw_context(const ContextOptions& options) {
    return std::make_unique<GlfwContext>(options);
}

} // namespace isochron::stereo
