// A client of the control socket.
#include "app/control/control_client.h"

#include "interaction/error.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <utility>

#include <poll.h>
#include <sys/socket.h>

namespace isochron::app {
namespace {

constexpr const char* kSignOfLife = "sign of life"; ///< id of requests for it

[[noreturn]] void fail_silent(std::chrono::milliseconds patience) {
    throw interaction::Error("control socket: no answer within {} ms: the session hangs",
                             patience.count());
}

[[noreturn]] void fail_ended() {
    throw interaction::Error("control socket: the session has ended the connection");
}

std::string token_in(const std::filesystem::path& path) {
    std::ifstream file(path);
    std::string token;
    if (!std::getline(file, token))
        throw interaction::Error("{}: no token can be read there; --token-file names it",
                                 path.string());
    return token;
}

} // namespace

ControlClient::ControlClient(const ControlAddress& address, const std::filesystem::path& token_file,
                             std::chrono::milliseconds patience)
    : socket_(connect_to(address)), patience_(patience) {
    if (!address.is_tcp() && !is_of_this_user(socket_.get()))
        throw interaction::Error("{}: a program of another user listens there",
                                 address.path.string());
    ControlRequest hello{.verb = ControlVerb::hello};
    if (address.is_tcp())
        hello.token = token_in(token_file.empty() ? control_token_file(address.port) : token_file);
    send(hello);
    if (!waits_for_more(static_cast<int>(patience.count())))
        fail_silent(patience);
    next_answer(false);
}

void ControlClient::send(const ControlRequest& request, const std::string& id) {
    const std::string line =
        line_of(request, id.empty() ? "null" : nlohmann::json(id).dump()) + '\n';
    for (std::size_t sent = 0; sent < line.size();) {
        const ssize_t count =
            ::send(socket_.get(), line.data() + sent, line.size() - sent, MSG_NOSIGNAL);
        if (count < 0 && errno == EINTR)
            continue;
        if (count < 0)
            fail_ended();
        sent += static_cast<std::size_t>(count);
    }
}

bool ControlClient::waits_for_more(int milliseconds) const {
    pollfd socket{socket_.get(), POLLIN, 0};
    return received_.find('\n') != std::string::npos || poll(&socket, 1, milliseconds) > 0;
}

/// Within a line or the bytes behind it.
bool ControlClient::receive() {
    std::array<char, 64 * 1024> piece;
    pollfd socket{socket_.get(), POLLIN, 0};
    if (poll(&socket, 1, static_cast<int>(patience_.count())) == 0)
        fail_silent(patience_);
    ssize_t count = 0;
    do
        count = recv(socket_.get(), piece.data(), piece.size(), 0);
    while (count < 0 && errno == EINTR);
    if (count <= 0)
        return false;
    received_.append(piece.data(), static_cast<std::size_t>(count));
    return true;
}

std::optional<ControlClient::Answer> ControlClient::next() {
    std::size_t end = 0;
    while ((end = received_.find('\n')) == std::string::npos)
        if (!receive())
            return std::nullopt;
    Answer answer{.line = received_.substr(0, end), .bytes = {}};
    received_.erase(0, end + 1);
    const auto line = nlohmann::json::parse(answer.line, nullptr, false);
    const std::size_t bytes = line.is_object() ? line.value("bytes", std::size_t{0}) : 0;
    while (received_.size() < bytes)
        if (!receive())
            fail_ended();
    answer.bytes.resize(bytes);
    if (bytes > 0)
        std::memcpy(answer.bytes.data(), received_.data(), bytes);
    received_.erase(0, bytes);
    return answer;
}

ControlClient::Answer ControlClient::ask(const ControlRequest& request) {
    send(request);
    return next_answer(request.verb == ControlVerb::commands ||
                       request.verb == ControlVerb::picture);
}

/// Asks for a sign of life whenever nothing has come for as long as `patience_`.
/// @param of_a_frame the session is to show frames until it answers
ControlClient::Answer ControlClient::next_answer(bool of_a_frame) {
    using Clock = std::chrono::steady_clock;
    bool asked = false; // for a sign that has not come
    std::uint64_t frame = 0;
    Clock::time_point shown = Clock::now();
    for (;;) {
        if (!waits_for_more(static_cast<int>(patience_.count()))) {
            if (std::exchange(asked, true))
                fail_silent(patience_);
            send({.verb = ControlVerb::state}, kSignOfLife);
            continue;
        }
        auto answer = next();
        if (!answer)
            fail_ended();
        const auto line = nlohmann::json::parse(answer->line, nullptr, false);
        if (!line.is_object() || line.contains("event"))
            continue;
        if (line.value("id", nlohmann::json()) == kSignOfLife) {
            asked = false;
            const Clock::time_point now = Clock::now();
            if (std::exchange(frame, line.value("frame", std::uint64_t{0})) != frame)
                shown = now;
            if (of_a_frame && now - shown > kFrames)
                throw interaction::Error(
                    "control socket: the session lives, but has shown no frame for {} s",
                    kFrames.count());
            continue;
        }
        if (!line.value("ok", false))
            throw interaction::Error(line.value("error", std::string("refused")));
        return std::move(*answer);
    }
}

} // namespace isochron::app
