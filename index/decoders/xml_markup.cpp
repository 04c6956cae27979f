// The depth of elements, by their tags alone.
#include "index/decoders/xml_markup.h"

#include "index/error.h"

#include <fmt/format.h>

#include <algorithm>

namespace isochron::index {
namespace {

constexpr int kDeepest = 64; ///< in image data and collections it is below ten

/// Behind the next `end` from `at` on.
std::size_t behind(std::string_view markup, std::string_view end, std::size_t at) {
    const std::size_t found = markup.find(end, at);
    return found == markup.npos ? markup.size() : found + end.size();
}

/// Behind the tag that starts before `at`. Quoted values may hold its end.
std::size_t behind_tag(std::string_view markup, std::size_t at) {
    while ((at = markup.find_first_of("\"'>", at)) != markup.npos) {
        if (markup[at] == '>')
            return at + 1;
        at = behind(markup, markup.substr(at, 1), at + 1);
    }
    return markup.size();
}

} // namespace

void expect_shallow(std::string_view markup, const std::string& file) {
    int depth = 0;
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
            if (rest.starts_with("</"))
                depth = std::max(0, depth - 1);
            else if (!markup.substr(at, end - at).ends_with("/>"))
                ++depth;
            if (depth > kDeepest)
                throw Error(fmt::format("{}: elements nested more than {} deep, at byte {}", file,
                                        kDeepest, at));
            at = end;
        }
    }
}

} // namespace isochron::index
