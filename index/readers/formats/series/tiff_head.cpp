// Looks into TIFF files without their library.
#include "index/readers/formats/series/tiff_head.h"

#include "index/readers/formats/data_stream.h"
#include "index/readers/formats/named_file.h"
#include "index/system/input_file.h"

#include <algorithm>
#include <cstdint>
#include <set>
#include <string>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;

/// The header and the description of a TIFF file, of either byte order and size.
class TiffHead {
  public:
    explicit TiffHead(const fs::path& path) : file_(path) {}

    /// @return none: it cannot be told
    std::optional<bool> flat() {
        if (!find_first_page())
            return std::nullopt;
        constexpr std::uint64_t kMetaMorphPlanes = 33629; // they follow the page
        if (number(first_ + entries_ * entry_bytes(), wide_ ? 8 : 4) != 0 ||
            entry_of(kMetaMorphPlanes))
            return false;
        return !describes_more(description(1 << 16));
    }

    /// Description of the first page.
    std::string description(std::uint64_t most) {
        if (!find_first_page())
            return {};
        constexpr std::uint64_t kImageDescription = 270;
        const auto entry = entry_of(kImageDescription);
        if (!entry)
            return {};
        const std::uint64_t count = number(*entry + 4, wide_ ? 8 : 4);
        const std::uint64_t inside = wide_ ? 8 : 4, value = *entry + (wide_ ? 12 : 8);
        return text_at(count <= inside ? value : number(value, inside), std::min(count, most));
    }

  private:
    std::optional<std::uint64_t> entry_of(std::uint64_t tag) {
        for (std::uint64_t i = 0; i < entries_; ++i)
            if (const std::uint64_t entry = first_ + i * entry_bytes(); number(entry, 2) == tag)
                return entry;
        return std::nullopt;
    }

    std::uint64_t entry_bytes() const { return wide_ ? 20 : 12; }

    bool find_first_page() {
        const std::uint64_t order = number(0, 2);
        big_ = order == 0x4d4d;
        const std::uint64_t kind = number(2, 2);
        if ((order != 0x4949 && !big_) || (kind != 42 && kind != 43))
            return false;
        wide_ = kind == 43; // BigTIFF
        const std::uint64_t at = wide_ ? number(8, 8) : number(4, 4);
        entries_ = number(at, wide_ ? 8 : 2);
        first_ = at + (wide_ ? 8 : 2);
        return at != 0 && at <= file_.size() && entries_ <= 4096;
    }

    static bool describes_more(const std::string& text) {
        const std::size_t images = text.find("images=");
        return (text.starts_with("ImageJ=") && images != std::string::npos &&
                text.compare(images, 9, "images=1\n") != 0) ||
               text.find("<TiffData") != std::string::npos;
    }

    std::string text_at(std::uint64_t at, std::uint64_t size) {
        std::string text(at > file_.size() ? 0 : std::min(size, file_.size() - at), '\0');
        file_.read(at, std::as_writable_bytes(std::span(text)));
        return text;
    }
    std::uint64_t number(std::uint64_t at, std::uint64_t size) {
        const std::string bytes = text_at(at, size);
        std::uint64_t value = 0;
        for (std::size_t i = 0; i < bytes.size(); ++i)
            value |= std::uint64_t{static_cast<unsigned char>(bytes[i])}
                     << 8 * (big_ ? bytes.size() - 1 - i : i);
        return value;
    }

    InputFile file_;
    bool big_ = false, wide_ = false;
    /// Offset and number of entries of the first page's directory.
    std::uint64_t first_ = 0, entries_ = 0;
};

/// The values of an attribute, wherever it stands in the text.
std::set<std::string> attributes_in(const std::string& text, const std::string& name) {
    std::set<std::string> values;
    const std::string begin = name + "=\"";
    for (std::size_t at = text.find(begin); at != text.npos; at = text.find(begin, at)) {
        at += begin.size();
        values.insert(text.substr(at, text.find('"', at) - at));
    }
    return values;
}

} // namespace

std::optional<bool> is_flat_tiff(const fs::path& path) {
    return TiffHead(path).flat();
}

std::vector<fs::path> not_named_by_others(const std::vector<fs::path>& files) {
    constexpr std::uint64_t kMost = 64 << 20;
    std::set<fs::path> named;
    std::vector<fs::path> wholes;
    for (const fs::path& file : files) {
        if (named.contains(file))
            continue;
        wholes.push_back(file);
        std::string said = TiffHead(file).description(kMost);
        // The text of several files may stand in one beside them.
        for (const std::string& beside : attributes_in(said, "MetadataFile")) {
            std::error_code ignored;
            const fs::path path =
                file.parent_path() / fs::path(path_named_in(file, beside)).filename();
            if (path.extension() == ".ome" && fs::is_regular_file(path, ignored))
                said = read_text(path, kMost);
        }
        if (said.find("<OME") == said.npos)
            continue;
        for (const std::string& other : attributes_in(said, "FileName"))
            if (const fs::path path =
                    file.parent_path() / fs::path(path_named_in(file, other)).filename();
                path != file)
                named.insert(path);
    }
    // The one that names the others need not be the first.
    std::erase_if(wholes, [&](const fs::path& file) { return named.contains(file); });
    return wholes.empty() ? files : wholes;
}

} // namespace isochron::index
