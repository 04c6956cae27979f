// A web server of one test, which answers as the test says.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

namespace isochron::test_support {

/// A request.
struct Asked {
    std::string path;
    std::map<std::string, std::string> headers;              ///< names in lower case
    std::vector<std::pair<std::size_t, std::size_t>> ranges; ///< first and last byte

    std::string header(const std::string& name) const {
        const auto found = headers.find(name);
        return found == headers.end() ? "" : found->second;
    }
};

/// On 127.0.0.1, with a thread for each connection.
class WebServer {
  public:
    /// At the end of an answer: the connection is cut there.
    static constexpr std::string_view kCut = "<cut here>";

    /// @param answer returns all bytes of an answer; called by several threads
    explicit WebServer(std::function<std::string(const Asked&)> answer);
    ~WebServer();
    WebServer(const WebServer&) = delete;
    WebServer& operator=(const WebServer&) = delete;

    /// `http://127.0.0.1:PORT/`
    std::string address() const;

  private:
    void serve(int connection) const;

    std::function<std::string(const Asked&)> answer_;
    int listener_ = -1;
    std::uint16_t port_ = 0;
    std::atomic<bool> ends_ = false;
    std::vector<std::thread> connections_; ///< belongs to the thread that accepts
    std::thread accepting_;
};

} // namespace isochron::test_support
