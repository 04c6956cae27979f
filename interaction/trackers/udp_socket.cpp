// Receives UDP datagrams without ever waiting for one.
#include "interaction/trackers/udp_socket.h"

#include "interaction/error.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <ctime>
#include <deque>
#include <memory>

#include <arpa/inet.h>
#include <linux/filter.h>
#include <linux/sock_diag.h>
#include <netdb.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <fmt/format.h>

namespace isochron::interaction {
namespace {

[[noreturn]] void fail(const Endpoint& endpoint, const std::string& what) {
    throw Error("udp {}: {}", to_string(endpoint), what);
}

using Addresses = std::unique_ptr<addrinfo, decltype(&freeaddrinfo)>;

/// Numeric addresses only: a name could resolve to an unintended interface, and resolving may take
/// long.
Addresses resolve(const std::string& address, int port) {
    addrinfo hints{};
    hints.ai_family = AF_UNSPEC;
    hints.ai_socktype = SOCK_DGRAM;
    hints.ai_flags = AI_NUMERICHOST | AI_NUMERICSERV | AI_PASSIVE;
    addrinfo* found = nullptr;
    const int status = getaddrinfo(address.c_str(), std::to_string(port).c_str(), &hints, &found);
    return {status == 0 ? found : nullptr, &freeaddrinfo};
}

int port_of(const sockaddr_storage& address) {
    return ntohs(address.ss_family == AF_INET6
                     ? reinterpret_cast<const sockaddr_in6&>(address).sin6_port
                     : reinterpret_cast<const sockaddr_in&>(address).sin_port);
}

int bound_port(int socket) {
    sockaddr_storage address{};
    socklen_t length = sizeof address;
    if (getsockname(socket, reinterpret_cast<sockaddr*>(&address), &length) != 0)
        return 0;
    return port_of(address);
}

Endpoint endpoint_of(const sockaddr_storage& address) {
    char text[INET6_ADDRSTRLEN] = "";
    const void* number = &reinterpret_cast<const sockaddr_in&>(address).sin_addr;
    if (address.ss_family == AF_INET6)
        number = &reinterpret_cast<const sockaddr_in6&>(address).sin6_addr;
    inet_ntop(address.ss_family, number, text, sizeof text);
    return {text, port_of(address)};
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

/// A program of the kernel that passes what comes from this address and port. Not connect(), which
/// also binds a socket that listens on all addresses to one, so that broadcasts are lost.
std::vector<sock_filter> filter_for(const sockaddr& sender) {
    constexpr std::uint32_t kAll = 0xffffffff;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> words; // where they are, and their values
    std::uint16_t port = 0;
    if (sender.sa_family == AF_INET6) {
        const auto& v6 = reinterpret_cast<const sockaddr_in6&>(sender);
        port = ntohs(v6.sin6_port);
        for (std::uint32_t i = 0; i < 4; ++i) {
            std::uint32_t word = 0;
            std::memcpy(&word, v6.sin6_addr.s6_addr + 4 * i, sizeof word);
            words.emplace_back(8 + 4 * i, ntohl(word));
        }
    } else {
        const auto& v4 = reinterpret_cast<const sockaddr_in&>(sender);
        port = ntohs(v4.sin_port);
        words.emplace_back(12, ntohl(v4.sin_addr.s_addr));
    }
    std::vector<sock_filter> code;
    const auto expect = [&](std::uint32_t value) {
        code.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, value, 1, 0));
        code.push_back(BPF_STMT(BPF_RET | BPF_K, 0));
    };
    code.push_back(BPF_STMT(BPF_LD | BPF_H | BPF_ABS, 0)); // the sender's port in UDP's header
    expect(port);
    for (const auto& [at, value] : words) { // the sender's address in IP's header
        code.push_back(
            BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(SKF_NET_OFF) + at));
        expect(value);
    }
    code.push_back(BPF_STMT(BPF_RET | BPF_K, kAll));
    return code;
}

} // namespace

std::string to_string(const Endpoint& endpoint) {
    const bool v6 = endpoint.address.find(':') != std::string::npos;
    return fmt::format("{}{}{}:{}", v6 ? "[" : "", endpoint.address, v6 ? "]" : "", endpoint.port);
}

bool is_address(const std::string& text) {
    return resolve(text, 0) != nullptr;
}

std::optional<Endpoint> endpoint_from(const std::string& text) {
    std::string address = text, port = "0";
    const std::size_t colon = text.rfind(':');
    // Text with more than one colon is an IPv6 address, in brackets if a port follows.
    if (text.starts_with('[') ? text.find("]:") + 1 == colon : text.find(':') == colon) {
        address = text.substr(0, colon);
        port = colon == std::string::npos ? "0" : text.substr(colon + 1);
    }
    if (address.starts_with('[')) {
        if (!address.ends_with(']'))
            return std::nullopt;
        address = address.substr(1, address.size() - 2);
    }
    int number = 0;
    const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), number);
    const bool whole = error == std::errc() && end == port.data() + port.size();
    if (!whole || number < 0 || number > 65535)
        return std::nullopt;
    const Addresses found =
        address.empty() ? Addresses(nullptr, &freeaddrinfo) : resolve(address, number);
    if (!found)
        return std::nullopt;
    // Returns the address in the spelling that `endpoint_of` gives for senders.
    sockaddr_storage canonical{};
    std::memcpy(&canonical, found->ai_addr, found->ai_addrlen);
    return endpoint_of(canonical);
}

UdpSocket::UdpSocket(const Endpoint& endpoint, DatagramAges ages)
    : endpoint_(endpoint), buffer_(kLongest, '\0') {
    const Addresses address = resolve(endpoint.address, endpoint.port);
    if (!address)
        fail(endpoint, "expected a numeric IPv4 or IPv6 address of this machine");
    socket_ = ::socket(address->ai_family, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    if (socket_ < 0)
        fail(endpoint, std::strerror(errno));
    const int on = 1;
    // Without time stamps a datagram counts as just received.
    if (ages == DatagramAges::measured)
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
    // As much as the system gives: room for what comes while the reading thread has no processor.
    const int wanted = 4 << 20;
    setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &wanted, sizeof wanted);
    wake_ = eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
}

UdpSocket::~UdpSocket() {
    close(socket_);
    if (wake_ >= 0)
        close(wake_);
}

void UdpSocket::wait() const {
    std::array<pollfd, 2> ready{{{socket_, POLLIN, 0}, {wake_, POLLIN, 0}}};
    poll(ready.data(), ready.size(), -1);
}

bool UdpSocket::is_filling() const {
    std::array<std::uint32_t, SK_MEMINFO_VARS> memory{};
    socklen_t size = sizeof memory;
    return getsockopt(socket_, SOL_SOCKET, SO_MEMINFO, memory.data(), &size) != 0 ||
           memory[SK_MEMINFO_RMEM_ALLOC] > memory[SK_MEMINFO_RCVBUF] / 8;
}

void UdpSocket::wake() const {
    const std::uint64_t one = 1;
    [[maybe_unused]] const auto written = write(wake_, &one, sizeof one);
}

bool UdpSocket::hear_only(const std::optional<Endpoint>& sender) {
    if (!sender) {
        const int ignored = 0;
        return setsockopt(socket_, SOL_SOCKET, SO_DETACH_FILTER, &ignored, sizeof ignored) == 0;
    }
    const Addresses address = resolve(sender->address, sender->port);
    if (!address)
        return false;
    std::vector<sock_filter> code = filter_for(*address->ai_addr);
    const sock_fprog program{static_cast<unsigned short>(code.size()), code.data()};
    return setsockopt(socket_, SOL_SOCKET, SO_ATTACH_FILTER, &program, sizeof program) == 0;
}

void UdpSocket::drain() {
    // The limit ends the loop even if a sender never pauses.
    constexpr std::size_t kMostDrained = 1 << 20;
    for (std::size_t drained = 0; drained < kMostDrained; ++drained)
        if (recv(socket_, buffer_.data(), buffer_.size(), 0) < 0)
            break;
}

std::vector<Datagram> UdpSocket::take(std::size_t kept, const Admission& admits) {
    std::deque<Datagram> newest;
    const Seconds now = wall_clock();
    for (std::size_t taken = 0; taken < kMostTaken; ++taken) {
        alignas(cmsghdr) char control[CMSG_SPACE(sizeof(timespec))];
        iovec bytes{buffer_.data(), buffer_.size()};
        sockaddr_storage sender{};
        msghdr message{};
        message.msg_name = &sender;
        message.msg_namelen = sizeof sender;
        message.msg_iov = &bytes;
        message.msg_iovlen = 1;
        message.msg_control = control;
        message.msg_controllen = sizeof control;
        const ssize_t length = recvmsg(socket_, &message, 0);
        if (length < 0)
            break; // nothing is waiting, or an error that concerns one datagram only
        // The wall clock may have been set meanwhile, so the age is limited to 0 to 1 s.
        const Seconds age =
            std::clamp(now - arrival(message).value_or(now), Seconds(0), Seconds(1));
        const Endpoint from = endpoint_of(sender);
        if (!admits(from, age))
            continue;
        if (message.msg_flags & MSG_TRUNC) {
            ++thrown_away_;
            continue;
        }
        newest.push_back({buffer_.substr(0, static_cast<std::size_t>(length)), age, from});
        if (newest.size() > kept) {
            newest.pop_front();
            ++thrown_away_;
        }
    }
    return {std::make_move_iterator(newest.begin()), std::make_move_iterator(newest.end())};
}

} // namespace isochron::interaction
