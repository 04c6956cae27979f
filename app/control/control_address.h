// Where the control socket is: a path, or a port of this machine with a token.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace isochron::app {

/// A Unix socket, or TCP on the loopback device alone. There is no other address: from elsewhere
/// one comes through ssh, which knows who may.
struct ControlAddress {
    std::filesystem::path path; ///< path of the Unix socket; empty: TCP
    std::uint16_t port = 0;     ///< port of TCP on 127.0.0.1; 0 when listening: one that is free
    bool is_tcp() const { return path.empty(); }
};

/// @param text a path, `127.0.0.1:PORT` or `localhost:PORT`; empty: `default_control_path`
/// @throws interaction::Error: another host, a path that is too long for a socket
ControlAddress control_address(const std::string& text);

/// `control.sock` in $XDG_RUNTIME_DIR/isochron, else in the user's state folder.
/// @throws interaction::Error when there is neither
std::filesystem::path default_control_path();

/// The file in which a listener on this port keeps its token, which only its user can read.
std::filesystem::path control_token_file(std::uint16_t port);

/// A descriptor that is closed at its end.
class ControlSocket {
  public:
    explicit ControlSocket(int descriptor = -1) : descriptor_(descriptor) {}
    ControlSocket(ControlSocket&& other) noexcept : descriptor_(other.release()) {}
    ControlSocket& operator=(ControlSocket&& other) noexcept;
    ~ControlSocket();
    int get() const { return descriptor_; }
    int release();

  private:
    int descriptor_;
};

/// @throws interaction::Error: something that is no socket has this path
void expect_place_for_socket(const ControlAddress& address);

/// Listens, without waiting. A Unix socket is made so that only its user can connect; one that a
/// program left behind is replaced.
/// @param address gets the port that was free @throws interaction::Error
ControlSocket listen_at(ControlAddress& address);
/// @throws interaction::Error when nobody listens there
ControlSocket connect_to(const ControlAddress& address);
/// Whether the other end of a Unix socket is a process of this user, or of root.
bool is_of_this_user(int connection);

/// 32 hexadecimal digits that nobody can guess. @throws interaction::Error
std::string new_control_token();
/// Whether two tokens are equal, in a time that does not say where they differ.
bool same_token(const std::string& a, const std::string& b);

} // namespace isochron::app
