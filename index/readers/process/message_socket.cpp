// Messages over a stream: each is its length, then its bytes.
#include "index/readers/process/message_socket.h"

#include "index/error.h"

#include <poll.h>
#include <sys/socket.h>
#include <sys/uio.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>

namespace isochron::index {
namespace {

constexpr std::uint64_t kLongest = 256 << 20; ///< room for times and names of a million files
constexpr std::size_t kPiece = 1 << 20;       ///< memory grows by pieces as bytes arrive

/// Control data with room for one descriptor.
union Beside {
    cmsghdr header;
    std::array<char, CMSG_SPACE(sizeof(int))> bytes;
};

} // namespace

std::pair<Descriptor, Descriptor> MessageSocket::pair() {
    std::array<int, 2> ends{};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
        throw Error("no pair of sockets: {}", std::strerror(errno));
    return {Descriptor(ends[0]), Descriptor(ends[1])};
}

bool MessageSocket::send(std::span<const std::byte> bytes, int attached) {
    std::uint64_t length = bytes.size();
    std::array<iovec, 2> parts{
        {{&length, sizeof length}, {const_cast<std::byte*>(bytes.data()), bytes.size()}}};
    Beside beside{};
    msghdr message{};
    message.msg_iov = parts.data();
    message.msg_iovlen = parts.size();
    if (attached >= 0) {
        message.msg_control = &beside;
        message.msg_controllen = sizeof beside;
        beside.header.cmsg_level = SOL_SOCKET;
        beside.header.cmsg_type = SCM_RIGHTS;
        beside.header.cmsg_len = CMSG_LEN(sizeof attached);
        std::memcpy(CMSG_DATA(&beside.header), &attached, sizeof attached);
    }
    while (parts[0].iov_len + parts[1].iov_len > 0) {
        // A reader's fence allows no call that could send descriptors.
        const iovec& next = parts[0].iov_len > 0 ? parts[0] : parts[1];
        const ssize_t sent =
            message.msg_control
                ? ::sendmsg(socket_.number(), &message, MSG_NOSIGNAL)
                : ::send(socket_.number(), next.iov_base, next.iov_len, MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR)
            continue;
        if (sent < 0)
            return false;
        message.msg_control = nullptr; // sent with the first byte
        message.msg_controllen = 0;
        auto gone = static_cast<std::size_t>(sent);
        for (iovec& part : parts) {
            const std::size_t of_this = std::min(gone, part.iov_len);
            part.iov_base = static_cast<std::byte*>(part.iov_base) + of_this;
            part.iov_len -= of_this;
            gone -= of_this;
        }
    }
    return true;
}

std::optional<Message> MessageSocket::receive(const Waiting& waiting) {
    Message message;
    std::uint64_t length = 0;
    if (!fill(std::as_writable_bytes(std::span(&length, 1)), message.attached, waiting))
        return std::nullopt;
    if (length > kLongest)
        throw Error("a message of {} bytes, expected at most {}", length, kLongest);
    while (message.bytes.size() < length) {
        const std::size_t had = message.bytes.size();
        message.bytes.resize(had + std::min<std::uint64_t>(kPiece, length - had));
        if (!fill(std::span(message.bytes).subspan(had), message.attached, waiting))
            return std::nullopt;
    }
    return message;
}

bool MessageSocket::fill(std::span<std::byte> into, Descriptor& attached, const Waiting& waiting) {
    while (!into.empty()) {
        pollfd ready{socket_.number(), POLLIN, 0};
        const int found = ::poll(&ready, 1, waiting ? static_cast<int>(kAwait.count()) : -1);
        if (found == 0)
            waiting();
        if (found <= 0)
            continue;
        iovec part{into.data(), into.size()};
        Beside beside{};
        msghdr message{};
        message.msg_iov = &part;
        message.msg_iovlen = 1;
        message.msg_control = &beside;
        message.msg_controllen = sizeof beside;
        const ssize_t got = ::recvmsg(socket_.number(), &message, MSG_CMSG_CLOEXEC);
        if (got < 0 && errno == EINTR)
            continue;
        if (got <= 0)
            return false;
        if (const cmsghdr* header = CMSG_FIRSTHDR(&message);
            header && header->cmsg_level == SOL_SOCKET && header->cmsg_type == SCM_RIGHTS)
            for (const unsigned char* at = CMSG_DATA(header);
                 at < reinterpret_cast<const unsigned char*>(header) + header->cmsg_len;
                 at += sizeof(int)) {
                int number = -1;
                std::memcpy(&number, at, sizeof number);
                attached = Descriptor(number); // the last, if there are several; we send one
            }
        into = into.subspan(static_cast<std::size_t>(got));
    }
    return true;
}

} // namespace isochron::index
