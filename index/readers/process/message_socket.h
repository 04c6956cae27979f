// Sends and receives messages over a socket, each with a file descriptor if it has one.
#pragma once

#include "index/system/descriptor.h"

#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace isochron::index {

struct Message {
    std::vector<std::byte> bytes;
    Descriptor attached; ///< may be none
};

class MessageSocket {
  public:
    /// @param socket one end of a pair of connected stream sockets
    explicit MessageSocket(Descriptor socket) : socket_(std::move(socket)) {}

    /// Two connected ends. @throws Error
    static std::pair<Descriptor, Descriptor> pair();

    /// @param attached descriptor to send with the message; negative: none
    /// @return false when the other end is closed
    bool send(std::span<const std::byte> bytes, int attached = -1);

    /// Called every `kAwait` while nothing arrives; it may throw.
    using Waiting = std::function<void()>;
    static constexpr std::chrono::milliseconds kAwait{100};
    /// @param waiting if empty, waits as long as it takes
    /// @return none when the other end is closed
    /// @throws Error when a message claims to be longer than messages can be
    std::optional<Message> receive(const Waiting& waiting = {});

  private:
    /// @return false when the other end closes before `into` is full
    bool fill(std::span<std::byte> into, Descriptor& attached, const Waiting& waiting);

    Descriptor socket_;
};

} // namespace isochron::index
