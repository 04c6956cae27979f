// Checks the depth of elements by their tags only.
#include "index/readers/decoders/vtk/xml_markup.h"

#include "index/error.h"
#include "index/readers/formats/named_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace isochron::index {
namespace {

constexpr int kDeepest = 64; ///< image data and collections have fewer than ten levels

/// The position after the next `end` from `at` on.
std::size_t behind(std::string_view markup, std::string_view end, std::size_t at) {
    const std::size_t found = markup.find(end, at);
    return found == markup.npos ? markup.size() : found + end.size();
}

/// The position after the tag that starts before `at`. Quoted values may contain `>`.
std::size_t behind_tag(std::string_view markup, std::size_t at) {
    while ((at = markup.find_first_of("\"'>", at)) != markup.npos) {
        if (markup[at] == '>')
            return at + 1;
        at = behind(markup, markup.substr(at, 1), at + 1);
    }
    return markup.size();
}

} // namespace

std::string_view markup_of(const MappedFile& file) {
    const std::string_view all(reinterpret_cast<const char*>(file.bytes().data()),
                               file.bytes().size());
    return all.substr(0, std::min(all.find("<AppendedData"), all.size()));
}

void expect_end(const MappedFile& file, const std::string& name) {
    constexpr std::size_t kTail = 4096; // some writers leave blanks or a comment after it
    const std::span<const std::byte> bytes = file.bytes();
    const std::span<const std::byte> tail = bytes.last(std::min(bytes.size(), kTail));
    if (std::string_view(reinterpret_cast<const char*>(tail.data()), tail.size())
            .find("</VTKFile") == std::string_view::npos)
        throw Error("{}: truncated: it does not end with </VTKFile>", name);
}

void expect_names(std::string_view markup, const std::string& file) {
    constexpr std::string_view kArray = "<DataArray";
    const auto has_name = [](std::string_view tag) {
        for (std::size_t at = tag.find("Name"); at != tag.npos; at = tag.find("Name", at + 1)) {
            const std::size_t end = tag.find_first_not_of(" \t\r\n", at + 4);
            if (std::isspace(static_cast<unsigned char>(tag[at - 1])) != 0 && end != tag.npos &&
                tag[end] == '=')
                return true;
        }
        return false;
    };
    // Arrays of positions are told by their places.
    const auto among_positions = [&](std::size_t at) {
        const std::string_view before = markup.substr(0, at);
        return std::ranges::any_of(std::array{"Coordinates", "Points"}, [&](const char* element) {
            const std::size_t begin = before.rfind(fmt::format("<{}", element));
            const std::size_t end = before.rfind(fmt::format("</{}", element));
            return begin != before.npos && (end == before.npos || end < begin);
        });
    };
    for (std::size_t at = markup.find(kArray); at != markup.npos; at = markup.find(kArray, at)) {
        const std::size_t end = behind_tag(markup, at);
        if (!has_name(markup.substr(at, end - at)) && !among_positions(at))
            throw Error("{}: cannot be read: an array at byte {} has no Name", file, at);
        at = end;
    }
}

std::optional<std::string> with_slashes(std::string_view markup,
                                        const std::filesystem::path& file) {
    if (markup.find('\\') == markup.npos)
        return std::nullopt;
    std::string text(markup);
    bool changed = false;
    for_each_tag(markup, [&](Tag tag) {
        for (const std::string_view key : {" Source=", " file="}) {
            const std::size_t quote = tag.text.find(key) + key.size();
            if (quote < key.size() || quote >= tag.text.size())
                continue;
            const std::size_t end = tag.text.find(tag.text[quote], quote + 1);
            const std::string named(tag.text.substr(quote + 1, end - quote - 1));
            const std::string with = path_named_in(file, named);
            changed = changed || with != named;
            text.replace(tag.at + quote + 1, named.size(), with);
        }
    });
    return changed ? std::optional(text) : std::nullopt;
}

void for_each_tag(std::string_view markup, const std::function<void(Tag)>& visit) {
    std::size_t at = 0;
    while ((at = markup.find('<', at)) != markup.npos) {
        const std::string_view rest = markup.substr(at);
        if (rest.starts_with("<!--")) {
            at = behind(markup, "-->", at);
        } else if (rest.starts_with("<![CDATA[")) {
            at = behind(markup, "]]>", at);
        } else if (rest.starts_with("<?") || rest.starts_with("<!")) {
            at = behind(markup, ">", at);
        } else {
            const std::size_t end = behind_tag(markup, at);
            visit({at, markup.substr(at, end - at)});
            at = end;
        }
    }
}

void expect_shallow(std::string_view markup, const std::string& file) {
    int depth = 0;
    for_each_tag(markup, [&](Tag tag) {
        if (tag.text.starts_with("</"))
            depth = std::max(0, depth - 1);
        else if (!tag.text.ends_with("/>"))
            ++depth;
        if (depth > kDeepest)
            throw Error("{}: elements nested more than {} deep, at byte {}", file, kDeepest,
                        tag.at);
    });
}

} // namespace isochron::index
