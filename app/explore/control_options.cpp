// Opens the control socket of a session.
#include "app/explore/control_options.h"

#include "app/telling.h"

#include <utility>

namespace isochron::app {

void add_control_option(Command& command, std::optional<std::string>& control) {
    command.option(
        "--control [SOCKET]", control,
        "Open a socket through which your programs steer the session: `isochron tell`, or "
        "isochron.connect() in Python. SOCKET is a path, or 127.0.0.1:PORT, which asks for a "
        "token (default: control.sock in the user's runtime folder)");
}

void check_control(const std::optional<std::string>& control) {
    if (control)
        expect_place_for_socket(control_address(*control));
}

std::unique_ptr<SessionControl> opened_control(const std::optional<std::string>& control,
                                               const Session& session,
                                               ControlServerOptions options) {
    if (!control)
        return nullptr;
    auto opened =
        std::make_unique<SessionControl>(control_address(*control), session, std::move(options));
    print_note("control socket: {}", opened->where());
    return opened;
}

} // namespace isochron::app
