// Walks the tags of a VTK image file and leaves out what changes with its values.
#include "index/readers/formats/series/vti_header_hash.h"

#include "index/readers/formats/format.h"
#include "index/system/input_file.h"

#include <xxhash.h>

#include <algorithm>
#include <string>

namespace isochron::index {
namespace {

constexpr std::size_t kMostHead = 64 << 10;

/// What describes a file, in the order in which it stands there.
class HeadHash {
  public:
    /// @param compressed of such arrays, places and sizes differ with the values
    HeadHash(std::uint64_t size, bool compressed) : compressed_(compressed) {
        if (!compressed)
            said_ = std::to_string(size);
    }

    /// Adds a tag without its brackets, but for the attributes that follow from values.
    void add_tag(std::string_view tag) {
        std::size_t at = tag.find_first_of(" \t\r\n");
        add(tag.substr(0, at));
        while (at < tag.size() && (at = tag.find_first_not_of(" \t\r\n", at)) < tag.size()) {
            const std::size_t equals = tag.find('=', at);
            const std::size_t open =
                equals < tag.size() ? tag.find_first_of("\"'", equals) : tag.npos;
            const std::size_t close = open < tag.size() ? tag.find(tag[open], open + 1) : tag.npos;
            if (close >= tag.size())
                return add(tag.substr(at)); // such as the end of an empty element
            std::string_view name = tag.substr(at, equals - at);
            name = name.substr(0, name.find_last_not_of(" \t\r\n") + 1);
            if (name != "RangeMin" && name != "RangeMax" && !(compressed_ && name == "offset"))
                add(tag.substr(at, close + 1 - at));
            at = close + 1;
        }
    }

    void add(std::string_view said) {
        said_ += said;
        said_ += '\0';
    }

    std::uint64_t hash() const { return XXH3_64bits(said_.data(), said_.size()); }

  private:
    bool compressed_;
    std::string said_;
};

} // namespace

std::optional<std::uint64_t> vti_header_hash(std::string_view start, std::uint64_t size) {
    const std::size_t root = start.find("<VTKFile");
    if (root > 256 || start.find("<!") < start.size())
        return std::nullopt;
    const std::size_t root_end = start.find('>', root);
    if (root_end >= start.size())
        return std::nullopt;
    const std::string_view first = start.substr(root, root_end - root);
    if (first.find("\"ImageData\"") >= first.size())
        return std::nullopt;
    // Values that stand between the tags make a file longer or shorter, too.
    const bool appended = start.find("<AppendedData") < start.size();
    HeadHash head(size, first.find("compressor") < first.size() || !appended);
    bool of_array = false; ///< the text that follows is values
    bool of_norm = false;  ///< ... or their length
    for (std::size_t at = root; at < start.size();) {
        const std::size_t end = start.find('>', at);
        if (end >= start.size())
            return std::nullopt;
        const std::string_view tag = start.substr(at + 1, end - at - 1);
        if (tag.starts_with("FieldData") || tag.starts_with("TimeValue"))
            return std::nullopt; // a time may stand there
        head.add_tag(tag);
        if (tag.starts_with("AppendedData") || tag.starts_with("/VTKFile"))
            return head.hash();
        of_array = tag.starts_with("DataArray") && !tag.ends_with('/');
        if (tag.starts_with("InformationKey"))
            of_norm = tag.find("\"L2_NORM_RANGE\"") < tag.size() ||
                      tag.find("\"L2_NORM_FINITE_RANGE\"") < tag.size();
        if (tag.starts_with("/InformationKey")) {
            of_norm = false;
            of_array = true; // back in its array
        }
        at = start.find('<', end);
        const std::string_view text = start.substr(end + 1, std::min(at, start.size()) - end - 1);
        if (!of_array && !of_norm)
            head.add(text);
    }
    return std::nullopt;
}

std::optional<std::uint64_t> header_hash_of_file(const std::filesystem::path& file,
                                                 std::uint64_t size) {
    FileStart start(file);
    const auto told = vti_header_hash(start.bytes(FilesSeen::kHead), size);
    return told ? told : vti_header_hash(start.bytes(kMostHead), size);
}

} // namespace isochron::index
