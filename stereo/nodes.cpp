// Assigns the windows of an installation to the processes of a job.
#include "stereo/nodes.h"

#include <fmt/format.h>

#include <set>

namespace isochron::stereo {
namespace {

constexpr const char* kConsole = "console";

bool has_windows(const Installation& installation, int node) {
    return std::ranges::any_of(installation.windows,
                               [&](const Window& window) { return window.node == node; });
}

/// A desktop window with the first viewer's view.
Window console_window() {
    Window console;
    console.name = kConsole;
    console.viewports.front().screen = {.lower_left = {-0.8f, -0.45f, -1.0f},
                                        .upper_left = {-0.8f, 0.45f, -1.0f},
                                        .upper_right = {0.8f, 0.45f, -1.0f},
                                        .carried_by_head = true,
                                        .fit_aspect = true};
    return console;
}

} // namespace

int node_count(const Installation& installation) {
    return 1 + std::ranges::max(installation.windows, {}, &Window::node).node;
}

int rank_of(int node, int nodes, int ranks) {
    return ranks < nodes ? node * ranks / nodes : node;
}

std::vector<std::size_t> windows_of(const Installation& installation, int rank, int ranks) {
    const int nodes = node_count(installation);
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < installation.windows.size(); ++i)
        if (rank_of(installation.windows[i].node, nodes, ranks) == rank)
            numbers.push_back(i);
    return numbers;
}

void add_console(Installation& installation, int ranks) {
    if (!windows_of(installation, 0, ranks).empty())
        return;
    Window console = console_window();
    while (std::ranges::count(installation.windows, console.name, &Window::name) > 0)
        console.name += "'";
    installation.windows.push_back(console);
}

std::string misfit(const Installation& installation, int ranks) {
    const int nodes = node_count(installation);
    if (ranks > nodes)
        return fmt::format("{} processes for {} node{}: start as many as windows name nodes, or "
                           "fewer",
                           ranks, nodes, nodes == 1 ? "" : "s");
    for (int node = 1; node < nodes; ++node)
        if (!has_windows(installation, node))
            return fmt::format("no window is on node {} of {}", node, nodes);
    return {};
}

std::vector<int> monitors_of(const Installation& installation,
                             const std::vector<std::size_t>& numbers) {
    std::set<int> covered;
    for (const std::size_t number : numbers)
        if (installation.windows[number].fullscreen)
            covered.insert(installation.windows[number].monitor);
    std::vector<int> monitors;
    for (const std::size_t number : numbers) {
        const Window& window = installation.windows[number];
        int monitor = window.monitor;
        if (window.fullscreen && monitor == kNextMonitor) {
            monitor = 0;
            while (!covered.insert(monitor).second)
                ++monitor;
        }
        monitors.push_back(monitor);
    }
    return monitors;
}

} // namespace isochron::stereo
