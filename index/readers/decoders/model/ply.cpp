// PLY (G. Turk, "The PLY Polygon File Format", 1994), in text and both binary orders: places of
// vertices, and faces. All else is left out.
#include "index/readers/decoders/model/model.h"

#include "index/readers/decoders/model/model_text.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>

namespace isochron::index {
namespace {

enum class PlyType : std::uint8_t { i8, u8, i16, u16, i32, u32, f32, f64 };
constexpr std::array<std::array<std::string_view, 2>, 8> kPlyTypes{{{"char", "int8"},
                                                                    {"uchar", "uint8"},
                                                                    {"short", "int16"},
                                                                    {"ushort", "uint16"},
                                                                    {"int", "int32"},
                                                                    {"uint", "uint32"},
                                                                    {"float", "float32"},
                                                                    {"double", "float64"}}};
constexpr std::array<std::size_t, 8> kPlyBytes{1, 1, 2, 2, 4, 4, 4, 8};

struct PlyProperty {
    std::string name;
    PlyType type{};
    std::optional<PlyType> count{}; ///< type of the count of a list
};
struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;
};
enum class PlyForm : std::uint8_t { text, little, big };
struct PlyHeader {
    PlyForm form{};
    std::vector<PlyElement> elements;
    glm::dvec3 origin{0.0};
};

PlyType ply_type(ModelText& text) {
    const std::string_view word = text.word();
    for (std::size_t i = 0; i < kPlyTypes.size(); ++i)
        if (word == kPlyTypes[i][0] || word == kPlyTypes[i][1])
            return static_cast<PlyType>(i);
    text.fail(
        fmt::format("'{}', expected a type of PLY, as float or uchar", ModelText::shortened(word)));
}

void take_property(ModelText& text, PlyHeader& header) {
    if (header.elements.empty())
        text.fail("a property, expected an element before it");
    PlyProperty property;
    ModelText ahead = text;
    if (ahead.word() == "list") {
        text.word();
        property.count = ply_type(text);
        if (*property.count >= PlyType::f32)
            text.fail("a list with a count that is no whole number");
    }
    property.type = ply_type(text);
    property.name = text.word();
    header.elements.back().properties.push_back(std::move(property));
}

PlyHeader ply_header(ModelText& text) {
    PlyHeader header;
    if (!text.next_line() || text.word() != "ply")
        text.fail("expected 'ply'");
    bool has_form = false;
    while (text.next_line()) {
        const std::string_view word = text.word();
        if (word == "format") {
            const std::string_view form = text.word();
            constexpr std::array<std::string_view, 3> kForms{"ascii", "binary_little_endian",
                                                             "binary_big_endian"};
            const auto found = std::ranges::find(kForms, form);
            if (found == kForms.end())
                text.fail(fmt::format("format '{}', expected ascii, binary_little_endian or "
                                      "binary_big_endian",
                                      ModelText::shortened(form)));
            header.form = static_cast<PlyForm>(found - kForms.begin());
            has_form = true;
        } else if (word == "element") {
            PlyElement element{.name = std::string(text.word()), .properties = {}};
            element.count = text.number<std::uint64_t>("the number of elements");
            header.elements.push_back(std::move(element));
        } else if (word == "property") {
            take_property(text, header);
        } else if (word == "comment") {
            take_origin(text.line(), false, header.origin);
        } else if (word == "end_header") {
            if (!has_form)
                text.fail("end_header, expected a format before it");
            return header;
        } else if (word != "obj_info" && !word.empty()) {
            text.fail(fmt::format("'{}', expected element, property, comment or end_header",
                                  ModelText::shortened(word)));
        }
    }
    text.fail("the file ends within the header: expected end_header");
}

/// The values behind the header, one after the other.
class PlyValues {
  public:
    PlyValues(PlyForm form, ModelText text, const std::string& name)
        : form_(form), text_(std::move(text)), bytes_(text_.rest()), name_(name) {}

    /// Where the next values belong, for messages.
    void begin(const PlyElement& element, std::uint64_t number) {
        element_ = &element;
        number_ = number;
        if (form_ == PlyForm::text)
            do
                if (!text_.next_line())
                    fail_at_end();
            while (text_.line().find_first_not_of(" \t\r") == std::string_view::npos);
    }
    double next(PlyType type) {
        if (form_ == PlyForm::text)
            return text_.number<double>("a number");
        const std::size_t size = kPlyBytes[static_cast<std::size_t>(type)];
        if (bytes_.size() < size)
            fail_at_end();
        std::array<char, 8> stored{};
        std::copy_n(bytes_.begin(), size, stored.begin());
        bytes_.remove_prefix(size);
        if ((form_ == PlyForm::big) == (std::endian::native == std::endian::little))
            std::reverse(stored.begin(), stored.begin() + static_cast<std::ptrdiff_t>(size));
        switch (type) {
        case PlyType::i8: return as<std::int8_t>(stored);
        case PlyType::u8: return as<std::uint8_t>(stored);
        case PlyType::i16: return as<std::int16_t>(stored);
        case PlyType::u16: return as<std::uint16_t>(stored);
        case PlyType::i32: return as<std::int32_t>(stored);
        case PlyType::u32: return as<std::uint32_t>(stored);
        case PlyType::f32: return double{as<float>(stored)};
        default: return as<double>(stored);
        }
    }
    /// A number that has to be whole: of a list, or of a point.
    std::int64_t whole(PlyType type) {
        const double value = next(type);
        constexpr double kMost = 9e15;
        if (!(std::abs(value) < kMost) || value != std::floor(value))
            fail(fmt::format("got {}, expected a whole number", value));
        return static_cast<std::int64_t>(value);
    }
    /// @throws Error where so many values cannot follow
    std::uint64_t expect(std::int64_t count, PlyType type) {
        const std::size_t least =
            form_ == PlyForm::text ? 1 : kPlyBytes[static_cast<std::size_t>(type)];
        if (count < 0 || static_cast<std::uint64_t>(count) > left() / least)
            fail(fmt::format("has a list of {}, expected no more than follows", count));
        return static_cast<std::uint64_t>(count);
    }
    void expect_end() const {
        if (form_ != PlyForm::text && !bytes_.empty())
            throw Error("{}: {} bytes behind the last element, expected none", name_,
                        bytes_.size());
    }

  private:
    template <class T>
    static T as(const std::array<char, 8>& stored) {
        T value{};
        std::memcpy(&value, stored.data(), sizeof value);
        return value;
    }
    std::uint64_t left() const {
        return form_ == PlyForm::text ? text_.line().size() : bytes_.size();
    }
    [[noreturn]] void fail(const std::string& what) const {
        throw Error("{}: {} {} {}", name_, ModelText::shortened(element_->name), number_, what);
    }
    [[noreturn]] void fail_at_end() const {
        throw Error("{}: ends within {} {}: expected {}", name_,
                    ModelText::shortened(element_->name), number_, element_->count);
    }

    PlyForm form_;
    ModelText text_;
    std::string_view bytes_;
    std::string name_;
    const PlyElement* element_ = nullptr;
    std::uint64_t number_ = 0;
};

/// Number of the axis of a vertex that a property is; 3: none.
std::size_t axis_of(const PlyProperty& property) {
    constexpr std::array<std::string_view, 3> kAxes{"x", "y", "z"};
    return property.count
               ? kAxes.size()
               : static_cast<std::size_t>(std::ranges::find(kAxes, property.name) - kAxes.begin());
}

bool is_corners(const PlyProperty& property) {
    return property.count && (property.name == "vertex_indices" || property.name == "vertex_index");
}

} // namespace

StatedModel ply_model(std::span<const std::byte> bytes, const std::string& name) {
    ModelText text(bytes, name);
    const PlyHeader header = ply_header(text);
    StatedModel model;
    model.origin = header.origin;
    PlyValues values(header.form, text, name);
    std::vector<std::int64_t> polygon;
    for (const PlyElement& element : header.elements) {
        const bool vertices = element.name == "vertex", faces = element.name == "face";
        std::size_t axes = 0;
        for (const PlyProperty& property : element.properties)
            axes |= axis_of(property) < 3 ? std::size_t{1} << axis_of(property) : 0;
        if (vertices && axes != 7)
            throw Error("{}: element vertex lacks a place: expected properties x, y, z", name);
        if (faces && std::ranges::none_of(element.properties, is_corners))
            throw Error("{}: element face: expected a property list vertex_indices", name);
        for (std::uint64_t i = 0; i < element.count && !element.properties.empty(); ++i) {
            values.begin(element, i);
            glm::dvec3 place(0.0);
            for (const PlyProperty& property : element.properties) {
                if (!property.count) {
                    const double value = values.next(property.type);
                    if (const std::size_t axis = axis_of(property); axis < 3)
                        place[static_cast<int>(axis)] = value;
                    continue;
                }
                const std::uint64_t count =
                    values.expect(values.whole(*property.count), property.type);
                const bool corners = faces && is_corners(property);
                if (corners)
                    polygon.clear();
                for (std::uint64_t k = 0; k < count; ++k) {
                    if (corners)
                        polygon.push_back(values.whole(property.type));
                    else
                        values.next(property.type);
                }
                if (corners)
                    model.add_polygon(polygon, name, fmt::format("face {}", i));
            }
            if (vertices)
                model.points.push_back(place);
        }
    }
    values.expect_end();
    return model;
}

} // namespace isochron::index
