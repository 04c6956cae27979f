// Starts Xvfb, and sends it requests through Xlib and xdotool.
#include "tests/support/virtual_display.h"

#include "tests/support/eventually.h"

#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>

#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <spawn.h>
#include <stdexcept>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

namespace isochron::test_support {

namespace {

/// While it lives, a window that has just gone is no reason for Xlib to end the test.
class Lost {
  public:
    explicit Lost(Display* display)
        : display_(display), before_(XSetErrorHandler([](Display*, XErrorEvent*) {
              met = true;
              return 0;
          })) {
        met = false;
    }
    ~Lost() {
        XSync(display_, False);
        XSetErrorHandler(before_);
    }
    Lost(const Lost&) = delete;
    Lost& operator=(const Lost&) = delete;

    static inline bool met = false; ///< Xlib's handlers have no room for state

  private:
    Display* display_;
    XErrorHandler before_;
};

} // namespace

struct VirtualDisplay::Connection {
    Display* display;
    ~Connection() {
        if (display)
            XCloseDisplay(display);
    }
    Atom atom(const char* name) const { return XInternAtom(display, name, False); }
    /// Sends a message of the protocol XDND (https://freedesktop.org/wiki/Specifications/XDND),
    /// version 5.
    void send_dnd(Window source, Window target, const char* type,
                  const std::array<long, 4>& data) const {
        XEvent event{};
        event.xclient.type = ClientMessage;
        event.xclient.display = display;
        event.xclient.window = target;
        event.xclient.message_type = atom(type);
        event.xclient.format = 32;
        event.xclient.data.l[0] = static_cast<long>(source);
        for (std::size_t i = 0; i < data.size(); ++i)
            event.xclient.data.l[i + 1] = data[i];
        XSendEvent(display, target, False, NoEventMask, &event);
        XFlush(display);
    }
    /// Hands out what is dragged, until the target says this. @return false when it never does
    bool serve_dnd(const std::string& uris, const char* last_word) const {
        return eventually([&] {
            while (XPending(display) > 0) {
                XEvent event;
                XNextEvent(display, &event);
                if (event.type == ClientMessage && event.xclient.message_type == atom(last_word))
                    return true;
                if (event.type != SelectionRequest)
                    continue;
                const XSelectionRequestEvent& asked = event.xselectionrequest;
                XChangeProperty(display, asked.requestor, asked.property, asked.target, 8,
                                PropModeReplace,
                                reinterpret_cast<const unsigned char*>(uris.data()),
                                static_cast<int>(uris.size()));
                XEvent answer{};
                answer.xselection = {.type = SelectionNotify,
                                     .serial = 0,
                                     .send_event = True,
                                     .display = display,
                                     .requestor = asked.requestor,
                                     .selection = asked.selection,
                                     .target = asked.target,
                                     .property = asked.property,
                                     .time = asked.time};
                XSendEvent(display, asked.requestor, False, NoEventMask, &answer);
                XFlush(display);
            }
            return false;
        });
    }
    /// Asks a window whether its program is at work, which answers when it has taken all input
    /// before (_NET_WM_PING). @return false when the window is gone
    bool ping(Window window) const {
        static long number = 0;
        ++number;
        bool is_gone = false;
        const Window root = DefaultRootWindow(display);
        XSelectInput(display, root, SubstructureNotifyMask); // answers go there
        XEvent event{};
        event.xclient.type = ClientMessage;
        event.xclient.window = window;
        event.xclient.message_type = atom("WM_PROTOCOLS");
        event.xclient.format = 32;
        event.xclient.data.l[0] = static_cast<long>(atom("_NET_WM_PING"));
        event.xclient.data.l[1] = number;
        event.xclient.data.l[2] = static_cast<long>(window);
        XSendEvent(display, window, False, NoEventMask, &event);
        XSync(display, False);
        bool answers = false;
        const bool in_time = eventually([&] {
            while (!answers && !is_gone && XPending(display) > 0) {
                XNextEvent(display, &event);
                answers = event.type == ClientMessage && event.xclient.window == root &&
                          event.xclient.data.l[1] == number;
                is_gone = event.type == DestroyNotify && event.xdestroywindow.window == window;
            }
            is_gone = is_gone || Lost::met;
            return answers || is_gone;
        });
        XSelectInput(display, root, NoEventMask);
        if (!in_time)
            throw std::runtime_error("a window does not answer");
        return answers;
    }
    /// The window with this title, or the last one whose title begins so.
    Window window(const std::string& title, bool whole = true) const {
        Window root, parent, *children = nullptr;
        unsigned count = 0;
        XQueryTree(display, DefaultRootWindow(display), &root, &parent, &children, &count);
        Window found = 0;
        for (unsigned i = 0; i < count; ++i) {
            char* name = nullptr;
            if (XFetchName(display, children[i], &name) && name) {
                if (whole ? title == name : std::string(name).starts_with(title))
                    found = children[i];
                XFree(name);
            }
        }
        if (children)
            XFree(children);
        if (!found)
            throw std::runtime_error("no window has the title " + title);
        return found;
    }
};

VirtualDisplay::VirtualDisplay() {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0)
        throw std::runtime_error("no pipe to Xvfb");
    server_ = fork();
    if (server_ == 0) {
        prctl(PR_SET_PDEATHSIG, SIGTERM); // it ends with the test in any case
        const int silence = open("/dev/null", O_WRONLY);
        dup2(silence, STDERR_FILENO);
        dup2(ends[1], STDOUT_FILENO);
        execlp("Xvfb", "Xvfb", "-displayfd", "1", "-screen", "0", "1280x1024x24", "-nolisten",
               "tcp", "-noreset", static_cast<char*>(nullptr));
        _exit(127);
    }
    close(ends[1]);
    std::string number;
    for (char c = 0; read(ends[0], &c, 1) == 1 && c != '\n';)
        number += c;
    close(ends[0]);
    setenv("DISPLAY", (":" + number).c_str(), 1);
    Display* display = number.empty() ? nullptr : XOpenDisplay(nullptr);
    if (!display) {
        kill(server_, SIGTERM);
        waitpid(server_, nullptr, 0);
        throw std::runtime_error("Xvfb did not start");
    }
    connection_ = std::make_unique<Connection>(display);
}

VirtualDisplay::~VirtualDisplay() {
    connection_.reset();
    unsetenv("DISPLAY");
    if (server_ < 0)
        return;
    kill(server_, SIGTERM);
    waitpid(server_, nullptr, 0);
}

void VirtualDisplay::xdotool(std::vector<std::string> arguments) const {
    std::string program = "xdotool";
    std::vector<char*> pointers{program.data()};
    for (std::string& argument : arguments)
        pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    pid_t child = -1;
    // The numbers of the windows that it finds would fill a long run's output.
    posix_spawn_file_actions_t quiet;
    posix_spawn_file_actions_init(&quiet);
    posix_spawn_file_actions_addopen(&quiet, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    const int refused = posix_spawnp(&child, "xdotool", &quiet, nullptr, pointers.data(), environ);
    posix_spawn_file_actions_destroy(&quiet);
    if (refused != 0)
        throw std::runtime_error("xdotool does not start");
    // `search --sync` would wait forever for a window of a program that has died.
    int status = -1;
    if (!eventually([&] { return waitpid(child, &status, WNOHANG) != 0; })) {
        kill(child, SIGKILL);
        waitpid(child, &status, 0);
    }
    if (status != 0)
        throw std::runtime_error("xdotool " + arguments.front() + " failed");
}

void VirtualDisplay::await_frame(const std::string& begin) const {
    const Lost lost(connection_->display);
    // Input that the program takes along with one answer is in the frame before the next answer.
    const Window window = connection_->window(begin, false);
    if (connection_->ping(window))
        connection_->ping(window);
}

void VirtualDisplay::resize_window(const std::string& title, int width, int height) const {
    XResizeWindow(connection_->display, connection_->window(title), static_cast<unsigned>(width),
                  static_cast<unsigned>(height));
    XSync(connection_->display, False);
}

void VirtualDisplay::close_window(const std::string& title) const {
    Display* display = connection_->display;
    const Window window = connection_->window(title);
    XEvent event{};
    event.xclient.type = ClientMessage;
    event.xclient.window = window;
    event.xclient.message_type = XInternAtom(display, "WM_PROTOCOLS", False);
    event.xclient.format = 32;
    event.xclient.data.l[0] = static_cast<long>(XInternAtom(display, "WM_DELETE_WINDOW", False));
    XSendEvent(display, window, False, NoEventMask, &event);
    XSync(display, False);
}

void VirtualDisplay::drop_file(const std::string& title, const std::string& path) const {
    const Connection& x = *connection_;
    const Window target = x.window(title);
    const Window source =
        XCreateSimpleWindow(x.display, DefaultRootWindow(x.display), 0, 0, 1, 1, 0, 0, 0);
    XSetSelectionOwner(x.display, x.atom("XdndSelection"), source, CurrentTime);
    constexpr long kVersion = 5L << 24;
    const auto list = static_cast<long>(x.atom("text/uri-list"));
    const auto copy = static_cast<long>(x.atom("XdndActionCopy"));
    x.send_dnd(source, target, "XdndEnter", {kVersion, list, 0, 0});
    x.send_dnd(source, target, "XdndPosition", {0, 100L << 16 | 100, CurrentTime, copy});
    const std::string uris = "file://" + path + "\r\n";
    bool taken = x.serve_dnd(uris, "XdndStatus");
    x.send_dnd(source, target, "XdndDrop", {0, CurrentTime, 0, 0});
    taken = taken && x.serve_dnd(uris, "XdndFinished");
    XDestroyWindow(x.display, source);
    XSync(x.display, False);
    if (!taken)
        throw std::runtime_error(title + " does not take what is dropped");
}

std::string VirtualDisplay::clipboard() const {
    const Connection& x = *connection_;
    const Window asks =
        XCreateSimpleWindow(x.display, DefaultRootWindow(x.display), 0, 0, 1, 1, 0, 0, 0);
    const Atom text = x.atom("UTF8_STRING"), clipboard = x.atom("CLIPBOARD");
    XConvertSelection(x.display, clipboard, text, text, asks, CurrentTime);
    XEvent answer;
    const bool answered = eventually(
        [&] { return XCheckTypedWindowEvent(x.display, asks, SelectionNotify, &answer) == True; });
    std::string words;
    if (answered && answer.xselection.property != None) {
        Atom type = None;
        int format = 0;
        unsigned long size = 0, left = 0;
        unsigned char* bytes = nullptr;
        XGetWindowProperty(x.display, asks, text, 0, 1 << 16, False, AnyPropertyType, &type,
                           &format, &size, &left, &bytes);
        if (bytes)
            words.assign(reinterpret_cast<const char*>(bytes), size);
        XFree(bytes);
    }
    XDestroyWindow(x.display, asks);
    XSync(x.display, False);
    return words;
}

void VirtualDisplay::set_dots_per_inch(int dots) const {
    Display* display = connection_->display;
    const std::string resources = "Xft.dpi:\t" + std::to_string(dots) + "\n";
    XChangeProperty(display, DefaultRootWindow(display), XA_RESOURCE_MANAGER, XA_STRING, 8,
                    PropModeReplace, reinterpret_cast<const unsigned char*>(resources.data()),
                    static_cast<int>(resources.size()));
    XSync(display, False);
}

void VirtualDisplay::die() {
    kill(server_, SIGKILL);
    waitpid(std::exchange(server_, -1), nullptr, 0);
    // Xlib would end the test with it, and a checker for leaks must still find it.
    [[maybe_unused]] static Display* cut_off = nullptr;
    cut_off = std::exchange(connection_->display, nullptr);
}

std::array<int, 3> VirtualDisplay::pixel(int x, int y) const {
    Display* display = connection_->display;
    XImage* image = XGetImage(display, DefaultRootWindow(display), x, y, 1, 1, AllPlanes, ZPixmap);
    if (!image)
        throw std::runtime_error("the pixel cannot be read");
    const unsigned long value = XGetPixel(image, 0, 0);
    XDestroyImage(image);
    return {static_cast<int>(value >> 16 & 255), static_cast<int>(value >> 8 & 255),
            static_cast<int>(value & 255)};
}

} // namespace isochron::test_support
