// Opens the control socket, and connects to it.
#include "app/control/control_address.h"

#include "index/system/user_folders.h"
#include "interaction/error.h"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <utility>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/random.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;

constexpr int kWaiting = 16; ///< connections that nobody has accepted yet

[[noreturn]] void fail_at(const std::string& where, const char* what) {
    throw interaction::Error("{}: {}: {}", where, what, std::strerror(errno));
}

std::string words_of(const ControlAddress& address) {
    return address.is_tcp() ? fmt::format("127.0.0.1:{}", address.port) : address.path.string();
}

sockaddr_un unix_address(const fs::path& path) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    const std::string text = path.string();
    if (text.size() >= sizeof address.sun_path)
        throw interaction::Error("{}: too long for a socket, expected at most {} bytes", text,
                                 sizeof address.sun_path - 1);
    std::memcpy(address.sun_path, text.c_str(), text.size() + 1);
    return address;
}

sockaddr_in loopback(std::uint16_t port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return address;
}

template <class Address>
const sockaddr* plain(const Address& address) {
    return reinterpret_cast<const sockaddr*>(&address);
}

ControlSocket new_socket(int family) {
    ControlSocket made(socket(family, SOCK_STREAM | SOCK_CLOEXEC, 0));
    if (made.get() < 0)
        fail_at("control socket", "socket");
    return made;
}

/// The user's folder for sockets, which is made.
fs::path control_folder() {
    std::optional<fs::path> folder;
    if (const char* runtime = std::getenv("XDG_RUNTIME_DIR"); runtime && *runtime == '/')
        folder = fs::path(runtime) / "isochron";
    else
        folder = index::user_state_folder();
    if (!folder)
        throw interaction::Error("control socket: there is no XDG_RUNTIME_DIR and no home folder; "
                                 "--control=PATH says where it is to be");
    std::error_code error;
    if (fs::create_directories(*folder, error))
        fs::permissions(*folder, fs::perms::owner_all, error);
    return *folder;
}

/// Removes a socket that nobody listens at any more. @throws interaction::Error: something else
void remove_left_socket(const fs::path& path) {
    struct stat there {};
    if (lstat(path.c_str(), &there) != 0)
        return;
    expect_place_for_socket({.path = path});
    const ControlSocket trial = new_socket(AF_UNIX);
    const sockaddr_un address = unix_address(path);
    if (connect(trial.get(), plain(address), sizeof address) == 0 || errno != ECONNREFUSED)
        throw interaction::Error(
            "{}: another program listens there; --control=PATH names another socket",
            path.string());
    unlink(path.c_str());
}

void listen_at_path(const ControlSocket& made, const fs::path& path) {
    std::error_code ignored;
    if (path.has_parent_path())
        fs::create_directories(path.parent_path(), ignored);
    remove_left_socket(path);
    const sockaddr_un address = unix_address(path);
    fchmod(made.get(), S_IRUSR | S_IWUSR); // Linux gives the file the rights of the socket
    if (bind(made.get(), plain(address), sizeof address) != 0)
        fail_at(path.string(), "cannot make a socket here");
}

void listen_at_port(const ControlSocket& made, std::uint16_t& port) {
    const int on = 1;
    setsockopt(made.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    sockaddr_in address = loopback(port);
    if (bind(made.get(), plain(address), sizeof address) != 0)
        fail_at(fmt::format("127.0.0.1:{}", port), "cannot listen here");
    socklen_t size = sizeof address;
    getsockname(made.get(), reinterpret_cast<sockaddr*>(&address), &size);
    port = ntohs(address.sin_port);
}

} // namespace

ControlSocket& ControlSocket::operator=(ControlSocket&& other) noexcept {
    if (this != &other) {
        if (descriptor_ >= 0)
            close(descriptor_);
        descriptor_ = other.release();
    }
    return *this;
}

ControlSocket::~ControlSocket() {
    if (descriptor_ >= 0)
        close(descriptor_);
}

int ControlSocket::release() {
    return std::exchange(descriptor_, -1);
}

ControlAddress control_address(const std::string& text) {
    if (text.empty())
        return {.path = default_control_path()};
    const std::size_t colon = text.rfind(':');
    if (text.find('/') != std::string::npos || colon == std::string::npos) {
        unix_address(text);
        return {.path = text};
    }
    const std::string host = text.substr(0, colon);
    const char* const first = text.data() + colon + 1;
    const char* const last = text.data() + text.size();
    ControlAddress address;
    const auto [end, error] = std::from_chars(first, last, address.port);
    if (error != std::errc() || end != last)
        throw interaction::Error("{}: expected a path with a slash, or 127.0.0.1:PORT", text);
    if (host != "127.0.0.1" && host != "localhost")
        throw interaction::Error("{}: expected 127.0.0.1 as the host: no other machine can "
                                 "connect; from elsewhere, ssh -L forwards a port or a path",
                                 text);
    return address;
}

void expect_place_for_socket(const ControlAddress& address) {
    struct stat there {};
    if (!address.is_tcp() && lstat(address.path.c_str(), &there) == 0 && !S_ISSOCK(there.st_mode))
        throw interaction::Error("{}: exists and is no socket; --control=PATH takes the path of a "
                                 "new one, and stands behind the names of data",
                                 address.path.string());
}

fs::path default_control_path() {
    return control_folder() / "control.sock";
}

fs::path control_token_file(std::uint16_t port) {
    return control_folder() / fmt::format("control-{}.token", port);
}

ControlSocket listen_at(ControlAddress& address) {
    ControlSocket made = new_socket(address.is_tcp() ? AF_INET : AF_UNIX);
    if (address.is_tcp())
        listen_at_port(made, address.port);
    else
        listen_at_path(made, address.path);
    if (listen(made.get(), kWaiting) != 0)
        fail_at(words_of(address), "cannot listen here");
    return made;
}

ControlSocket connect_to(const ControlAddress& address) {
    ControlSocket made = new_socket(address.is_tcp() ? AF_INET : AF_UNIX);
    constexpr timeval kPatience{.tv_sec = 5, .tv_usec = 0}; // where others wait to be let in
    setsockopt(made.get(), SOL_SOCKET, SO_SNDTIMEO, &kPatience, sizeof kPatience);
    int failed = 0;
    if (address.is_tcp()) {
        const sockaddr_in there = loopback(address.port);
        failed = connect(made.get(), plain(there), sizeof there);
    } else {
        const sockaddr_un there = unix_address(address.path);
        failed = connect(made.get(), plain(there), sizeof there);
    }
    if (failed != 0 && (errno == EAGAIN || errno == EINPROGRESS))
        throw interaction::Error("{}: the session hangs: it lets nobody in", words_of(address));
    if (failed != 0)
        throw interaction::Error(
            "{}: nobody listens there ({}); isochron explore --control begins a session that does",
            words_of(address), std::strerror(errno));
    return made;
}

bool is_of_this_user(int connection) {
    ucred who{};
    socklen_t size = sizeof who;
    return getsockopt(connection, SOL_SOCKET, SO_PEERCRED, &who, &size) == 0 &&
           (who.uid == geteuid() || who.uid == 0);
}

std::string new_control_token() {
    std::array<unsigned char, 16> bytes{};
    if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
        fail_at("control socket", "getrandom");
    std::string token;
    for (const unsigned char byte : bytes)
        token += fmt::format("{:02x}", byte);
    return token;
}

bool same_token(const std::string& a, const std::string& b) {
    if (a.size() != b.size())
        return false;
    unsigned different = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        different |= static_cast<unsigned>(static_cast<unsigned char>(a[i] ^ b[i]));
    return different == 0;
}

} // namespace isochron::app
