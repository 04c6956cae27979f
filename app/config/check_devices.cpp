// Finds the problems in the devices of a configuration.
#include "app/config/check/check_parts.h"

#include "app/config/tracker_setup.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>

namespace isochron::app {
namespace {

/// Every device of every tracker, in one form.
struct ListedDevice {
    const interaction::DeviceOptions& options;
    std::string key;    ///< key of the tracker's table
    std::string source; ///< the tracked body, sensor or channel that it reads
    int line;           ///< line of the tracker
};

std::string source_read_by(const interaction::DTrackOptions& dtrack,
                           const interaction::DTrackDevice& device) {
    return fmt::format("{} {} of {}", name_of(device.kind), device.id, to_string(dtrack.endpoint));
}
std::string source_read_by(const interaction::OscOptions& osc,
                           const interaction::OscDevice& device) {
    return fmt::format("{}/{} of {}", osc.prefix, device.source, to_string(osc.endpoint));
}
std::string source_read_by(const interaction::VrpnOptions&, const interaction::VrpnDevice& device) {
    return device.tracker.empty() ? ""
                                  : fmt::format("sensor {} of {}", device.sensor, device.tracker);
}

std::vector<ListedDevice> listed(const DeviceConfig& devices) {
    std::vector<ListedDevice> all;
    each_tracker(devices, [&](const char* key, const auto& tracker) {
        for (const auto& each : tracker.devices)
            if (const std::string source = source_read_by(tracker, each); !source.empty())
                all.push_back({each.device, key, source, tracker.line});
    });
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
    DeviceJudge(const Config& config, Findings& findings)
        : config_(config), devices_(listed(config.devices)), findings_(findings) {}

    void judge() {
        heads();
        sources();
        ports();
        for (const ConfigProblem& missing : missing_trackers(config_))
            findings_.wrong(missing.line, missing.key, missing.text);
    }

  private:
    /// Mouse, keyboard and a headset provide `head`; any other name needs a tracker.
    void heads() {
        for (const stereo::Viewer& viewer : config_.installation.viewers) {
            const std::string& head = viewer.head;
            const bool tracked =
                head == "head" || std::ranges::any_of(devices_, [&](const ListedDevice& device) {
                    return device.options.name == head && device.options.has_pose;
                });
            if (!tracked)
                findings_.wrong(viewer.line.number, "viewers.head",
                                fmt::format("no tracker provides device {}, which tracks viewer {}",
                                            head, viewer.name));
        }
    }

    void sources() {
        std::map<std::string, std::string> first;
        for (const ListedDevice& device : devices_) {
            const auto [known, is_new] = first.emplace(device.source, device.options.name);
            if (!is_new)
                findings_.warn(device.line, device.key + ".devices",
                               fmt::format("{} and {} are both {}", known->second,
                                           device.options.name, device.source));
        }
    }

    void ports() {
        struct Listener {
            interaction::Endpoint endpoint;
            std::string key;
            int line;
        };
        std::vector<Listener> listeners;
        each_tracker(config_.devices, [&](const char* key, const auto& tracker) {
            if constexpr (requires { tracker.endpoint; })
                listeners.push_back({tracker.endpoint, key, tracker.line});
        });
        for (std::size_t i = 0; i < listeners.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                if (overlap(listeners[i].endpoint, listeners[j].endpoint))
                    findings_.wrong(listeners[i].line, listeners[i].key + ".port",
                                    fmt::format("{} is the {} tracker's of line {} already",
                                                to_string(listeners[i].endpoint), listeners[j].key,
                                                listeners[j].line));
    }

    const Config& config_;
    std::vector<ListedDevice> devices_;
    Findings& findings_;
};

} // namespace

void check_devices(const Config& config, Findings& findings) {
    DeviceJudge(config, findings).judge();
}

} // namespace isochron::app
