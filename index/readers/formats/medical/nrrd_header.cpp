// Reads the fields of an NRRD header.
#include "index/readers/formats/medical/nrrd_header.h"

#include "index/error.h"
#include "index/lower_case.h"
#include "index/readers/formats/text_header.h"
#include "index/system/input_file.h"

#include <fmt/format.h>

#include <istream>

namespace isochron::index {

NrrdHeader::NrrdHeader(const std::filesystem::path& path) : file_(path.string()) {
    constexpr std::uint64_t kMost = 16 << 20;
    InputStream in(path);
    std::string line;
    if (!read_line(in, line) || !line.starts_with("NRRD000"))
        throw Error("{}: not NRRD: it does not start with NRRD000", file_);
    while (read_line(in, line) && !line.empty()) {
        if (bytes_ > kMost)
            throw Error("{}: not NRRD: its header is longer than {} bytes", file_, kMost);
        if (lists()) {
            listed_.emplace_back(trimmed(line));
            continue;
        }
        const std::size_t colon = line.find(':');
        if (line.starts_with('#') || colon == line.npos)
            continue;
        const std::string spelled(trimmed(std::string_view(line).substr(0, colon)));
        if (line.compare(colon, 2, ":=") == 0) {
            own_[spelled] = trimmed(std::string_view(line).substr(colon + 2));
            continue;
        }
        std::string key = lower_case(spelled);
        std::erase(key, ' ');
        spelled_[key] = spelled;
        fields_[key] = trimmed(std::string_view(line).substr(colon + 1));
    }
    if (lists() && !line.empty()) // the last line of a file may have no end
        listed_.emplace_back(trimmed(line));
}

bool NrrdHeader::lists() const {
    return lower_case(find("datafile").value_or("")).starts_with("list");
}

std::optional<std::string> NrrdHeader::find(const std::string& key) const {
    const auto found = fields_.find(key);
    return found == fields_.end() ? std::nullopt : std::optional(found->second);
}

std::optional<std::string> NrrdHeader::own(const std::string& key) const {
    const auto found = own_.find(key);
    return found == own_.end() ? std::nullopt : std::optional(found->second);
}

std::vector<std::string> NrrdHeader::others(const std::set<std::string_view>& keys) const {
    std::vector<std::string> others;
    for (const auto& [key, spelled] : spelled_)
        if (!keys.contains(key))
            others.push_back(fmt::format("{} {}", spelled, excerpt(fields_.at(key))));
    for (const auto& [key, value] : own_)
        if (!keys.contains(key))
            others.push_back(key);
    return others;
}

std::string NrrdHeader::need(const std::string& key) const {
    if (auto text = find(key))
        return *text;
    throw Error("{}: has no {}", file_, key);
}

// Reads a line of limited length: a file with a longer line is not NRRD.
bool NrrdHeader::read_line(std::istream& in, std::string& line) {
    constexpr std::size_t kMost = 1 << 16;
    line.clear();
    char c = 0;
    for (; in.get(c) && c != '\n'; line += c)
        if (line.size() > kMost)
            throw Error("{}: not NRRD: a line of the header has no end", file_);
    bytes_ += line.size() + (c == '\n');
    if (line.ends_with('\r'))
        line.pop_back();
    return !in.fail();
}

} // namespace isochron::index
