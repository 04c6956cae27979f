// Finds the problems in the devices of a configuration.
#include "app/config/check_devices.h"

#include "app/config/tracker_setup.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>

namespace isochron::app {
namespace {

/// A line of the file that `places` knows, or 0.
int line_in(const std::vector<int>& lines, std::size_t index) {
    return index < lines.size() ? lines[index] : 0;
}

/// Every device of every tracker, in one form.
struct ListedDevice {
    const interaction::DeviceOptions& options;
    std::string key;    ///< key of the tracker's table
    std::string source; ///< the tracked body, sensor or channel that it reads
    int line;           ///< line of the tracker
};

std::vector<ListedDevice> listed(const DeviceConfig& devices) {
    using interaction::DTrackKind;
    std::vector<ListedDevice> all;
    for (std::size_t i = 0; i < devices.dtrack.size(); ++i)
        for (const interaction::DTrackDevice& each : devices.dtrack[i].devices) {
            const char* kind = each.kind == DTrackKind::body       ? "body"
                               : each.kind == DTrackKind::flystick ? "flystick"
                                                                   : "marker";
            all.push_back(
                {each.device, "dtrack",
                 fmt::format("{} {} of {}", kind, each.id, to_string(devices.dtrack[i].endpoint)),
                 line_in(devices.places.dtrack, i)});
        }
    for (std::size_t i = 0; i < devices.osc.size(); ++i)
        for (const interaction::OscDevice& each : devices.osc[i].devices)
            all.push_back({each.device, "osc",
                           fmt::format("{}/{} of {}", devices.osc[i].prefix, each.source,
                                       to_string(devices.osc[i].endpoint)),
                           line_in(devices.places.osc, i)});
    for (std::size_t i = 0; i < devices.vrpn.size(); ++i)
        for (const interaction::VrpnDevice& each : devices.vrpn[i].devices)
            if (!each.tracker.empty())
                all.push_back({each.device, "vrpn",
                               fmt::format("sensor {} of {}", each.sensor, each.tracker),
                               line_in(devices.places.vrpn, i)});
    return all;
}

/// Whether one of two addresses also receives what is sent to the other.
bool overlap(const interaction::Endpoint& a, const interaction::Endpoint& b) {
    const auto any = [](const std::string& address) {
        return address == "0.0.0.0" || address == "::";
    };
    return a.port == b.port && (a.address == b.address || any(a.address) || any(b.address));
}

class DeviceJudge {
  public:
    explicit DeviceJudge(const Config& config)
        : config_(config), devices_(listed(config.devices)) {}

    std::vector<ConfigProblem> judge() {
        heads();
        sources();
        ports();
        for (const MissingTracker& missing : missing_trackers(config_))
            add(missing.line, missing.key, missing.text);
        return std::move(found_);
    }

  private:
    void add(int line, const std::string& key, const std::string& text, bool wrong = true) {
        found_.push_back({line, key, text, wrong});
    }

    /// Mouse, keyboard and a headset provide `head`; any other name needs a tracker.
    void heads() {
        const auto& viewers = config_.installation.viewers;
        for (std::size_t i = 0; i < viewers.size(); ++i) {
            const std::string& head = viewers[i].head;
            const bool tracked =
                head == "head" || std::ranges::any_of(devices_, [&](const ListedDevice& device) {
                    return device.options.name == head && device.options.has_pose;
                });
            if (!tracked)
                add(line_in(config_.places.viewers, i), "viewers.head",
                    fmt::format("no tracker provides device {}, which tracks viewer {}", head,
                                viewers[i].name));
        }
    }

    void sources() {
        std::map<std::string, std::string> first;
        for (const ListedDevice& device : devices_) {
            const auto [known, is_new] = first.emplace(device.source, device.options.name);
            if (!is_new)
                add(device.line, device.key + ".devices",
                    fmt::format("{} and {} are both {}", known->second, device.options.name,
                                device.source),
                    false);
        }
    }

    void ports() {
        struct Listener {
            interaction::Endpoint endpoint;
            std::string key;
            int line;
        };
        std::vector<Listener> listeners;
        const DeviceConfig& devices = config_.devices;
        for (std::size_t i = 0; i < devices.dtrack.size(); ++i)
            listeners.push_back(
                {devices.dtrack[i].endpoint, "dtrack", line_in(devices.places.dtrack, i)});
        for (std::size_t i = 0; i < devices.osc.size(); ++i)
            listeners.push_back({devices.osc[i].endpoint, "osc", line_in(devices.places.osc, i)});
        for (std::size_t i = 0; i < listeners.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                if (overlap(listeners[i].endpoint, listeners[j].endpoint))
                    add(listeners[i].line, listeners[i].key + ".port",
                        fmt::format("{} is the {} tracker's of line {} already",
                                    to_string(listeners[i].endpoint), listeners[j].key,
                                    listeners[j].line));
    }

    const Config& config_;
    std::vector<ListedDevice> devices_;
    std::vector<ConfigProblem> found_;
};

} // namespace

std::vector<ConfigProblem> problems_of_devices(const Config& config) {
    return DeviceJudge(config).judge();
}

} // namespace isochron::app
