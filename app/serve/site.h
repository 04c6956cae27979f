// What a site answers: the page, and the files that it was given, by ranges of their bytes.
#pragma once

#include "app/serve/range_request.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace isochron::app {

/// One of the page's own files.
struct PageFile {
    std::string_view name; ///< as in addresses: `assets/index.js`
    std::span<const std::byte> bytes;
};
/// The page, which `app/web` builds.
std::span<const PageFile> page_files();
/// What a browser is told of a file with this name.
std::string_view media_type(std::string_view name);

/// A file as it is served at the moment.
struct ServedFile {
    std::uint64_t bytes = 0; ///< what lies behind them is not served
    std::string tag;         ///< another content does not have it
};

/// What a site is made of.
struct SiteParts {
    std::vector<std::filesystem::path> files; ///< indices, served under their names without folders
    std::string token{};                      ///< that files and list need; empty: none
    /// Hosts that a request may name; empty: any. It keeps pages of other sites from asking through a
    /// browser under a name of theirs.
    std::vector<std::string> hosts{};
    /// Files that grow, as what was written whole last. Null: files are as they are.
    std::function<std::optional<ServedFile>(const std::filesystem::path&)> written{};
    std::filesystem::path story{}; ///< told on the first of the files; empty: none
};

/// A request, as far as a site looks at it.
struct SiteRequest {
    std::string_view method, path;
    /// A header's value; empty where there is none. Names are in lower case.
    std::function<std::string_view(std::string_view name)> header;
};

/// An answer: its body is text, bytes of the page, or ranges of a file.
struct SiteAnswer {
    unsigned status = 200;
    std::vector<std::pair<std::string, std::string>> headers{};
    std::string text{};
    std::span<const std::byte> bytes{};
    /// Pieces of the body in their order: words of a multipart answer, then bytes of the file.
    struct Piece {
        std::string words;
        ByteRange range;
    };
    std::filesystem::path file{};
    std::vector<Piece> pieces{};
    std::uint64_t length = 0; ///< bytes of the body
};

/// Thread-safe: asking changes nothing.
class Site {
  public:
    /// @throws index::Error: a file or the story is not there, or two have the same name
    explicit Site(SiteParts parts);

    SiteAnswer answer(const SiteRequest& request) const;
    /// The list of files, `site.json`.
    std::string list() const;

  private:
    std::optional<ServedFile> now(const std::filesystem::path& path) const;
    SiteAnswer of_file(const SiteRequest& request, const std::filesystem::path& path) const;

    SiteParts parts_;
    std::map<std::string, std::filesystem::path, std::less<>> files_; ///< by name
};

} // namespace isochron::app
