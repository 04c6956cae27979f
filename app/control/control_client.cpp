// A client of the control socket.
#include "app/control/control_client.h"

#include "interaction/error.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>

#include <poll.h>
#include <sys/socket.h>

namespace isochron::app {
namespace {

[[noreturn]] void fail_ended() {
    throw interaction::Error("control socket: the session has ended the connection");
}

std::string token_in(const std::filesystem::path& path) {
    std::ifstream file(path);
    std::string token;
    if (!std::getline(file, token))
        throw interaction::Error(
            fmt::format("{}: no token can be read there; --token-file names it", path.string()));
    return token;
}

} // namespace

ControlClient::ControlClient(const ControlAddress& address, const std::filesystem::path& token_file,
                             std::chrono::milliseconds patience)
    : socket_(connect_to(address)) {
    ControlRequest hello{.verb = ControlVerb::hello};
    if (address.is_tcp())
        hello.token = token_in(token_file.empty() ? control_token_file(address.port) : token_file);
    send(hello);
    if (!waits_for_more(static_cast<int>(patience.count())))
        throw interaction::Error(
            fmt::format("control socket: no answer within {} ms: the session hangs, or has as many "
                        "clients as it takes",
                        patience.count()));
    next_answer();
}

void ControlClient::send(const ControlRequest& request) {
    const std::string line = line_of(request) + '\n';
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

bool ControlClient::receive() {
    std::array<char, 64 * 1024> piece;
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
    return next_answer();
}

ControlClient::Answer ControlClient::next_answer() {
    for (;;) {
        auto answer = next();
        if (!answer)
            fail_ended();
        const auto line = nlohmann::json::parse(answer->line, nullptr, false);
        if (!line.is_object() || line.contains("event"))
            continue;
        if (!line.value("ok", false))
            throw interaction::Error(line.value("error", std::string("refused")));
        return std::move(*answer);
    }
}

} // namespace isochron::app
