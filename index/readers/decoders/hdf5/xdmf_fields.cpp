// After "XDMF Model and Format", https://www.xdmf.org/index.php/XDMF_Model_and_Format.html
#include "index/readers/decoders/hdf5/xdmf_fields.h"

#include "index/lower_case.h"
#include "index/readers/formats/text_header.h"

#include <fmt/format.h>
#include <tinyxml2.h>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <utility>

namespace isochron::index {
namespace {

using tinyxml2::XMLElement;

/// Elements with the attributes that are read from them.
const std::map<std::string_view, std::set<std::string_view>>& read_in_xdmf() {
    static const std::map<std::string_view, std::set<std::string_view>> kRead{
        {"Xdmf", {"Version"}},
        {"Domain", {}},
        {"Grid", {"GridType", "CollectionType"}},
        {"Topology", {"TopologyType", "Type", "Dimensions", "NumberOfElements"}},
        {"Geometry", {"GeometryType", "Type"}},
        {"DataItem",
         {"ItemType", "Dimensions", "NumberType", "DataType", "Precision", "Format", "Endian",
          "Seek", "Compression", "Rank"}},
        {"Attribute", {"Name", "AttributeType", "Type", "Center"}},
        {"Time", {"Value", "TimeType", "Type"}}};
    return kRead;
}

class XdmfFields {
  public:
    std::vector<std::string> of(const tinyxml2::XMLDocument& document) {
        for (auto* each = document.FirstChildElement(); each; each = next_of(*each))
            take(*each);
        return std::move(fields_);
    }

  private:
    /// In the order of the document. Elements that are not known have nothing that is read.
    static const XMLElement* next_of(const XMLElement& element) {
        if (read_in_xdmf().contains(element.Name()))
            if (auto* child = element.FirstChildElement())
                return child;
        const XMLElement* at = &element;
        while (at && !at->NextSiblingElement())
            at = at->Parent() ? at->Parent()->ToElement() : nullptr;
        return at ? at->NextSiblingElement() : nullptr;
    }

    void take(const XMLElement& element) {
        const std::string name = element.Name();
        if (name == "include" || name.ends_with(":include"))
            return;
        const auto read = read_in_xdmf().find(name);
        if (read == read_in_xdmf().end()) {
            const char* called = element.Attribute("Name");
            const char* value = element.Attribute("Value");
            if (!value)
                value = element.GetText();
            return add(called ? fmt::format("{} {}", name, excerpt(called)) : name,
                       value ? value : "");
        }
        for (auto* each = element.FirstAttribute(); each; each = each->Next()) {
            const std::string_view key = each->Name();
            // Names of items lead to them, as in /Xdmf/Domain/Grid[@Name="a"].
            const bool leads = key == "Reference" || key == "id" ||
                               (key == "Name" && name != "Grid" && name != "Domain");
            if (!leads && !key.starts_with("xmlns") && !key.starts_with("xml:") &&
                !read->second.contains(key))
                add(fmt::format("{} {}", name, key), each->Value());
        }
        if (name != "Attribute")
            return;
        const char* center = element.Attribute("Center");
        const std::string at = lower_case(center ? center : "node");
        const char* called = element.Attribute("Name");
        if (at != "node" && at != "cell")
            add(fmt::format("Attribute {} of Center", excerpt(called ? called : "")), center);
    }

    void add(const std::string& key, std::string_view value) {
        constexpr std::size_t kMost = 1000;
        if (seen_.size() < kMost && seen_.insert(key).second)
            fields_.push_back(value.empty() ? key : fmt::format("{} {}", key, excerpt(value)));
    }

    std::set<std::string> seen_;
    std::vector<std::string> fields_;
};

} // namespace

std::vector<std::string> unread_of_xdmf(const tinyxml2::XMLDocument& document) {
    return XdmfFields().of(document);
}

} // namespace isochron::index
