// Links to indices on web servers, as users give them, and what this process knows of them.
#pragma once

#include <chrono>
#include <map>
#include <string>
#include <string_view>

namespace isochron::index {

/// Whether a name is a link: it begins with http:// or https://.
bool is_link(std::string_view name);

/// What a user gives as data becomes what may be printed and kept: of a link all that is in front of `#`, with
/// the file that stands behind it as `file=NAME`. What else stands there is remembered in this process:
/// the token, which opens the server, and settings of a view. Other names stay as they are.
/// @throws Error: a link with a user's name or password, or with a token that is none
std::string address_of(std::string_view name);

/// The settings of a view that came with a link to this address: `isovalue` and others, as the page of
/// `isochron serve` writes them. Empty: none came.
std::map<std::string, std::string> settings_of_link(const std::string& address);

/// The value of the header Authorization for an address; empty: none. A token that came with a link is sent
/// to the folder that the link names; what the environment variable ISOCHRON_AUTHORIZATION has,
/// `HOST VALUE`, to that host.
std::string authorization_for(const std::string& address);

/// The host that an address names.
std::string host_of_link(const std::string& address);

/// A path that names the same file from every folder; links do.
std::string absolute_name(const std::string& name);

/// `name` beside the address, as a link to a page has it.
std::string beside(const std::string& address, std::string_view name);

/// Whether a name that a server or a link gives is one of a file beside it: no folder, no other server.
bool is_plain_name(std::string_view name);

/// How long a server may send nothing; the environment variable ISOCHRON_LINK_PATIENCE has another number of seconds.
std::chrono::milliseconds link_patience();
void set_link_patience(std::chrono::milliseconds patience);

/// Called every tenth of a second by a thread that waits for a server, and may throw to end the wait.
using WhileWaitingForLink = void (*)();
void call_while_waiting_for_links(WhileWaitingForLink waiting);
WhileWaitingForLink while_waiting_for_links();

} // namespace isochron::index
