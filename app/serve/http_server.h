// A web server of a site: a module, which is loaded when one is asked for.
#pragma once

#include "app/serve/site.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

namespace isochron::app {

/// Answers until it is destroyed.
class HttpServer {
  public:
    virtual ~HttpServer() = default;
    virtual std::uint16_t port() const = 0;
};

struct HttpPlace {
    std::string address = "127.0.0.1"; ///< address of IPv4 or IPv6
    std::uint16_t port = 0;            ///< 0: any that is free
    std::string certificate, key;      ///< in PEM, both or neither: https
};

/// A QR code of a text in lines of blocks, two modules high, light where the terminal's ink is: for dark
/// terminals. Empty: it is too long, or the module was built without libqrencode.
std::string qr_code(const std::string& text);

/// What the module has, under the name `isochron_site_module`.
struct SiteModule {
    /// @param parts without hosts: those that `place` has are set
    /// @throws index::Error: the place is taken or is not of this machine; as Site does
    std::unique_ptr<HttpServer> (*serve)(SiteParts parts, const HttpPlace& place);
    /// Writes the page and a list of the site's files into an existing folder.
    /// @throws index::Error when that fails
    void (*write_page)(const std::filesystem::path& folder, SiteParts parts);
    std::string (*qr_code)(const std::string& text);
};

} // namespace isochron::app
