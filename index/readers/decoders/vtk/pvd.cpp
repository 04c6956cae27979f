// Reads ParaView collections (.pvd): files and their times.
#include "index/error.h"
#include "index/readers/decoders/decoders.h"
#include "index/readers/decoders/vtk/xml_markup.h"
#include "index/readers/formats/named_file.h"
#include "index/readers/formats/text_header.h"
#include "index/system/mapped_file.h"

#include <fmt/format.h>
#include <tinyxml2.h>

#include <charconv>
#include <cmath>
#include <string_view>

namespace isochron::index {
namespace {

/// A finite number; none if it is none.
std::optional<double> time_in(std::string_view text) {
    text = trimmed(text);
    if (text.starts_with('+'))
        text.remove_prefix(1);
    double time = 0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), time);
    if (failure != std::errc{} || end != text.data() + text.size() || !std::isfinite(time))
        return std::nullopt;
    return time;
}

} // namespace

ListedFiles decode_pvd(const std::filesystem::path& path) {
    const std::string name = path.string();
    const MappedFile file(path);
    const std::string_view text(reinterpret_cast<const char*>(file.bytes().data()),
                                file.bytes().size());
    expect_shallow(text, name);
    tinyxml2::XMLDocument xml;
    if (xml.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS)
        throw Error("{}: cannot be read: line {}: its XML is damaged ({})", name,
                    xml.ErrorLineNum(), xml.ErrorName());
    const tinyxml2::XMLElement* const root = xml.RootElement();
    const tinyxml2::XMLElement* const collection =
        root ? root->FirstChildElement("Collection") : nullptr;
    if (!collection)
        throw Error("{}: not a ParaView collection", name);
    ListedFiles files;
    for (const auto* set = collection->FirstChildElement("DataSet"); set;
         set = set->NextSiblingElement("DataSet")) {
        const char* const listed = set->Attribute("file");
        if (!listed)
            throw Error("{}: DataSet {} names no file", name, files.size());
        const char* const stated = set->Attribute("timestep");
        if (!stated)
            throw Error("{}: {} has no timestep", name, listed);
        const auto time = time_in(stated);
        if (!time)
            throw Error("{}: {}: timestep \"{}\", expected a number", name, listed, stated);
        const char *part = set->Attribute("part"), *group = set->Attribute("group");
        files.push_back({.path = file_named_in(path, listed),
                         .time = *time,
                         .part = fmt::format("{} of {}", part ? part : "0", group ? group : "")});
    }
    if (files.empty())
        throw Error("{}: an empty collection", name);
    return files;
}

} // namespace isochron::index
