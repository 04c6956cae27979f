// A client of the control socket: sends requests, and waits for their answers.
#pragma once

#include "app/control/control_address.h"
#include "app/control/control_request.h"

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

class ControlClient {
  public:
    /// Says hello, with the token where one is needed. @param token_file empty: the listener's own
    /// @param patience for the answer to that, which no session takes long to give
    /// @throws interaction::Error when nobody listens or answers, or the token is refused
    explicit ControlClient(const ControlAddress& address,
                           const std::filesystem::path& token_file = {},
                           std::chrono::milliseconds patience = std::chrono::seconds(5));

    /// A line of JSON, without its end, and the bytes behind it.
    struct Answer {
        std::string line;
        std::vector<std::byte> bytes;
    };
    /// @throws interaction::Error: the request is refused, with the words of the refusal; the
    /// session has ended
    Answer ask(const ControlRequest& request);
    /// The next line, an answer or an event; empty: the session has ended.
    std::optional<Answer> next();
    void send(const ControlRequest& request);
    /// Waits until there is something to receive, or so long. @return whether there is
    bool waits_for_more(int milliseconds) const;

  private:
    bool receive();
    Answer next_answer();
    ControlSocket socket_;
    std::string received_;
};

} // namespace isochron::app
