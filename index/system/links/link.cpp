// Takes links apart, and remembers their tokens.
#include "index/system/links/link.h"

#include "index/error.h"
#include "index/lower_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <mutex>

namespace isochron::index {
namespace {

int digit_of(char c) {
    return c >= '0' && c <= '9'                     ? c - '0'
           : (c | 0x20) >= 'a' && (c | 0x20) <= 'f' ? (c | 0x20) - 'a' + 10
                                                    : -1;
}

/// A text as forms have it: %XX is a byte, + is a space.
std::string of_form(std::string_view text) {
    std::string plain;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const int high = i + 2 < text.size() && text[i] == '%' ? digit_of(text[i + 1]) : -1;
        const int low = high >= 0 ? digit_of(text[i + 2]) : -1;
        if (low >= 0) {
            plain += static_cast<char>(high * 16 + low);
            i += 2;
        } else {
            plain += text[i] == '+' ? ' ' : text[i];
        }
    }
    return plain;
}

/// What is in front of the path, and the host within it.
std::string_view origin_of(std::string_view address) {
    const std::size_t host = address.find("://") + 3;
    return address.substr(0, address.find_first_of("/?#", host));
}
std::string_view host_of(std::string_view address) {
    std::string_view host = origin_of(address);
    host.remove_prefix(host.find("://") + 3);
    const std::size_t port = host.rfind(':');
    return port != host.npos && host.find(']', port) == host.npos ? host.substr(0, port) : host;
}
/// With its last slash.
std::string folder_of(std::string_view address) {
    const std::string_view origin = origin_of(address);
    const std::string_view path = address.substr(0, address.find_first_of("?#"));
    const std::size_t slash = path.rfind('/');
    return slash == path.npos || slash < origin.size() ? std::string(origin) + "/"
                                                       : std::string(path.substr(0, slash + 1));
}

bool is_token(std::string_view text) {
    return text.size() <= 4096 &&
           std::ranges::all_of(text, [](char c) { return c > ' ' && c <= '~'; });
}

struct KnownLinks {
    std::mutex mutex;
    std::map<std::string, std::string> tokens; ///< by folder
    std::map<std::string, std::map<std::string, std::string>> settings;
    std::atomic<WhileWaitingForLink> waiting = nullptr;
    std::atomic<std::int64_t> patience = 0; ///< [ms]; 0: as usual
};

KnownLinks& known_links() {
    static KnownLinks links;
    return links;
}

} // namespace

bool is_link(std::string_view name) {
    constexpr std::string_view kSafe = "https://";
    const std::string scheme = lower_case(name.substr(0, kSafe.size()));
    return scheme.starts_with("http://") || scheme == kSafe;
}

bool is_plain_name(std::string_view name) {
    return !name.empty() && name.front() != '.' && name.size() <= 255 &&
           name.find_first_of("/\\:?#") == name.npos &&
           std::ranges::none_of(name, [](char c) { return c >= 0 && c < ' '; });
}

std::string beside(const std::string& address, std::string_view name) {
    std::string made = folder_of(address);
    for (const char c : name)
        if (std::isalnum(static_cast<unsigned char>(c)) ||
            std::string_view("-_.~").find(c) != std::string_view::npos)
            made += c;
        else
            made += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    return made;
}

std::string address_of(std::string_view name) {
    if (!is_link(name))
        return std::string(name);
    std::string address(name.substr(0, name.find('#')));
    if (origin_of(address).find('@') != std::string_view::npos)
        throw Error("{}//...: a link with a user's name or password is not opened: expected the "
                    "environment variable ISOCHRON_AUTHORIZATION=\"HOST Basic ...\"",
                    address.substr(0, address.find('/')));
    std::map<std::string, std::string> settings;
    std::string token;
    std::string_view rest = name.substr(std::min(name.size(), address.size() + 1));
    while (!rest.empty()) {
        const std::string_view word = rest.substr(0, rest.find('&'));
        rest.remove_prefix(std::min(rest.size(), word.size() + 1));
        const std::size_t equals = word.find('=');
        if (equals == word.npos)
            continue;
        const std::string key = of_form(word.substr(0, equals)),
                          value = of_form(word.substr(equals + 1));
        if (key == "token")
            token = value;
        else if (key == "file" && is_plain_name(value))
            address = beside(address, value);
        else
            settings[key] = value;
    }
    if (!is_token(token))
        throw Error("{}: the token behind # is none: expected the link as it was printed", address);
    KnownLinks& links = known_links();
    const std::lock_guard lock(links.mutex);
    if (!token.empty())
        links.tokens[folder_of(address)] = token;
    if (!settings.empty())
        links.settings[address] = settings;
    return address;
}

std::map<std::string, std::string> settings_of_link(const std::string& address) {
    KnownLinks& links = known_links();
    const std::lock_guard lock(links.mutex);
    const auto found = links.settings.find(address);
    return found == links.settings.end() ? std::map<std::string, std::string>() : found->second;
}

std::string authorization_for(const std::string& address) {
    KnownLinks& links = known_links();
    {
        const std::lock_guard lock(links.mutex);
        if (const auto found = links.tokens.find(folder_of(address)); found != links.tokens.end())
            return "Bearer " + found->second;
    }
    const char* const set = std::getenv("ISOCHRON_AUTHORIZATION");
    const std::string_view text = set ? set : "";
    const std::size_t space = text.find(' ');
    if (space == text.npos || text.substr(0, space) != host_of(address))
        return {};
    const std::string_view value = text.substr(space + 1);
    return std::ranges::all_of(value, [](char c) { return c >= ' ' && c <= '~'; })
               ? std::string(value)
               : "";
}

std::string host_of_link(const std::string& address) {
    return std::string(host_of(address));
}

std::string absolute_name(const std::string& name) {
    return is_link(name) ? name : std::filesystem::absolute(name).string();
}

std::chrono::milliseconds link_patience() {
    constexpr std::chrono::milliseconds kUsual{60'000};
    if (const std::int64_t set = known_links().patience; set > 0)
        return std::chrono::milliseconds(set);
    const char* const set = std::getenv("ISOCHRON_LINK_PATIENCE");
    const double seconds = set ? std::strtod(set, nullptr) : 0;
    return seconds >= 1 && seconds <= 86400
               ? std::chrono::milliseconds(static_cast<std::int64_t>(seconds * 1000))
               : kUsual;
}

void set_link_patience(std::chrono::milliseconds patience) {
    known_links().patience = patience.count();
}

void call_while_waiting_for_links(WhileWaitingForLink waiting) {
    known_links().waiting = waiting;
}

WhileWaitingForLink while_waiting_for_links() {
    return known_links().waiting;
}

} // namespace isochron::index
