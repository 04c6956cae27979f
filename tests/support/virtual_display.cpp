// Start of Xvfb, and requests to it through Xlib and xdotool.
#include "tests/support/virtual_display.h"

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

namespace isochron::test_support {

struct VirtualDisplay::Connection {
    Display* display;
    ~Connection() { XCloseDisplay(display); }
    Window window(const std::string& title) const {
        Window root, parent, *children = nullptr;
        unsigned count = 0;
        XQueryTree(display, DefaultRootWindow(display), &root, &parent, &children, &count);
        Window found = 0;
        for (unsigned i = 0; i < count; ++i) {
            char* name = nullptr;
            if (XFetchName(display, children[i], &name) && name) {
                if (title == name)
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
        prctl(PR_SET_PDEATHSIG, SIGTERM); // it goes with the test, however that ends
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
    if (posix_spawnp(&child, "xdotool", nullptr, nullptr, pointers.data(), environ) != 0)
        throw std::runtime_error("xdotool does not start");
    // `search --sync` waits for a window; a program that died opens none.
    constexpr int kPatience = 6000; // of 10 ms
    int status = -1;
    for (int waited = 0; waitpid(child, &status, WNOHANG) == 0; ++waited) {
        if (waited == kPatience)
            kill(child, SIGKILL);
        usleep(10'000);
    }
    if (status != 0)
        throw std::runtime_error("xdotool " + arguments.front() + " failed");
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
