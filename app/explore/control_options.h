// The option with which a session listens for clients that steer it.
#pragma once

#include "app/command_line/command_line.h"
#include "app/loop/session_control.h"

#include <memory>
#include <optional>
#include <string>

namespace isochron::app {

/// Adds `--control`. @param control lives until the command has run; set to an empty text if the
/// option was given without a value
void add_control_option(Command& command, std::optional<std::string>& control);

/// Looks at the option before anything is opened.
/// @throws interaction::Error: another machine's address, or the path of something else
void check_control(const std::optional<std::string>& control);

/// Listens as the option says, and tells on stderr where.
/// @return null if the option was not given
/// @throws UsageError, interaction::Error when nothing can listen there
std::unique_ptr<SessionControl> opened_control(const std::optional<std::string>& control,
                                               const Session& session,
                                               ControlServerOptions options = {});

} // namespace isochron::app
