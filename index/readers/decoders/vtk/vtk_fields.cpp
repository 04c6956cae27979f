// After "VTK File Formats" and the keys that VTK writes with its arrays.
#include "index/readers/decoders/vtk/vtk_fields.h"

#include "index/readers/decoders/vtk/xml_markup.h"
#include "index/readers/formats/text_header.h"

#include <fmt/format.h>

#include <map>
#include <utility>

namespace isochron::index {
namespace {

/// Attributes of elements that are read, or that say no more than the values do.
constexpr std::array kReadAttributes{
    "type",       "version",        "byte_order", "header_type",
    "compressor", "WholeExtent",    "Origin",     "Spacing",
    "Direction",  "Extent",         "Source",     "Name",
    "format",     "offset",         "encoding",   "NumberOfComponents",
    "RangeMin",   "RangeMax",       "GhostLevel", "TimeStep",
    "TimeValue",  "NumberOfTuples", "index",      "file",
    "location",   "NumberOfPoints"};
constexpr std::string_view kSpace = " \t\r\n";

std::string_view element_of(std::string_view tag) {
    const std::size_t end = tag.find_first_of(" \t\r\n/>", 1);
    return tag.substr(1, end == tag.npos ? end : end - 1);
}

std::map<std::string, std::string> attributes_of(std::string_view tag) {
    std::map<std::string, std::string> attributes;
    std::size_t at = std::min(element_of(tag).size() + 1, tag.size());
    while ((at = tag.find_first_not_of(kSpace, at)) != tag.npos) {
        const std::size_t equals = tag.find('=', at);
        const std::size_t quote = equals == tag.npos ? equals : tag.find_first_of("\"'", equals);
        const std::size_t end = quote == tag.npos ? quote : tag.find(tag[quote], quote + 1);
        if (end == tag.npos)
            break;
        attributes.emplace(trimmed(tag.substr(at, equals - at)),
                           tag.substr(quote + 1, end - quote - 1));
        at = end + 1;
    }
    return attributes;
}

class MarkupFields {
  public:
    MarkupFields(std::string_view markup, const ChosenScalar& chosen, SeriesInfo& info)
        : markup_(markup), chosen_(chosen), info_(info) {
        for_each_tag(markup, [this](Tag tag) { take(tag); });
        unread_.tell(info_);
    }

  private:
    void take(Tag tag) {
        const std::string element(element_of(tag.text));
        if (element.starts_with('/')) {
            if (element == "/" + group_)
                group_.clear();
            return;
        }
        auto attributes = attributes_of(tag.text);
        if (element == "FieldData" || element == "PointData" || element == "CellData") {
            if (!tag.text.ends_with("/>"))
                group_ = element;
            return; // which array another program would show: here the user chooses
        }
        if (element == "InformationKey")
            return take_key(attributes["name"], tag);
        if (element == "DataArray" || element == "Array")
            array_ = attributes["Name"];
        if (group_ == "FieldData" && !is_one_of(kTimeFields, array_))
            unread_.add("FieldData " + array_, "");
        for (const auto& [name, value] : attributes)
            if (!is_one_of(kReadAttributes, name) && !name.starts_with("NumberOf") &&
                !name.starts_with("ComponentName"))
                unread_.add(fmt::format("{} {}", element, name), value);
    }

    void take_key(const std::string& name, Tag tag) {
        const std::size_t begin = tag.at + tag.text.size();
        std::string_view text =
            markup_.substr(begin, std::min(markup_.find('<', begin), markup_.size()) - begin);
        constexpr std::string_view kRaw = "<![CDATA[";
        if (markup_.substr(begin).starts_with(kRaw)) {
            text = markup_.substr(begin + kRaw.size());
            text = text.substr(0, text.find("]]>"));
        }
        const bool of_chosen = array_ == chosen_.array.name &&
                               group_ == (chosen_.array.on_cells ? "CellData" : "PointData");
        if (name == kUnit && of_chosen)
            info_.value_unit = trimmed(text);
        else if (name == kUnit && group_ != "FieldData")
            return; // the unit of an array that is not shown
        else if (!is_one_of(kRanges, name))
            unread_.add(fmt::format("{} {}", array_, name), trimmed(text));
    }

    std::string_view markup_;
    const ChosenScalar& chosen_;
    SeriesInfo& info_;
    UnreadFields unread_;
    std::string group_, array_; ///< in which the tag is
};

} // namespace

void UnreadFields::add(const std::string& key, std::string_view value) {
    if (seen_.insert(key).second)
        fields_.push_back(value.empty() ? key : fmt::format("{} {}", key, excerpt(value)));
}

void UnreadFields::tell(SeriesInfo& info) const {
    if (auto note = note_on_unread(fields_))
        info.notes.push_back(std::move(*note));
}

void take_fields_of_markup(std::string_view markup, const ChosenScalar& chosen, SeriesInfo& info) {
    const MarkupFields fields(markup, chosen, info);
}

} // namespace isochron::index
