// Resolves what XDMF documents name.
#include "index/readers/decoders/hdf5/xdmf_paths.h"

#include "index/error.h"
#include "index/readers/formats/named_file.h"
#include "index/readers/formats/text_header.h"

#include <tinyxml2.h>

#include <regex>
#include <sstream>
#include <utility>
#include <vector>

namespace isochron::index {

XdmfHeavy heavy_of(const std::string& text, const std::filesystem::path& document) {
    const std::string place(trimmed(text));
    const std::size_t colon = place.rfind(':');
    if (colon == std::string::npos || colon == 0 || colon + 1 == place.size())
        throw Error("{}: a DataItem at {}, expected FILE.h5:/PATH", document.string(),
                    excerpt(place));
    return {file_named_in(document, std::string(trimmed(place.substr(0, colon)))),
            std::string(trimmed(place.substr(colon + 1)))};
}

const tinyxml2::XMLElement* xdmf_element(const tinyxml2::XMLDocument& document,
                                         const std::string& path) {
    constexpr std::size_t kLongest = 4096;
    static const std::regex kPart(
        R"re(([A-Za-z]+)(?:\[(\d{1,6})\]|\[@Name *= *["']([^"']*)["']\])?)re");
    if (path.size() > kLongest)
        return nullptr;
    const tinyxml2::XMLElement* found = nullptr;
    std::istringstream parts(path);
    for (std::string part; std::getline(parts, part, '/');) {
        if (part.empty())
            continue;
        std::smatch match;
        if (!std::regex_match(part, match, kPart))
            return nullptr;
        const std::string name = match[1];
        int left = match[2].matched ? std::stoi(match[2]) : 1; // counted from 1
        const auto* each = found ? found->FirstChildElement(name.c_str())
                                 : document.FirstChildElement(name.c_str());
        for (; each; each = each->NextSiblingElement(name.c_str())) {
            const char* called = each->Attribute("Name");
            if (match[3].matched ? called && match[3] == called : --left == 0)
                break;
        }
        if (!each)
            return nullptr;
        found = each;
    }
    return found;
}

std::string attribute(const tinyxml2::XMLElement& element,
                      std::initializer_list<const char*> names) {
    for (const char* name : names)
        if (const char* text = element.Attribute(name))
            return text;
    return {};
}

std::optional<StoredType> xdmf_type(const std::string& kind, const std::string& precision) {
    const std::string bytes =
        precision.empty() ? (kind == "char" || kind == "uchar" ? "1" : "4") : precision;
    const std::string name = (kind.empty() ? "float" : kind) + bytes;
    for (const auto& [known, type] : {std::pair("float4", StoredType::f32),
                                      {"float8", StoredType::f64},
                                      {"int1", StoredType::i8},
                                      {"char1", StoredType::i8},
                                      {"uchar1", StoredType::u8},
                                      {"uint1", StoredType::u8},
                                      {"int2", StoredType::i16},
                                      {"short2", StoredType::i16},
                                      {"uint2", StoredType::u16},
                                      {"int4", StoredType::i32},
                                      {"uint4", StoredType::u32},
                                      {"int8", StoredType::i64},
                                      {"uint8", StoredType::u64}})
        if (name == known)
            return type;
    return std::nullopt;
}

std::string with_entities(std::string text, const std::string& file) {
    constexpr std::size_t kHead = 1 << 16, kMost = 64, kMostLonger = 64 << 20;
    static const std::regex kEntity(R"re(<!ENTITY +(\w{1,64}) +["']([^"'&<]{0,256})["'])re");
    const std::string head = text.substr(0, kHead);
    std::vector<std::pair<std::string, std::string>> entities;
    for (std::sregex_iterator at(head.begin(), head.end(), kEntity), end;
         at != end && entities.size() < kMost; ++at)
        entities.emplace_back("&" + (*at)[1].str() + ";", (*at)[2]);
    const std::size_t most = text.size() + kMostLonger;
    for (const auto& [name, value] : entities) {
        std::string replaced;
        std::size_t from = 0;
        for (std::size_t at; (at = text.find(name, from)) != text.npos; from = at + name.size()) {
            replaced.append(text, from, at - from).append(value);
            if (replaced.size() > most)
                throw Error("{}: its entities make it much longer", file);
        }
        text = replaced.append(text, from);
    }
    return text;
}

} // namespace isochron::index
