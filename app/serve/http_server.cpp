// Serves a site by libmicrohttpd: two threads, bounded requests; an idle server waits.
#include "app/serve/http_server.h"

#include "index/error.h"
#include "index/system/new_file.h"

#include <fmt/format.h>
#include <microhttpd.h>

#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <netinet/in.h>
#include <optional>
#include <sys/socket.h>
#include <unistd.h>

namespace isochron::app {
namespace {

constexpr unsigned kThreads = 2, kMostClients = 512, kSecondsIdle = 60;
constexpr std::size_t kMostHead = 32 << 10; ///< [byte] of a request
constexpr std::size_t kBlock = 256 << 10;   ///< [byte] that are sent at a time

/// The body of an answer, piece by piece.
class Body {
  public:
    /// @return null if the file cannot be opened
    static std::unique_ptr<Body> open(SiteAnswer answer) {
        const int file = ::open(answer.file.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY);
        return file < 0 ? nullptr : std::unique_ptr<Body>(new Body(std::move(answer), file));
    }
    ~Body() { close(file_); }
    Body(const Body&) = delete;
    Body& operator=(const Body&) = delete;

    /// @return number of bytes, or a code of libmicrohttpd
    ssize_t read(char* out, std::size_t most) {
        while (piece_ < answer_.pieces.size()) {
            const SiteAnswer::Piece& piece = answer_.pieces[piece_];
            const std::uint64_t words = piece.words.size();
            const std::uint64_t bytes = piece.range.end - piece.range.begin;
            if (within_ < words) {
                const std::size_t count = std::min<std::size_t>(most, words - within_);
                std::memcpy(out, piece.words.data() + within_, count);
                within_ += count;
                return static_cast<ssize_t>(count);
            }
            if (within_ < words + bytes) {
                const std::uint64_t done = within_ - words;
                const auto count = pread(file_, out, std::min<std::uint64_t>(most, bytes - done),
                                         static_cast<off_t>(piece.range.begin + done));
                if (count <=
                    0) // the file became shorter: the answer ends, and the client sees that
                    return MHD_CONTENT_READER_END_WITH_ERROR;
                within_ += static_cast<std::uint64_t>(count);
                return count;
            }
            ++piece_;
            within_ = 0;
        }
        return MHD_CONTENT_READER_END_OF_STREAM;
    }

  private:
    Body(SiteAnswer answer, int file) : answer_(std::move(answer)), file_(file) {}
    SiteAnswer answer_;
    int file_;
    std::size_t piece_ = 0;
    std::uint64_t within_ = 0;
};

ssize_t read_body(void* body, std::uint64_t, char* out, std::size_t most) {
    return static_cast<Body*>(body)->read(out, most);
}
void end_body(void* body) {
    delete static_cast<Body*>(body);
}

MHD_Response* response_of(SiteAnswer& answer) {
    const auto body = [](const void* bytes, std::size_t count, MHD_ResponseMemoryMode mode) {
        return MHD_create_response_from_buffer(count, const_cast<void*>(bytes), mode);
    };
    if (!answer.bytes.empty())
        return body(answer.bytes.data(), answer.bytes.size(), MHD_RESPMEM_PERSISTENT);
    if (answer.pieces.empty())
        return body(answer.text.data(), answer.text.size(), MHD_RESPMEM_MUST_COPY);
    auto opened = Body::open(answer);
    if (!opened) {
        answer.status = 404;
        return body("", 0, MHD_RESPMEM_PERSISTENT);
    }
    return MHD_create_response_from_callback(answer.length, kBlock, read_body, opened.release(),
                                             end_body);
}

MHD_Result answer_request(void* site, MHD_Connection* connection, const char* path,
                          const char* method, const char*, const char*, std::size_t* upload,
                          void** known) {
    static int begun;
    if (!*known) { // the body of a request, which nobody wants, comes later
        *known = &begun;
        return MHD_YES;
    }
    if (*upload > 0) {
        *upload = 0;
        return MHD_YES;
    }
    const SiteRequest request{
        method, path, [connection](std::string_view name) -> std::string_view {
            const char* const value =
                MHD_lookup_connection_value(connection, MHD_HEADER_KIND, std::string(name).c_str());
            return value ? value : "";
        }};
    SiteAnswer answer = static_cast<const Site*>(site)->answer(request);
    MHD_Response* const response = response_of(answer);
    if (!response)
        return MHD_NO;
    for (const auto& [name, value] : answer.headers)
        MHD_add_response_header(response, name.c_str(), value.c_str());
    const MHD_Result queued = MHD_queue_response(connection, answer.status, response);
    MHD_destroy_response(response);
    return queued;
}

/// libmicrohttpd decodes addresses before it gives them; the site does that itself.
std::size_t keep_encoded(void*, MHD_Connection*, char* text) {
    return std::strlen(text);
}

class Server final : public HttpServer {
  public:
    Server(SiteParts parts, const HttpPlace& place) {
        sockaddr_storage where{};
        auto* const v4 = reinterpret_cast<sockaddr_in*>(&where);
        auto* const v6 = reinterpret_cast<sockaddr_in6*>(&where);
        const bool is_v6 = place.address.find(':') != std::string::npos;
        where.ss_family = is_v6 ? AF_INET6 : AF_INET;
        if (inet_pton(where.ss_family, place.address.c_str(),
                      is_v6 ? static_cast<void*>(&v6->sin6_addr) : &v4->sin_addr) != 1)
            throw index::Error("--address {}: expected an address of this machine, as 127.0.0.1 or "
                               "0.0.0.0 for all",
                               place.address);
        listener_ = socket(where.ss_family, SOCK_STREAM | SOCK_CLOEXEC, 0);
        const int yes = 1;
        setsockopt(listener_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
        (is_v6 ? v6->sin6_port : v4->sin_port) = htons(place.port);
        const socklen_t length = is_v6 ? sizeof *v6 : sizeof *v4;
        if (listener_ < 0 || bind(listener_, reinterpret_cast<sockaddr*>(&where), length) != 0 ||
            listen(listener_, 128) != 0)
            refuse(fmt::format("{} port {}", place.address, place.port));
        socklen_t got = sizeof where;
        getsockname(listener_, reinterpret_cast<sockaddr*>(&where), &got);
        port_ = ntohs(is_v6 ? v6->sin6_port : v4->sin_port);
        const bool secure = !place.certificate.empty();
        // Names under which this server is asked. One that is open to others is asked under any.
        if (place.address == "127.0.0.1" || place.address == "::1")
            for (const char* name : {"127.0.0.1", "localhost", "[::1]"}) {
                parts.hosts.push_back(fmt::format("{}:{}", name, port_));
                if (port_ == (secure ? 443 : 80)) // which browsers leave out
                    parts.hosts.emplace_back(name);
            }
        site_.emplace(std::move(parts));
        errno = 0;
        if (secure && MHD_is_feature_supported(MHD_FEATURE_TLS) != MHD_YES)
            refuse("--certificate: this libmicrohttpd has no TLS");
        // Copies: libmicrohttpd reads them as long as it runs.
        certificate_ = place.certificate;
        key_ = place.key;
        const std::array<MHD_OptionItem, 3> of_tls{
            {{MHD_OPTION_HTTPS_MEM_CERT, 0, certificate_.data()},
             {MHD_OPTION_HTTPS_MEM_KEY, 0, key_.data()},
             {MHD_OPTION_END, 0, nullptr}}};
        const MHD_OptionItem none{MHD_OPTION_END, 0, nullptr};
        daemon_ = MHD_start_daemon(
            MHD_USE_EPOLL_INTERNAL_THREAD | (secure ? MHD_USE_TLS : 0u), 0, nullptr, nullptr,
            answer_request, &*site_, MHD_OPTION_LISTEN_SOCKET, listener_,
            MHD_OPTION_THREAD_POOL_SIZE, kThreads, MHD_OPTION_CONNECTION_LIMIT, kMostClients,
            MHD_OPTION_CONNECTION_TIMEOUT, kSecondsIdle, MHD_OPTION_CONNECTION_MEMORY_LIMIT,
            kMostHead, MHD_OPTION_ARRAY, secure ? of_tls.data() : &none,
            MHD_OPTION_UNESCAPE_CALLBACK, keep_encoded, nullptr, MHD_OPTION_END);
        if (!daemon_)
            refuse(secure ? "--certificate, --key: no certificate with its key in PEM"
                          : place.address);
    }
    ~Server() override {
        if (daemon_)
            MHD_stop_daemon(daemon_); // closes the listener, too
    }
    std::uint16_t port() const override { return port_; }

  private:
    [[noreturn]] void refuse(const std::string& where) {
        const int error = errno;
        if (listener_ >= 0)
            close(listener_);
        throw index::Error(
            error == 0 ? where
                       : fmt::format("{}: cannot serve there: {}", where, std::strerror(error)));
    }

    std::string certificate_, key_;
    std::optional<Site> site_;
    MHD_Daemon* daemon_ = nullptr;
    int listener_ = -1;
    std::uint16_t port_ = 0;
};

void write_page(const std::filesystem::path& folder, SiteParts parts) {
    const auto write = [](const std::filesystem::path& path, std::span<const std::byte> bytes) {
        index::write_file(path, bytes);
    };
    std::filesystem::create_directories(folder / "assets");
    for (const PageFile& file : page_files())
        write(folder / file.name, file.bytes);
    const std::string list = Site(std::move(parts)).list();
    write(folder / "site.json", std::as_bytes(std::span(list)));
}

} // namespace

extern "C" __attribute__((visibility("default"))) const SiteModule isochron_site_module{
    [](SiteParts parts, const HttpPlace& place) -> std::unique_ptr<HttpServer> {
        return std::make_unique<Server>(std::move(parts), place);
    },
    write_page, qr_code};

} // namespace isochron::app
