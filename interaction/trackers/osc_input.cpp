// Input from devices that send Open Sound Control messages; liblo parses the messages.
#include "interaction/trackers/osc_input.h"

#include "interaction/trackers/datagram_receiver.h"
#include "interaction/trackers/device_clock.h"

#include <lo/lo.h>

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <type_traits>
#include <utility>

namespace isochron::interaction {
namespace {

constexpr std::size_t kMostMessages = 512; ///< datagrams per poll or latch; each may be one button
constexpr int kDeepest = 4;                ///< levels of bundles within bundles
constexpr std::string_view kBundle("#bundle\0", 8);
constexpr double kFraction = 4294967296.0; ///< fractions of a second in a time tag

std::uint32_t big_endian(std::string_view bytes) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i)
        value = value << 8 | static_cast<unsigned char>(bytes[i]);
    return value;
}

/// Seconds since 1900, or none: the tag 1 stands for `immediately`.
std::optional<Seconds> time_of(std::string_view tag) {
    const std::uint32_t seconds = big_endian(tag), fraction = big_endian(tag.substr(4));
    if (seconds == 0)
        return std::nullopt;
    return Seconds(seconds + fraction / kFraction);
}

/// Copies the value, as liblo leaves 64-bit values in the message, aligned to 4 bytes only.
template <typename T>
double value_at(const void* argument) {
    T value;
    std::memcpy(&value, argument, sizeof value);
    return static_cast<double>(value);
}

std::optional<double> number(char type, const void* argument) {
    switch (type) {
    case LO_INT32: return value_at<std::int32_t>(argument);
    case LO_INT64: return value_at<std::int64_t>(argument);
    case LO_FLOAT: return value_at<float>(argument);
    case LO_DOUBLE: return value_at<double>(argument);
    case LO_TRUE: return 1.0;
    case LO_FALSE: return 0.0;
    default: return std::nullopt;
    }
}

using Message = std::unique_ptr<std::remove_pointer_t<lo_message>, decltype(&lo_message_free)>;

/// All arguments, if there are `kCount` and each is a number.
template <std::size_t kCount>
std::optional<std::array<double, kCount>> numbers(lo_message message) {
    const char* types = lo_message_get_types(message);
    if (lo_message_get_argc(message) != int{kCount} || !types)
        return std::nullopt;
    lo_arg** arguments = lo_message_get_argv(message);
    std::array<double, kCount> values;
    for (std::size_t i = 0; i < kCount; ++i) {
        const auto value = number(types[i], arguments[i]);
        if (!value)
            return std::nullopt;
        values[i] = *value;
    }
    return values;
}

/// The number of a button or valuator; none if it is not whole, or is above 255.
std::optional<std::size_t> index_of(double value) {
    if (!(value >= 0 && value < 256) || value != static_cast<double>(static_cast<int>(value)))
        return std::nullopt;
    return static_cast<std::size_t>(value);
}

/// A first look, without reading it all: the messages of a bundle have their addresses in it.
Worth worth_of(std::string_view bytes, std::string_view prefix) {
    const bool bundle = bytes.starts_with(kBundle);
    if (!bundle && !bytes.starts_with('/'))
        return Worth::nonsense;
    const bool ours = bundle ? bytes.find(prefix) != bytes.npos : bytes.starts_with(prefix);
    return ours ? Worth::useful : Worth::sensible;
}

} // namespace

struct OscInput::State {
    struct Device {
        std::string address; ///< PREFIX/NAME/
        TrackedDevice tracked;
        std::optional<Velocity> velocity; ///< velocity of the next pose
    };
    DatagramReceiver receiver;
    std::vector<Device> devices;
    DeviceClock clock;
    std::uint64_t messages = 0, wrong_types = 0, unknown = 0, malformed = 0;

    explicit State(const OscOptions& options)
        : receiver({.endpoint = options.endpoint,
                    .ages = options.ages,
                    .worth = [prefix = options.prefix + "/"](std::string_view bytes) {
                        return worth_of(bytes, prefix);
                    }}) {
        for (const OscDevice& each : options.devices)
            devices.push_back({fmt::format("{}/{}/", options.prefix, each.source),
                               TrackedDevice(each.device),
                               {}});
    }

    /// When a message arrived, and when its values were measured.
    struct Moment {
        Seconds arrival, measured;
        std::optional<Seconds> stamp;
    };

    bool take_pose(Device& device, lo_message message, const Moment& moment) {
        const auto v = numbers<7>(message);
        if (!v)
            return false;
        const auto f = [&](std::size_t i) { return static_cast<float>((*v)[i]); };
        device.tracked.add_pose(moment.measured,
                                {{f(0), f(1), f(2)}, glm::quat(f(6), f(3), f(4), f(5))},
                                std::exchange(device.velocity, std::nullopt), moment.stamp);
        return true;
    }

    static bool take_velocity(Device& device, lo_message message) {
        const auto v = numbers<6>(message);
        if (v)
            device.velocity = Velocity{{(*v)[0], (*v)[1], (*v)[2]}, {(*v)[3], (*v)[4], (*v)[5]}};
        return v.has_value();
    }

    static bool take_button(Device& device, lo_message message) {
        const auto v = numbers<2>(message);
        const auto index = v ? index_of((*v)[0]) : std::nullopt;
        if (index)
            device.tracked.set_button(*index, (*v)[1] != 0);
        return index.has_value();
    }

    static bool take_valuator(Device& device, lo_message message) {
        const auto v = numbers<2>(message);
        const auto index = v ? index_of((*v)[0]) : std::nullopt;
        if (index)
            device.tracked.set_valuator(*index, static_cast<float>((*v)[1]));
        return index.has_value();
    }

    /// @return false when there is no such device or message
    bool dispatch(std::string_view path, lo_message message, const Moment& moment) {
        for (Device& device : devices) {
            if (!path.starts_with(device.address))
                continue;
            const std::string_view what = path.substr(device.address.size());
            bool right_types = true;
            if (what == "pose")
                right_types = take_pose(device, message, moment);
            else if (what == "velocity")
                right_types = take_velocity(device, message);
            else if (what == "button")
                right_types = take_button(device, message);
            else if (what == "valuator")
                right_types = take_valuator(device, message);
            else
                return false;
            if (right_types)
                device.tracked.heard(moment.arrival);
            else
                ++wrong_types;
            return true;
        }
        return false;
    }

    void take_message(std::string bytes, const Moment& moment) {
        int status = 0;
        // liblo swaps the byte order of the numbers in place, in `bytes`.
        const Message message(lo_message_deserialise(bytes.data(), bytes.size(), &status),
                              &lo_message_free);
        if (!message || bytes.front() != '/') {
            ++malformed;
            return;
        }
        ++messages;
        if (!dispatch(bytes.c_str(), message.get(), moment))
            ++unknown;
    }

    /// A bundle: `#bundle`, a time tag, then elements, each with its size before it.
    void take_bundle(std::string_view bytes, Moment moment, int depth) {
        if (bytes.size() < 16 || depth == kDeepest) {
            ++malformed;
            return;
        }
        moment.stamp = time_of(bytes.substr(8));
        if (moment.stamp)
            moment.measured = clock.session_time(*moment.stamp, moment.arrival);
        bytes.remove_prefix(16);
        while (!bytes.empty()) {
            const std::size_t size = bytes.size() < 4 ? bytes.size() : big_endian(bytes);
            if (bytes.size() < 4 || size > bytes.size() - 4) {
                ++malformed;
                return;
            }
            take(bytes.substr(4, size), moment, depth + 1);
            bytes.remove_prefix(4 + size);
        }
    }

    void take(std::string_view bytes, const Moment& moment, int depth = 0) {
        if (bytes.empty())
            ++malformed;
        else if (bytes.starts_with(kBundle))
            take_bundle(bytes, moment, depth);
        else
            take_message(std::string(bytes), moment);
    }

    void receive(Seconds now) {
        for (const Datagram& datagram : receiver.take(kMostMessages))
            take(datagram.bytes, {now - datagram.age, now - datagram.age, std::nullopt});
    }
};

OscInput::OscInput(const OscOptions& options) : state_(std::make_unique<State>(options)) {}
OscInput::~OscInput() = default;

InputState OscInput::poll(Seconds now) {
    state_->receive(now);
    InputState input{now, {}};
    for (State::Device& device : state_->devices)
        input.devices.push_back(device.tracked.poll(now));
    return input;
}

void OscInput::begin() {
    state_->receiver.drain();
}

InputState OscInput::latch(Seconds now) {
    state_->receive(now);
    InputState input{now, {}};
    for (const State::Device& device : state_->devices)
        input.devices.push_back(device.tracked.latch(now));
    return input;
}

std::vector<std::string> OscInput::status() const {
    const State& s = *state_;
    std::vector<std::string> lines{fmt::format(
        "osc {}: {} messages, {} of wrong types, {} to unknown addresses, {} malformed, "
        "{} thrown away",
        to_string(s.receiver.endpoint()), s.messages, s.wrong_types, s.unknown, s.malformed,
        s.receiver.thrown_away())};
    for (const State::Device& device : s.devices)
        lines.push_back(device.tracked.status());
    return lines;
}

const Endpoint& OscInput::endpoint() const {
    return state_->receiver.endpoint();
}

} // namespace isochron::interaction
