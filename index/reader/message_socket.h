// Messages of any length over a socket, with a descriptor where one belongs to them.
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
    Descriptor attached; ///< or none
};

class MessageSocket {
  public:
    /// @param socket one end of a pair of streams
    explicit MessageSocket(Descriptor socket) : socket_(std::move(socket)) {}

    /// Two ends that are connected to each other. @throws Error
    static std::pair<Descriptor, Descriptor> pair();

    /// @param attached travels with the message; negative: none
    /// @return false when nobody is at the other end
    bool send(std::span<const std::byte> bytes, int attached = -1);

    /// Called while nothing comes, each time `kAwait` has passed; it may throw.
    using Waiting = std::function<void()>;
    static constexpr std::chrono::milliseconds kAwait{100};
    /// @param waiting empty: waits as long as it takes
    /// @return none when nobody is at the other end any more
    /// @throws Error when a message claims to be longer than any is
    std::optional<Message> receive(const Waiting& waiting = {});

  private:
    /// @return false when the other end is gone before all of `into` has come
    bool fill(std::span<std::byte> into, Descriptor& attached, const Waiting& waiting);

    Descriptor socket_;
};

} // namespace isochron::index
