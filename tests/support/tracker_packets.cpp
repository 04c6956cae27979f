// Plays a tracker: makes and sends datagrams of DTrack and Open Sound Control devices.
#include "tests/support/tracker_packets.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>

#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>

namespace isochron::test_support {
namespace {

std::string position_block(const glm::dvec3& meters) {
    return fmt::format("[{:.3f} {:.3f} {:.3f}]", 1e3 * meters.x, 1e3 * meters.y, 1e3 * meters.z);
}

std::string rotation_block(const glm::dmat3& rotation) {
    std::string text = "[";
    for (int i = 0; i < 9; ++i)
        text += fmt::format("{}{:.6f}", i ? " " : "", rotation[i / 3][i % 3]);
    return text + "]";
}

void append(std::string& bytes, std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8)
        bytes.push_back(static_cast<char>(value >> shift & 0xff));
}

/// Appends one to four zero bytes, up to a multiple of four.
std::string padded(std::string_view text) {
    std::string bytes(text);
    do
        bytes.push_back('\0');
    while (bytes.size() % 4 != 0);
    return bytes;
}

} // namespace

std::string dtrack_datagram(std::uint32_t counter, std::optional<double> stamp,
                            const std::vector<PlayedBody>& bodies,
                            const std::vector<PlayedFlystick>& flysticks,
                            const std::vector<glm::dvec3>& markers) {
    std::string text = fmt::format("fr {}\r\n", counter);
    if (stamp)
        text += fmt::format("ts {:.6f}\r\n", *stamp);
    text += fmt::format("6dcal {}\r\n6d {}", bodies.size() + flysticks.size(), bodies.size());
    for (const PlayedBody& body : bodies)
        text += fmt::format(" [{} 1.000]{}{}", body.id, position_block(body.position),
                            rotation_block(body.rotation));
    text += fmt::format("\r\n6df2 {} {}", flysticks.size(), flysticks.size());
    for (const PlayedFlystick& stick : flysticks) {
        const bool tracked = stick.body.tracked;
        text += fmt::format(
            " [{} {} 6 {}]{}{}[{}", stick.body.id, tracked ? "1.000" : "-1.000",
            stick.controllers.size(), position_block(tracked ? stick.body.position : glm::dvec3(0)),
            rotation_block(tracked ? stick.body.rotation : glm::dmat3(0)), stick.buttons);
        for (const double value : stick.controllers)
            text += fmt::format(" {:.2f}", value);
        text += "]";
    }
    text += fmt::format("\r\n3d {}", markers.size());
    for (std::size_t i = 0; i < markers.size(); ++i)
        text += fmt::format(" [{} 1.000]{}", i + 1, position_block(markers[i]));
    return text + "\r\n";
}

std::string osc_message(std::string_view address, const std::vector<OscArgument>& arguments) {
    std::string types = ",", values;
    for (const OscArgument& argument : arguments) {
        types.push_back(argument.type);
        if (argument.type == 'i') {
            append(values, static_cast<std::uint32_t>(static_cast<std::int32_t>(argument.value)));
        } else if (argument.type == 'f') {
            append(values, std::bit_cast<std::uint32_t>(static_cast<float>(argument.value)));
        } else {
            const auto bits = std::bit_cast<std::uint64_t>(argument.value);
            append(values, static_cast<std::uint32_t>(bits >> 32));
            append(values, static_cast<std::uint32_t>(bits));
        }
    }
    return padded(address) + padded(types) + values;
}

std::string osc_pose(std::string_view address, const interaction::Pose& pose) {
    const auto& [p, q] = pose;
    std::vector<OscArgument> arguments;
    for (const float value : {p.x, p.y, p.z, q.x, q.y, q.z, q.w})
        arguments.push_back({'f', value});
    return osc_message(address, arguments);
}

std::string osc_bundle(double stamp, const std::vector<std::string>& elements) {
    std::string bytes = padded("#bundle");
    append(bytes, static_cast<std::uint32_t>(stamp));
    append(bytes,
           stamp == 0 ? 1 : static_cast<std::uint32_t>((stamp - std::floor(stamp)) * 4294967296.0));
    for (const std::string& element : elements) {
        append(bytes, static_cast<std::uint32_t>(element.size()));
        bytes += element;
    }
    return bytes;
}

UdpSender::UdpSender(const interaction::Endpoint& to) {
    addrinfo hints{};
    hints.ai_socktype = SOCK_DGRAM;
    hints.ai_flags = AI_NUMERICHOST;
    addrinfo* found = nullptr;
    if (getaddrinfo(to.address.c_str(), std::to_string(to.port).c_str(), &hints, &found) != 0)
        return;
    socket_ = ::socket(found->ai_family, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    if (socket_ >= 0 && connect(socket_, found->ai_addr, found->ai_addrlen) != 0) {
        close(socket_);
        socket_ = -1;
    }
    freeaddrinfo(found);
}

UdpSender::~UdpSender() {
    if (socket_ >= 0)
        close(socket_);
}

bool UdpSender::send(std::string_view bytes) const {
    return ::send(socket_, bytes.data(), bytes.size(), 0) == static_cast<ssize_t>(bytes.size());
}

} // namespace isochron::test_support
