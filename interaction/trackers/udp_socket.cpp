// Datagrams from the network, without ever waiting for one.
#include "interaction/trackers/udp_socket.h"

#include "interaction/error.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <deque>
#include <memory>
#include <optional>

#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <fmt/format.h>

namespace isochron::interaction {
namespace {

[[noreturn]] void fail(const Endpoint& endpoint, const std::string& what) {
    throw Error(fmt::format("udp {}: {}", to_string(endpoint), what));
}

using Addresses = std::unique_ptr<addrinfo, decltype(&freeaddrinfo)>;

/// Numeric addresses only: a name could stand for an interface that nobody meant, and asking for it
/// may take long.
Addresses resolve(const std::string& address, int port) {
    addrinfo hints{};
    hints.ai_family = AF_UNSPEC;
    hints.ai_socktype = SOCK_DGRAM;
    hints.ai_flags = AI_NUMERICHOST | AI_NUMERICSERV | AI_PASSIVE;
    addrinfo* found = nullptr;
    const int status = getaddrinfo(address.c_str(), std::to_string(port).c_str(), &hints, &found);
    return {status == 0 ? found : nullptr, &freeaddrinfo};
}

int bound_port(int socket) {
    sockaddr_storage address{};
    socklen_t length = sizeof address;
    if (getsockname(socket, reinterpret_cast<sockaddr*>(&address), &length) != 0)
        return 0;
    return ntohs(address.ss_family == AF_INET6
                     ? reinterpret_cast<const sockaddr_in6&>(address).sin6_port
                     : reinterpret_cast<const sockaddr_in&>(address).sin_port);
}

/// When the kernel received a datagram, by the wall clock.
std::optional<Seconds> arrival(msghdr& message) {
    for (cmsghdr* control = CMSG_FIRSTHDR(&message); control;
         control = CMSG_NXTHDR(&message, control))
        if (control->cmsg_level == SOL_SOCKET && control->cmsg_type == SO_TIMESTAMPNS) {
            timespec stamp;
            std::memcpy(&stamp, CMSG_DATA(control), sizeof stamp);
            return Seconds(static_cast<double>(stamp.tv_sec)) +
                   Seconds(1e-9 * static_cast<double>(stamp.tv_nsec));
        }
    return std::nullopt;
}

Seconds wall_clock() {
    timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    return Seconds(static_cast<double>(now.tv_sec)) +
           Seconds(1e-9 * static_cast<double>(now.tv_nsec));
}

} // namespace

std::string to_string(const Endpoint& endpoint) {
    const bool v6 = endpoint.address.find(':') != std::string::npos;
    return fmt::format("{}{}{}:{}", v6 ? "[" : "", endpoint.address, v6 ? "]" : "", endpoint.port);
}

bool is_address(const std::string& text) {
    return resolve(text, 0) != nullptr;
}

UdpSocket::UdpSocket(const Endpoint& endpoint) : endpoint_(endpoint), buffer_(kLongest, '\0') {
    const Addresses address = resolve(endpoint.address, endpoint.port);
    if (!address)
        fail(endpoint, "expected a numeric IPv4 or IPv6 address of this machine");
    socket_ = ::socket(address->ai_family, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    if (socket_ < 0)
        fail(endpoint, std::strerror(errno));
    const int on = 1;
    // Without time stamps a datagram counts as just received.
    setsockopt(socket_, SOL_SOCKET, SO_TIMESTAMPNS, &on, sizeof on);
    // An IPv6 address stands for IPv6 alone.
    if (address->ai_family == AF_INET6)
        setsockopt(socket_, IPPROTO_IPV6, IPV6_V6ONLY, &on, sizeof on);
    if (bind(socket_, address->ai_addr, address->ai_addrlen) != 0) {
        const std::string reason = std::strerror(errno);
        close(socket_);
        fail(endpoint, reason);
    }
    endpoint_.port = bound_port(socket_);
}

UdpSocket::~UdpSocket() {
    close(socket_);
}

std::vector<Datagram> UdpSocket::take(std::size_t kept) {
    std::deque<Datagram> newest;
    const Seconds now = wall_clock();
    for (std::size_t taken = 0; taken < kMostTaken; ++taken) {
        alignas(cmsghdr) char control[CMSG_SPACE(sizeof(timespec))];
        iovec bytes{buffer_.data(), buffer_.size()};
        msghdr message{};
        message.msg_iov = &bytes;
        message.msg_iovlen = 1;
        message.msg_control = control;
        message.msg_controllen = sizeof control;
        const ssize_t length = recvmsg(socket_, &message, 0);
        if (length < 0)
            break; // nothing is waiting, or an error that concerns one datagram only
        if (message.msg_flags & MSG_TRUNC) {
            ++thrown_away_;
            continue;
        }
        // The wall clock may have been set meanwhile: a wait has a sensible length.
        const Seconds age = now - arrival(message).value_or(now);
        newest.push_back({buffer_.substr(0, static_cast<std::size_t>(length)),
                          std::clamp(age, Seconds(0), Seconds(1))});
        if (newest.size() > kept) {
            newest.pop_front();
            ++thrown_away_;
        }
    }
    return {std::make_move_iterator(newest.begin()), std::make_move_iterator(newest.end())};
}

} // namespace isochron::interaction
