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
    /// @param patience for what no session takes long to give: the answer to that, and later a sign
    ///   of life. A session that shows no frame to whoever waits for one gets as long again as `kFrames`
    /// @throws interaction::Error when nobody listens or answers, or somebody else does, or the token
    ///   is refused
    explicit ControlClient(const ControlAddress& address,
                           const std::filesystem::path& token_file = {},
                           std::chrono::milliseconds patience = std::chrono::seconds(5));

    /// A line of JSON, without its end, and the bytes behind it.
    struct Answer {
        std::string line;
        std::vector<std::byte> bytes;
    };
    /// @throws interaction::Error: the request is refused, with the words of the refusal; the
    /// session has ended, or hangs
    Answer ask(const ControlRequest& request);
    /// The next line, an answer or an event; empty: the session has ended.
    std::optional<Answer> next();
    void send(const ControlRequest& request, const std::string& id = {});
    /// Waits until there is something to receive, or so long. @return whether there is
    bool waits_for_more(int milliseconds) const;

    /// How long a session may take that lives and shows no frame, though one is waited for.
    static constexpr std::chrono::seconds kFrames{60};

  private:
    bool receive();
    Answer next_answer(bool of_a_frame);
    ControlSocket socket_;
    std::chrono::milliseconds patience_;
    std::string received_;
};

} // namespace isochron::app
