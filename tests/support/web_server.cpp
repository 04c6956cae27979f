// A web server of one test.
#include "tests/support/web_server.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <stdexcept>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace isochron::test_support {
namespace {

Asked asked_by(const std::string& head) {
    Asked asked;
    asked.path = head.substr(head.find(' ') + 1);
    asked.path.resize(asked.path.find(' '));
    for (std::size_t at = head.find("\r\n"); at != head.npos && at + 4 <= head.size();
         at = head.find("\r\n", at + 2)) {
        const std::string line = head.substr(at + 2, head.find("\r\n", at + 2) - at - 2);
        const std::size_t colon = line.find(": ");
        if (colon == line.npos)
            continue;
        std::string name = line.substr(0, colon);
        std::ranges::transform(name, name.begin(),
                               [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
        asked.headers[name] = line.substr(colon + 2);
    }
    std::string ranges = asked.header("range");
    for (std::size_t at = ranges.find('='); at != ranges.npos; at = ranges.find(',', at + 1)) {
        char* end = nullptr;
        const std::size_t first = std::strtoull(ranges.c_str() + at + 1, &end, 10);
        asked.ranges.emplace_back(first, std::strtoull(end + 1, nullptr, 10));
    }
    return asked;
}

} // namespace

WebServer::WebServer(std::function<std::string(const Asked&)> answer)
    : answer_(std::move(answer)), listener_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in where{};
    where.sin_family = AF_INET;
    where.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t length = sizeof where;
    if (bind(listener_, reinterpret_cast<sockaddr*>(&where), length) != 0 ||
        listen(listener_, 64) != 0 ||
        getsockname(listener_, reinterpret_cast<sockaddr*>(&where), &length) != 0)
        throw std::runtime_error("no server can be made");
    port_ = ntohs(where.sin_port);
    accepting_ = std::thread([this] {
        for (pollfd ready{listener_, POLLIN, 0}; !ends_; poll(&ready, 1, 50))
            if (ready.revents != 0)
                if (const int connection = accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
                    connection >= 0)
                    connections_.emplace_back([this, connection] { serve(connection); });
    });
}

WebServer::~WebServer() {
    ends_ = true;
    accepting_.join();
    for (std::thread& connection : connections_)
        connection.join();
    close(listener_);
}

std::string WebServer::address() const {
    return "http://127.0.0.1:" + std::to_string(port_) + "/";
}

void WebServer::serve(int connection) const {
    const int on = 1;
    setsockopt(connection, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    std::string head;
    for (bool open = true; open && !ends_;) {
        pollfd ready{connection, POLLIN, 0};
        if (poll(&ready, 1, 50) == 0)
            continue;
        char block[4096];
        const ssize_t count = read(connection, block, sizeof block);
        if (count <= 0)
            break;
        head.append(block, static_cast<std::size_t>(count));
        const std::size_t end = head.find("\r\n\r\n");
        if (end == head.npos)
            continue;
        std::string answer = answer_(asked_by(head.substr(0, end + 2)));
        head.erase(0, end + 4);
        if (answer.ends_with(kCut)) {
            answer.resize(answer.size() - kCut.size());
            open = false;
        }
        for (std::size_t done = 0; done < answer.size();) {
            const ssize_t sent =
                send(connection, answer.data() + done, answer.size() - done, MSG_NOSIGNAL);
            if (sent <= 0) {
                open = false;
                break;
            }
            done += static_cast<std::size_t>(sent);
        }
    }
    close(connection);
}

} // namespace isochron::test_support
