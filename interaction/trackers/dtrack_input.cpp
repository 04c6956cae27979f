// Input from an ART tracking system: turns DTrack's datagrams into devices.
#include "interaction/trackers/dtrack_input.h"

#include "interaction/trackers/datagram_receiver.h"
#include "interaction/trackers/device_clock.h"
#include "interaction/trackers/dtrack_protocol.h"
#include "interaction/trackers/frame_sequence.h"
#include "interaction/trackers/used_sender.h"

#include <algorithm>

#include <fmt/format.h>

namespace isochron::interaction {
namespace {

/// Per poll or latch: a program that polls 20 times per second keeps up with 300 datagrams per
/// second.
constexpr std::size_t kMostDatagrams = 32;

void add_body(TrackedDevice& device, const DTrackBody& body, Seconds measured,
              std::optional<Seconds> stamp) {
    if (!body.tracked)
        return;
    if (const auto rotation = rotation_from(body.rotation))
        device.add_pose(measured, {glm::vec3(body.position), *rotation}, std::nullopt, stamp);
    else
        device.refuse_pose();
}

/// Whether a frame tells about a device: tracked or not, DTrack names it in each of its frames.
bool names(const DTrackFrame& frame, const DTrackDevice& device) {
    switch (device.kind) {
    case DTrackKind::body:
        return std::ranges::find(frame.bodies, device.id, &DTrackBody::id) != frame.bodies.end();
    case DTrackKind::flystick:
        return std::ranges::any_of(
            frame.flysticks, [&](const DTrackFlystick& each) { return each.body.id == device.id; });
    case DTrackKind::marker: break;
    }
    return std::ranges::find(frame.markers, device.id, &DTrackMarker::id) != frame.markers.end();
}

Worth worth_of(std::string_view bytes, const std::vector<DTrackDevice>& devices) {
    const auto frame = parse_dtrack(bytes);
    if (!frame)
        return Worth::nonsense;
    return std::ranges::any_of(devices,
                               [&](const DTrackDevice& each) { return names(*frame, each); })
               ? Worth::useful
               : Worth::sensible;
}

} // namespace

struct DTrackInput::State {
    struct Device {
        DTrackKind kind;
        int id;
        TrackedDevice tracked;
    };
    std::vector<Device> devices;
    UsedSender senders;
    bool narrows; ///< the kernel drops others while the configured sender is heard
    std::optional<Endpoint> chosen; ///< the sender that is heard
    FrameSequence sequence;
    DeviceClock clock;
    std::uint64_t malformed = 0;
    DatagramReceiver receiver; ///< its thread looks at nothing else here

    explicit State(const DTrackOptions& options)
        : senders(options.from), narrows(options.from.has_value()),
          receiver({.endpoint = options.endpoint,
                    .ages = options.ages,
                    .worth = [devices = options.devices](std::string_view bytes) {
                        return worth_of(bytes, devices);
                    }}) {
        for (const DTrackDevice& each : options.devices)
            devices.push_back({each.kind, each.id, TrackedDevice(each.device)});
    }

    void take(const DTrackFrame& frame, Seconds arrival) {
        const Seconds measured = frame.time ? clock.session_time(*frame.time, arrival) : arrival;
        for (Device& device : devices)
            switch (device.kind) {
            case DTrackKind::body:
                for (const DTrackBody& body : frame.bodies)
                    if (body.id == device.id)
                        add_body(device.tracked, body, measured, frame.time);
                break;
            case DTrackKind::flystick:
                for (const DTrackFlystick& flystick : frame.flysticks)
                    if (flystick.body.id == device.id)
                        take(device.tracked, flystick, measured, arrival, frame.time);
                break;
            case DTrackKind::marker:
                for (const DTrackMarker& marker : frame.markers)
                    if (marker.id == device.id)
                        device.tracked.add_pose(measured,
                                                {glm::vec3(marker.position), glm::quat(1, 0, 0, 0)},
                                                std::nullopt, frame.time);
                break;
            }
    }

    /// Buttons come by radio, so they are valid even while the Flystick is not tracked.
    static void take(TrackedDevice& device, const DTrackFlystick& flystick, Seconds measured,
                     Seconds arrival, std::optional<Seconds> stamp) {
        device.heard(arrival);
        device.set_buttons(flystick.buttons);
        for (std::size_t i = 0; i < flystick.controllers.size(); ++i)
            device.set_valuator(i, flystick.controllers[i]);
        add_body(device, flystick.body, measured, stamp);
    }

    void take(const Datagram& datagram, Seconds now) {
        const Seconds arrival = now - datagram.age;
        // Asked again, as an earlier datagram may have shown that its sender makes no sense.
        if (!senders.admits(datagram.sender, arrival))
            return;
        const auto frame = parse_dtrack(datagram.bytes);
        malformed += frame ? static_cast<std::uint64_t>(frame->malformed_lines) : 1;
        if (!frame)
            return senders.made_no_sense(arrival);
        senders.heard(arrival);
        if (sequence.accept(frame->counter, arrival))
            take(*frame, arrival);
    }

    void receive(Seconds now) {
        const auto admits = [&](const Endpoint& sender, Seconds age) {
            return senders.admits(sender, now - age);
        };
        for (const Datagram& datagram : receiver.take(kMostDatagrams, admits))
            take(datagram, now);
        const auto heard = senders.proven(now);
        if (heard == chosen)
            return;
        receiver.prefer(heard);
        if (narrows)
            receiver.hear_only(heard);
        chosen = heard;
    }
};

DTrackInput::DTrackInput(const DTrackOptions& options) : state_(std::make_unique<State>(options)) {}
DTrackInput::~DTrackInput() = default;

InputState DTrackInput::poll(Seconds now) {
    state_->receive(now);
    InputState input{now, {}};
    for (State::Device& device : state_->devices)
        input.devices.push_back(device.tracked.poll(now));
    return input;
}

void DTrackInput::begin() {
    state_->receiver.drain();
}

InputState DTrackInput::latch(Seconds now) {
    state_->receive(now);
    InputState input{now, {}};
    for (const State::Device& device : state_->devices)
        input.devices.push_back(device.tracked.latch(now));
    return input;
}

std::vector<std::string> DTrackInput::status() const {
    const State& s = *state_;
    std::vector<std::string> lines{
        fmt::format("dtrack {}: {} frames, {} missing, {} late, {} malformed, {} thrown away{}",
                    to_string(s.receiver.endpoint()), s.sequence.accepted(), s.sequence.missing(),
                    s.sequence.late(), s.malformed, s.receiver.thrown_away(),
                    s.senders.strangers(s.receiver.others()))};
    for (const State::Device& device : s.devices)
        lines.push_back(device.tracked.status());
    return lines;
}

const Endpoint& DTrackInput::endpoint() const {
    return state_->receiver.endpoint();
}

} // namespace isochron::interaction
