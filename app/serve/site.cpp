// Answers requests for the page and for files.
#include "app/serve/site.h"

#include "index/error.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <sys/stat.h>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;

SiteAnswer words(unsigned status, std::string text) {
    SiteAnswer answer{.status = status,
                      .headers = {{"Content-Type", "text/plain; charset=utf-8"}},
                      .text = std::move(text)};
    answer.length = answer.text.size();
    return answer;
}

/// The percent signs of an address as what they stand for; nothing where they stand for nothing.
std::optional<std::string> decoded(std::string_view path) {
    std::string text;
    for (std::size_t i = 0; i < path.size(); ++i) {
        if (path[i] != '%') {
            text += path[i];
            continue;
        }
        if (i + 2 >= path.size() || !std::isxdigit(static_cast<unsigned char>(path[i + 1])) ||
            !std::isxdigit(static_cast<unsigned char>(path[i + 2])))
            return std::nullopt;
        text += static_cast<char>(std::stoi(std::string(path.substr(i + 1, 2)), nullptr, 16));
        i += 2;
    }
    return text;
}

/// Whether two texts are equal, in a time that does not say where they differ.
bool same_secret(std::string_view a, std::string_view b) {
    unsigned char differ = a.size() == b.size() ? 0 : 1;
    for (std::size_t i = 0; i < a.size(); ++i)
        differ |= static_cast<unsigned char>(a[i] ^ (b.empty() ? '\0' : b[i % b.size()]));
    return differ == 0;
}

std::optional<ServedFile> file_now(const fs::path& path) {
    struct stat found {};
    if (stat(path.c_str(), &found) != 0 || !S_ISREG(found.st_mode))
        return std::nullopt;
    return ServedFile{static_cast<std::uint64_t>(found.st_size),
                      fmt::format("\"{:x}-{:x}-{:x}{:09}\"", found.st_ino, found.st_size,
                                  found.st_mtim.tv_sec, found.st_mtim.tv_nsec)};
}

} // namespace

std::string_view media_type(std::string_view name) {
    constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kTypes{
        {{".html", "text/html; charset=utf-8"},
         {".txt", "text/plain; charset=utf-8"},
         {".js", "text/javascript; charset=utf-8"},
         {".css", "text/css; charset=utf-8"},
         {".wasm", "application/wasm"},
         {".json", "application/json"}}};
    for (const auto& [ending, type] : kTypes)
        if (name.ends_with(ending))
            return type;
    return "application/octet-stream";
}

Site::Site(SiteParts parts) : parts_(std::move(parts)) {
    std::vector<fs::path> all = parts_.files;
    if (!parts_.story.empty())
        all.push_back(parts_.story);
    for (const fs::path& file : all) {
        if (!file_now(file))
            throw index::Error("{}: there is no such file", file.string());
        const std::string name = file.filename().string();
        if (!files_.emplace(name, file).second)
            throw index::Error("{} and {}: two files with the same name cannot be served together",
                               files_[name].string(), file.string());
    }
}

std::string Site::list() const {
    nlohmann::ordered_json names = nlohmann::ordered_json::array();
    for (const fs::path& file : parts_.files)
        names.push_back(file.filename().string());
    nlohmann::ordered_json site{{"format", "isochron site"}, {"files", names}};
    if (parts_.written)
        site["follow"] = true;
    if (!parts_.story.empty())
        site["story"] = parts_.story.filename().string();
    return site.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

SiteAnswer Site::answer(const SiteRequest& request) const {
    const std::string_view host = request.header("host");
    if (!parts_.hosts.empty() && std::ranges::find(parts_.hosts, host) == parts_.hosts.end())
        return words(403, "this server has another name\n");
    if (request.method != "GET" && request.method != "HEAD") {
        SiteAnswer refused = words(405, "only GET and HEAD\n");
        refused.headers.emplace_back("Allow", "GET, HEAD");
        return refused;
    }
    const auto path = decoded(request.path);
    if (!path || !path->starts_with('/'))
        return words(400, "not an address of this server\n");
    const std::string name = *path == "/" ? "index.html" : path->substr(1);
    for (const PageFile& file : page_files())
        if (file.name == name)
            return {.status = 200,
                    .headers = {{"Content-Type", std::string(media_type(name))},
                                {"X-Content-Type-Options", "nosniff"},
                                {"Referrer-Policy", "no-referrer"},
                                {"Cache-Control", "no-cache"}},
                    .bytes = file.bytes,
                    .length = file.bytes.size()};
    const auto found = files_.find(name);
    if (found == files_.end() && name != "site.json")
        return words(404, "no such file\n");
    if (!parts_.token.empty() &&
        !same_secret(request.header("authorization"), "Bearer " + parts_.token))
        return words(401, "the link with its token opens this server\n");
    if (found != files_.end())
        return of_file(request, found->second);
    SiteAnswer listed{
        .status = 200,
        .headers = {{"Content-Type", "application/json"}, {"Cache-Control", "no-cache"}},
        .text = list()};
    listed.length = listed.text.size();
    return listed;
}

std::optional<ServedFile> Site::now(const fs::path& path) const {
    return parts_.written ? parts_.written(path) : file_now(path);
}

SiteAnswer Site::of_file(const SiteRequest& request, const fs::path& path) const {
    const auto now = path == parts_.story ? file_now(path) : this->now(path); // a story is no index
    if (!now)
        return words(404, "the file is gone\n");
    if (const auto wanted = request.header("if-match");
        !wanted.empty() && wanted != "*" && wanted.find(now->tag) == std::string_view::npos)
        return words(412, "the file has changed\n");
    if (!request.header("if-none-match").empty() &&
        request.header("if-none-match").find(now->tag) != std::string_view::npos)
        return {.status = 304, .headers = {{"ETag", now->tag}, {"Cache-Control", "no-cache"}}};
    SiteAnswer answer{
        .headers = {{"Accept-Ranges", "bytes"}, {"ETag", now->tag}, {"Cache-Control", "no-cache"}},
        .file = path};
    const std::string type(media_type(path.filename().string()));
    const std::string_view as_known = request.header("if-range");
    auto ranges = as_known.empty() || as_known == now->tag
                      ? ranges_of(request.header("range"), now->bytes)
                      : std::nullopt;
    if (!ranges) {
        answer.headers.emplace_back("Content-Type", type);
        answer.pieces = {{"", {0, now->bytes}}};
        answer.length = now->bytes;
        return answer;
    }
    if (ranges->empty()) {
        SiteAnswer refused = words(416, "no such range\n");
        refused.headers.emplace_back("Content-Range", fmt::format("bytes */{}", now->bytes));
        return refused;
    }
    answer.status = 206;
    const auto span_of = [&](const ByteRange& range) {
        return fmt::format("bytes {}-{}/{}", range.begin, range.end - 1, now->bytes);
    };
    if (ranges->size() == 1) {
        answer.headers.emplace_back("Content-Type", type);
        answer.headers.emplace_back("Content-Range", span_of(ranges->front()));
        answer.pieces = {{"", ranges->front()}};
        answer.length = ranges->front().end - ranges->front().begin;
        return answer;
    }
    // A boundary that the file would hold by chance alone: its tag is part of it.
    std::string boundary = "isochron-" + now->tag.substr(1, now->tag.size() - 2);
    answer.headers.emplace_back("Content-Type", "multipart/byteranges; boundary=" + boundary);
    for (const ByteRange& range : *ranges)
        answer.pieces.push_back(
            {fmt::format("\r\n--{}\r\nContent-Type: {}\r\nContent-Range: {}\r\n\r\n", boundary,
                         type, span_of(range)),
             range});
    answer.pieces.push_back({fmt::format("\r\n--{}--\r\n", boundary), {}});
    for (const SiteAnswer::Piece& piece : answer.pieces)
        answer.length += piece.words.size() + piece.range.end - piece.range.begin;
    return answer;
}

} // namespace isochron::app
