// Asks web servers: a module with libcurl, which is loaded when the first link is opened.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace isochron::index {

struct HttpRequest {
    std::string address;
    std::vector<std::string> headers; ///< `Range: bytes=0-7`
    int wanted = 206;       ///< the status whose body is wanted: others end with their head
    std::uint64_t most = 0; ///< bytes of the body; more end the request
    std::chrono::milliseconds after{0};         ///< asks so much later
    std::chrono::milliseconds patience{60'000}; ///< the server may send nothing for so long
};

struct HttpAnswer {
    int status = 0;                                          ///< 0: none came
    std::vector<std::pair<std::string, std::string>> fields; ///< fields of the head; names in lower case
    std::string body;
    std::string failure;   ///< why there is no whole answer; empty: there is one
    bool may_pass = false; ///< the failure may be over soon

    /// A field of the head; empty: it has none.
    const std::string& field(const std::string& name) const {
        static const std::string none;
        for (const auto& [called, value] : fields)
            if (called == name)
                return value;
        return none;
    }
};

/// Thread-safe.
class HttpTransport {
  public:
    virtual ~HttpTransport() = default;
    /// @param done is called once, on the thread of the transport, where it must not wait
    virtual void send(HttpRequest request, std::function<void(HttpAnswer)> done) = 0;
};

/// What the module has, under the name `isochron_links_module`.
struct LinksModule {
    /// One for the process, which keeps connections open.
    std::shared_ptr<HttpTransport> (*transport)();
};

/// The module's. @throws Error: it is not there
std::shared_ptr<HttpTransport> http_transport();

} // namespace isochron::index
