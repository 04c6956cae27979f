// Parses the tags alone, with TinyXML-2: the text between them is read where it stands.
#include "index/readers/decoders/vtk/vti_document.h"

#include "index/error.h"
#include "index/readers/decoders/vtk/xml_markup.h"
#include "index/readers/formats/text_header.h"

#include <fmt/format.h>
#include <tinyxml2.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <string_view>

namespace isochron::index {
namespace {

using tinyxml2::XMLElement;

std::string_view attribute(const XMLElement& element, const char* name) {
    const char* const value = element.Attribute(name);
    return value ? std::string_view(value) : std::string_view();
}

constexpr const char* kTextAt = "isochron_text_at";

class DocumentReader {
  public:
    DocumentReader(const MappedFile& file, std::string_view markup, const std::string& name)
        : all_(reinterpret_cast<const char*>(file.bytes().data()), file.bytes().size()),
          markup_(markup), name_(name) {
        std::string tags;
        for_each_tag(markup, [&](Tag tag) {
            const std::size_t name_end =
                std::min(tag.text.find_first_of(" \t\r\n/>", 1), tag.text.size());
            tags += tag.text.substr(0, name_end);
            // Arrays are told where their text begins, by an attribute before their own.
            if (!tag.text.starts_with("</"))
                tags += fmt::format(" {}=\"{}\"", kTextAt, tag.at + tag.text.size());
            tags += tag.text.substr(name_end);
        });
        // What stands behind appended data closes the elements around them.
        if (markup_.size() < all_.size())
            tags += "</VTKFile>";
        if (xml_.Parse(tags.data(), tags.size()) != tinyxml2::XML_SUCCESS)
            fail(fmt::format("its XML is damaged ({})", xml_.ErrorName()));
        place_appended();
    }

    VtiDocument read() {
        const XMLElement* const root = xml_.RootElement();
        const XMLElement* const image = root && std::string_view(root->Name()) == "VTKFile" &&
                                                attribute(*root, "type") == "ImageData"
                                            ? root->FirstChildElement("ImageData")
                                            : nullptr;
        if (!image)
            throw Error("{}: not VTK XML image data", name_);
        take_encoding(*root);
        document_.extent = extent_in(*image, "WholeExtent");
        take_numbers(*image, "Origin", document_.origin);
        take_numbers(*image, "Spacing", document_.spacing);
        take_numbers(*image, "Direction", document_.direction);
        has_steps_ = image->Attribute("TimeValues") != nullptr;
        take_arrays(*image, "FieldData", document_.fields);
        for (const XMLElement* each = image->FirstChildElement("Piece"); each;
             each = each->NextSiblingElement("Piece")) {
            VtiPiece& piece = document_.pieces.emplace_back();
            piece.extent = extent_in(*each, "Extent");
            take_arrays(*each, "PointData", piece.points);
            take_arrays(*each, "CellData", piece.cells);
        }
        return std::move(document_);
    }

  private:
    [[noreturn]] void fail(std::string_view what) const {
        throw Error("{}: cannot be read: {}", name_, what);
    }

    /// Appended data begin behind an underscore, and end with the file's last element.
    void place_appended() {
        if (markup_.size() == all_.size())
            return;
        const std::string_view rest = all_.substr(markup_.size());
        const std::size_t tag = rest.find('>');
        const std::size_t begin =
            tag == rest.npos ? tag : rest.find_first_not_of(" \t\r\n", tag + 1);
        if (begin == rest.npos || rest[begin] != '_')
            fail("its appended data do not begin with an underscore");
        const std::string_view of_tag = rest.substr(0, tag);
        appended_as_ = of_tag.find("raw") != of_tag.npos ? VtiPlace::As::raw : VtiPlace::As::base64;
        const std::size_t end = rest.rfind("</AppendedData");
        appended_ =
            rest.substr(0, std::max(begin + 1, std::min(end, rest.size()))).substr(begin + 1);
    }

    void take_encoding(const XMLElement& root) {
        const std::string_view order = attribute(root, "byte_order"),
                               header = attribute(root, "header_type"),
                               packing = attribute(root, "compressor");
        if (!order.empty() && order != "LittleEndian" && order != "BigEndian")
            fail(fmt::format("byte_order {}, expected LittleEndian or BigEndian", excerpt(order)));
        if (!header.empty() && header != "UInt32" && header != "UInt64")
            fail(fmt::format("header_type {}, expected UInt32 or UInt64", excerpt(header)));
        document_.encoding = {.big_endian = order == "BigEndian",
                              .wide_header = header == "UInt64"};
        for (const auto& [word, known] : {std::pair{"vtkZLibDataCompressor", BlockPacking::zlib},
                                          {"vtkLZ4DataCompressor", BlockPacking::lz4},
                                          {"vtkLZMADataCompressor", BlockPacking::lzma}})
            if (packing == word)
                document_.encoding.packing = known;
        if (!packing.empty() && document_.encoding.packing == BlockPacking::none)
            fail(fmt::format(
                "compressor {}, expected vtkZLibDataCompressor, vtkLZ4DataCompressor or "
                "vtkLZMADataCompressor",
                excerpt(packing)));
    }

    VtiExtent extent_in(const XMLElement& element, const char* key) const {
        const std::string where = name_ + ": cannot be read";
        const auto numbers = integers_of(attribute(element, key), key, where);
        VtiExtent extent{};
        const auto fits = [](std::int64_t number) {
            return number >= std::numeric_limits<int>::min() &&
                   number <= std::numeric_limits<int>::max();
        };
        if (numbers.size() < extent.size() || !std::ranges::all_of(numbers, fits))
            fail(fmt::format(
                "{} {} `{}`, expected six numbers: the first and last vertex along each "
                "axis",
                element.Name(), key, excerpt(attribute(element, key))));
        for (std::size_t i = 0; i < extent.size(); ++i)
            extent[i] = static_cast<int>(numbers[i]);
        return extent;
    }

    template <std::size_t kCount>
    void take_numbers(const XMLElement& element, const char* key,
                      std::array<double, kCount>& numbers) const {
        if (!element.Attribute(key))
            return;
        const auto stated = numbers_of(attribute(element, key), key, name_ + ": cannot be read");
        if (stated.size() < kCount)
            fail(fmt::format("{} `{}`, expected {} numbers", key, excerpt(attribute(element, key)),
                             kCount));
        std::copy_n(stated.begin(), kCount, numbers.begin());
    }

    std::uint64_t count_in(const XMLElement& element, const char* key, std::uint64_t otherwise,
                           std::uint64_t most) const {
        const std::string_view text = trimmed(attribute(element, key));
        if (!element.Attribute(key))
            return otherwise;
        std::uint64_t count = 0;
        const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), count);
        if (failure != std::errc{} || end != text.data() + text.size() || count == 0 ||
            count > most)
            fail(fmt::format("{} `{}` of array {}, expected 1 to {}", key, excerpt(text),
                             excerpt(attribute(element, "Name")), most));
        return count;
    }

    static std::optional<StoredType> type_of(std::string_view word) {
        for (const auto& [name, type] : {std::pair{"Int8", StoredType::i8},
                                         {"UInt8", StoredType::u8},
                                         {"Int16", StoredType::i16},
                                         {"UInt16", StoredType::u16},
                                         {"Int32", StoredType::i32},
                                         {"UInt32", StoredType::u32},
                                         {"Int64", StoredType::i64},
                                         {"UInt64", StoredType::u64},
                                         {"Float32", StoredType::f32},
                                         {"Float64", StoredType::f64}})
            if (word == name)
                return type;
        return std::nullopt;
    }

    /// Where a file has several steps, the first counts, as in VTK.
    bool is_of_another_step(const XMLElement& element) const {
        if (!has_steps_ || !element.Attribute("TimeStep"))
            return false;
        const auto steps = words_of(attribute(element, "TimeStep"));
        return !steps.empty() && std::ranges::find(steps, "0") == steps.end();
    }

    void take_arrays(const XMLElement& parent, const char* group, std::vector<VtiArray>& into) {
        for (const XMLElement* child = parent.FirstChildElement(); child;
             child = child->NextSiblingElement()) {
            const bool wanted = std::string_view(child->Name()) == group;
            for (const XMLElement* each = wanted ? child->FirstChildElement() : nullptr; each;
                 each = each->NextSiblingElement())
                if (const std::string_view name = each->Name();
                    name == "DataArray" || name == "Array")
                    take_array(*each, group, into);
        }
    }

    void take_array(const XMLElement& element, std::string_view group,
                    std::vector<VtiArray>& into) {
        constexpr std::uint64_t kMostComponents = 1 << 16;
        VtiArray array{.array = {.name = std::string(attribute(element, "Name")),
                                 .type = type_of(attribute(element, "type")),
                                 .components = static_cast<std::uint32_t>(
                                     count_in(element, "NumberOfComponents", 1, kMostComponents)),
                                 .on_cells = group == "CellData"},
                       .place = {}};
        if (is_of_another_step(element))
            return;
        if (group == "FieldData" &&
            (array.array.components != 1 || trimmed(attribute(element, "NumberOfTuples")) != "1"))
            return;
        const std::string_view format = attribute(element, "format");
        if (format == "appended") {
            const std::string_view text = trimmed(attribute(element, "offset"));
            std::uint64_t offset = 0;
            const auto [end, failure] =
                std::from_chars(text.data(), text.data() + text.size(), offset);
            if (failure != std::errc{} || end != text.data() + text.size())
                fail(fmt::format("offset `{}` of array {}, expected a number", excerpt(text),
                                 array.array.name));
            if (offset > appended_.size())
                throw Error("{}: truncated: array {} begins at byte {} of {} appended ones", name_,
                            array.array.name, offset, appended_.size());
            array.place = {appended_.substr(offset), appended_as_};
        } else {
            array.place = {text_of(element),
                           format == "binary" ? VtiPlace::As::base64 : VtiPlace::As::text};
        }
        into.push_back(std::move(array));
    }

    std::string_view text_of(const XMLElement& element) const {
        return markup_.substr(std::min<std::size_t>(
            static_cast<std::size_t>(element.Unsigned64Attribute(kTextAt)), markup_.size()));
    }

    std::string_view all_, markup_;
    const std::string& name_;
    tinyxml2::XMLDocument xml_;
    std::string_view appended_;
    VtiPlace::As appended_as_ = VtiPlace::As::base64;
    bool has_steps_ = false;
    VtiDocument document_;
};

} // namespace

VtiDocument vti_document(const MappedFile& file, std::string_view markup, const std::string& name) {
    return DocumentReader(file, markup, name).read();
}

} // namespace isochron::index
