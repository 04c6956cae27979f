// Input from devices of VRPN servers, all read on one thread.
#include "interaction/trackers/vrpn_input.h"

#include "interaction/trackers/device_clock.h"

#include <vrpn_Analog.h>
#include <vrpn_Button.h>
#include <vrpn_Tracker.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <mutex>
#include <thread>

namespace isochron::interaction {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto kPause = 1ms; ///< between two polls of the connections
constexpr std::size_t kMostSamples = 64;

Seconds seconds_of(const timeval& time) {
    return Seconds(static_cast<double>(time.tv_sec)) +
           Seconds(1e-6 * static_cast<double>(time.tv_usec));
}

/// VRPN reports angular velocity as the rotation within a time.
Velocity velocity_of(const vrpn_TRACKERVELCB& report) {
    const glm::quat turn(
        static_cast<float>(report.vel_quat[3]), static_cast<float>(report.vel_quat[0]),
        static_cast<float>(report.vel_quat[1]), static_cast<float>(report.vel_quat[2]));
    const glm::dvec3 angle = rotation_between(glm::quat(1, 0, 0, 0), turn);
    return {{report.vel[0], report.vel[1], report.vel[2]},
            report.vel_quat_dt > 0 ? angle / report.vel_quat_dt : glm::dvec3(0)};
}

/// What one device has sent since it was last taken over.
struct Received {
    struct Sample {
        Clock::time_point arrival;
        Seconds stamp;
        Pose pose;
    };
    std::vector<Sample> samples;
    std::optional<Velocity> velocity;
    std::uint64_t buttons = 0, tapped = 0;
    std::array<float, TrackedDevice::kMostValuators> valuators{};
    std::size_t valuator_count = 0;
    bool connected = false;
};

} // namespace

struct VrpnInput::State {
    /// One device: the thread fills `received`, the polling side takes it over.
    struct Source {
        VrpnDevice options;
        TrackedDevice tracked; ///< the device, for the polling side
        DeviceClock clock;
        std::mutex mutex;
        Received received;
        explicit Source(const VrpnDevice& device) : options(device), tracked(device.device) {}

        static void VRPN_CALLBACK pose(void* self, const vrpn_TRACKERCB report) {
            auto& source = *static_cast<Source*>(self);
            const auto f = [](double value) { return static_cast<float>(value); };
            const Pose measured{{f(report.pos[0]), f(report.pos[1]), f(report.pos[2])},
                                glm::quat(f(report.quat[3]), f(report.quat[0]), f(report.quat[1]),
                                          f(report.quat[2]))};
            const std::lock_guard lock(source.mutex);
            auto& samples = source.received.samples;
            if (samples.size() == kMostSamples)
                samples.erase(samples.begin());
            samples.push_back({Clock::now(), seconds_of(report.msg_time), measured});
        }
        static void VRPN_CALLBACK velocity(void* self, const vrpn_TRACKERVELCB report) {
            auto& source = *static_cast<Source*>(self);
            const std::lock_guard lock(source.mutex);
            source.received.velocity = velocity_of(report);
        }
        static void VRPN_CALLBACK button(void* self, const vrpn_BUTTONCB report) {
            if (report.button < 0 || report.button >= 64)
                return;
            auto& source = *static_cast<Source*>(self);
            const std::uint64_t mask = std::uint64_t{1} << report.button;
            const std::lock_guard lock(source.mutex);
            std::uint64_t& buttons = source.received.buttons;
            buttons = report.state ? buttons | mask : buttons & ~mask;
            source.received.tapped |= buttons;
        }
        /// The states of all buttons, sent when a connection is made: some may be down already.
        static void VRPN_CALLBACK buttons(void* self, const vrpn_BUTTONSTATESCB report) {
            auto& source = *static_cast<Source*>(self);
            std::uint64_t states = 0;
            for (int i = 0; i < std::min(report.num_buttons, 64); ++i)
                states |= std::uint64_t{report.states[i] != 0} << i;
            const std::lock_guard lock(source.mutex);
            source.received.buttons = states;
            source.received.tapped |= states;
        }
        static void VRPN_CALLBACK analog(void* self, const vrpn_ANALOGCB report) {
            auto& source = *static_cast<Source*>(self);
            const std::lock_guard lock(source.mutex);
            Received& received = source.received;
            received.valuator_count =
                std::min(static_cast<std::size_t>(std::max(report.num_channel, 0)),
                         received.valuators.size());
            std::copy_n(report.channel, received.valuator_count, received.valuators.begin());
        }

        /// Takes over what the thread has received; holds the lock only while it copies.
        Received take() {
            const std::lock_guard lock(mutex);
            Received taken = received;
            received.samples.clear();
            received.velocity.reset();
            received.tapped = 0;
            return taken;
        }

        void receive(Seconds now) {
            const Received taken = take();
            if (taken.connected)
                tracked.heard(now);
            const Clock::time_point here = Clock::now();
            for (const Received::Sample& sample : taken.samples) {
                const Seconds arrival = now - Seconds(here - sample.arrival);
                tracked.add_pose(clock.session_time(sample.stamp, arrival), sample.pose,
                                 taken.velocity, sample.stamp);
            }
            tracked.set_buttons(taken.buttons | taken.tapped); // shows taps in the next poll
            tracked.set_buttons(taken.buttons);
            for (std::size_t i = 0; i < taken.valuator_count; ++i)
                tracked.set_valuator(i, taken.valuators[i]);
        }
    };

    /// VRPN's own objects: made, used and destroyed by the thread.
    struct Remotes {
        Source& source;
        std::unique_ptr<vrpn_Tracker_Remote> tracker;
        std::unique_ptr<vrpn_Button_Remote> buttons;
        std::unique_ptr<vrpn_Analog_Remote> analog;

        explicit Remotes(Source& from) : source(from) {
            const VrpnDevice& options = from.options;
            if (!options.tracker.empty()) {
                tracker = std::make_unique<vrpn_Tracker_Remote>(options.tracker.c_str());
                tracker->register_change_handler(&source, &Source::pose, options.sensor);
                tracker->register_change_handler(&source, &Source::velocity, options.sensor);
            }
            if (!options.buttons.empty()) {
                buttons = std::make_unique<vrpn_Button_Remote>(options.buttons.c_str());
                buttons->register_change_handler(&source, &Source::button);
                buttons->register_states_handler(&source, &Source::buttons);
            }
            if (!options.analog.empty()) {
                analog = std::make_unique<vrpn_Analog_Remote>(options.analog.c_str());
                analog->register_change_handler(&source, &Source::analog);
            }
        }
        void look() {
            bool connected = true;
            const auto each = [&](auto& remote) {
                if (!remote)
                    return;
                remote->mainloop();
                connected = connected && remote->connectionPtr()->connected();
            };
            each(tracker);
            each(buttons);
            each(analog);
            const std::lock_guard lock(source.mutex);
            source.received.connected = connected;
        }
    };

    std::vector<std::unique_ptr<Source>> sources;
    std::jthread thread; ///< the last member, so that it ends before what it uses is destroyed

    void run(const std::stop_token& stop) {
        std::vector<Remotes> remotes;
        for (const auto& source : sources)
            remotes.emplace_back(*source);
        while (!stop.stop_requested()) {
            for (Remotes& each : remotes)
                each.look();
            std::this_thread::sleep_for(kPause);
        }
    }
};

VrpnInput::VrpnInput(const VrpnOptions& options) : state_(std::make_unique<State>()) {
    for (const VrpnDevice& device : options.devices)
        state_->sources.push_back(std::make_unique<State::Source>(device));
    state_->thread =
        std::jthread([state = state_.get()](const std::stop_token& stop) { state->run(stop); });
}
VrpnInput::~VrpnInput() = default;

InputState VrpnInput::poll(Seconds now) {
    InputState input{now, {}};
    for (const auto& source : state_->sources) {
        source->receive(now);
        input.devices.push_back(source->tracked.poll(now));
    }
    return input;
}

InputState VrpnInput::latch(Seconds now) {
    InputState input{now, {}};
    for (const auto& source : state_->sources) {
        source->receive(now);
        input.devices.push_back(source->tracked.latch(now));
    }
    return input;
}

std::vector<std::string> VrpnInput::status() const {
    std::vector<std::string> lines;
    for (const auto& source : state_->sources) {
        const VrpnDevice& options = source->options;
        const std::lock_guard lock(source->mutex);
        lines.push_back(fmt::format("vrpn {} {} {}: {}", options.tracker, options.buttons,
                                    options.analog,
                                    source->received.connected ? "connected" : "not connected"));
        lines.push_back(source->tracked.status());
    }
    return lines;
}

} // namespace isochron::interaction
