// Listens for clients that steer a session from outside, on a thread of its own.
#pragma once

#include "app/control/control_address.h"
#include "app/control/control_connection.h"
#include "app/control/control_desk.h"
#include "app/frame/asker.h"
#include "stereo/context/wake.h"

#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace isochron::app {

struct ControlServerOptions {
    bool only_watches = false; ///< answers `state`, `subscribe` and `picture` alone
    /// Time of a steady clock, for tests; null: the system's.
    std::function<interaction::Seconds()> clock = {};
    std::size_t most_held = kMostHeld;
};

class ControlServer {
  public:
    static constexpr std::size_t kMostClients = 16;
    static constexpr std::size_t kMostTurnedAway = 16;    ///< clients without a seat, at a time
    static constexpr interaction::Seconds kTurnedAway{1}; ///< then such a client is closed
    /// A client that takes nothing of what it is sent for so long, while others wait for it, is closed.
    static constexpr interaction::Seconds kTakesNothing{20};
    static constexpr std::ptrdiff_t kMostSearches = 8;      ///< that wait, of each client
    static constexpr interaction::Seconds kTokenWithin{10}; ///< else the connection is closed

    /// @param desk has shown a first frame; outlives the server, which is woken through it
    /// @throws interaction::Error when nothing can listen at the address
    ControlServer(ControlAddress address, ControlDesk& desk, ControlServerOptions options);
    /// Ends all connections. Removes the socket, and the token's file.
    ~ControlServer();
    ControlServer(const ControlServer&) = delete;
    ControlServer& operator=(const ControlServer&) = delete;

    /// The path, or `127.0.0.1:PORT, token in FILE`.
    std::string where() const;
    const ControlAddress& address() const { return address_; }
    std::size_t clients() const { return clients_; }
    /// Removes the socket, and the token's file: nobody new can connect.
    void withdraw() const;

  private:
    using Connection = ControlConnection;
    /// A search, for whom it is, and what it is asked of.
    struct Search {
        std::uint64_t client = 0;
        std::string id; ///< id of the request, as JSON
        ControlRequest request;
        std::shared_ptr<const index::IndexFile> file;
        std::shared_ptr<const ExplorerState> shown;
    };
    struct Found {
        std::uint64_t client = 0;
        ControlAnswer answer;
    };
    static Found found_by(const Search& search, const Asking& asking);
    static Found not_found(const Search& search, const std::string& why, bool canceled);
    void run();
    void wait_for_something();
    void accept_clients();
    void read_requests(Connection& client);
    void obey(Connection& client, const std::string& line);
    void answer(Connection& client, const ControlRequest& request, const std::string& id);
    void begin_search();
    Connection* client_called(std::uint64_t name) const; ///< null: it is gone
    std::size_t seated() const;
    void add_search(Connection& client, const ControlRequest& request, const std::string& id);
    void tell_frames();
    void answer_waiting(Connection& client, const ShownFrame& shown);
    ControlAnswer picture_for(const std::string& id);
    void tell_events(Connection& client, const std::shared_ptr<const ShownFrame>& shown);
    void take_found();

    ControlAddress address_;
    ControlDesk& desk_;
    const ControlServerOptions options_;
    std::string token_;
    ControlSocket listener_;
    const stereo::Wake wake_;
    std::vector<std::unique_ptr<Connection>> connections_;
    std::uint64_t named_ = 0;                       ///< connections so far
    std::shared_ptr<const ControlPicture> picture_; ///< the newest, and its bytes once asked for
    std::shared_ptr<const std::vector<std::byte>> picture_bytes_;
    bool delayed_ = false; ///< requests are there that are read when there is room
    interaction::Seconds next_look_{0};
    std::atomic<std::size_t> clients_{0};
    std::atomic<bool> ends_{false};
    std::deque<Search> to_search_;
    bool searching_ = false; ///< one of them
    Asker<Search, Found> searches_{found_by, not_found};
    std::jthread thread_; ///< last: begins when all else is there
};

} // namespace isochron::app
