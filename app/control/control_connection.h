// One client of the control socket: bytes that were received and not read yet, and answers that
// were not sent yet. Both have a limit.
#pragma once

#include "app/control/control_address.h"
#include "app/control/control_answers.h"
#include "interaction/pose.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>

namespace isochron::app {

inline constexpr std::size_t kMostUnsent = 256 * 1024; ///< [byte] of lines; then nothing is read
inline constexpr std::size_t kMostBehind = 16 << 20;   ///< [byte] behind lines; likewise
/// [byte] of cells and meshes that clients have not read; then no more are searched for
inline constexpr std::size_t kMostHeld = 64 << 20;
inline constexpr std::size_t kMostUnanswered = 1024; ///< requests of a client; likewise
/// Requests that a client gets answered; more wait.
inline constexpr double kMostRequestsASecond = 20'000;
inline constexpr double kMostAtOnce = 2'000; ///< requests, after a pause

/// How many requests a client may make now: some at once after a pause, and then at a rate.
class RequestRate {
  public:
    /// @param now of any steady clock @return false: none until `wait` has passed
    bool take(interaction::Seconds now);
    /// Until there is room for the next one.
    interaction::Seconds wait() const;

  private:
    double left_ = kMostAtOnce;
    std::optional<interaction::Seconds> before_;
};

/// What a client waits for.
struct Unanswered {
    enum class For { frame, picture_now, picture_final, search };
    For what = For::frame;
    std::uint64_t number = 0; ///< number of the request at the desk
    std::string id;           ///< id of the request, as JSON
};

/// Not thread-safe. Sockets are never waited for.
class ControlConnection {
  public:
    /// @param trusted no token is asked for
    ControlConnection(std::uint64_t name, ControlSocket socket, bool trusted,
                      interaction::Seconds now);

    std::uint64_t name() const { return name_; }
    int descriptor() const { return socket_.get(); }
    bool is_over() const {
        return over_ || (ends_ && unsent_.empty() && waits.empty() && !has_line());
    }
    /// Whether the client's next request may be answered: it has read most answers so far.
    bool has_room() const {
        return !over_ && unsent_bytes_ < kMostUnsent && unsent_behind_ < kMostBehind &&
               waits.size() < kMostUnanswered;
    }
    /// Bytes of cells and meshes that are kept to be sent to this client.
    std::size_t held() const { return held_; }
    /// Whether more bytes may be received.
    bool may_read() const { return has_room() && !ends_ && !has_line(); }
    bool wants_to_write() const { return !unsent_.empty(); }

    /// Takes what has come, up to one piece.
    void receive();
    /// The next whole line, without its end; empty: none is there. A line that is too long ends the
    /// connection with an answer.
    std::optional<std::string> next_line();
    bool has_line() const { return received_.find('\n', read_) != std::string::npos; }
    void send(ControlAnswer answer);
    /// Whether events may be added: a client that reads too slowly misses some.
    bool keeps_up() const { return unsent_bytes_ < kMostUnsent / 4; }
    /// Writes what the socket takes. @param now of the clock that counts in `took`
    void flush(interaction::Seconds now);
    /// Ends the connection once all answers are sent. Requests that were received and not read are
    /// dropped.
    void finish();
    void drop() { over_ = true; }

    bool trusted = false;          ///< the client has said the token, or needs none
    bool seated = true;            ///< false: it is only told that there is no seat for it
    interaction::Seconds since{0}; ///< when it connected
    interaction::Seconds took{0};  ///< when it last took something of what it is sent, or had all
    RequestRate rate;
    std::deque<Unanswered> waits;
    std::array<bool, kControlTopicNames.size()> told_of{};
    double events_a_second = 0; ///< most
    interaction::Seconds next_event{0};
    std::shared_ptr<const ShownFrame> told; ///< the newest frame that it was told of; null: none

  private:
    std::uint64_t name_;
    ControlSocket socket_;
    std::string received_; ///< bytes before `read_` are done with
    std::size_t read_ = 0;
    std::deque<ControlAnswer> unsent_;
    std::size_t unsent_bytes_ = 0;  ///< bytes of the lines
    std::size_t unsent_behind_ = 0; ///< bytes behind them
    std::size_t held_ = 0;          ///< bytes among those that no other client is sent
    std::size_t sent_ = 0;          ///< bytes sent of the first answer, line and bytes together
    bool ends_ = false, over_ = false;
};

} // namespace isochron::app
