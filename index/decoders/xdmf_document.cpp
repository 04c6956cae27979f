// Parses XDMF documents with tinyxml2.
#include "index/decoders/xdmf_document.h"

#include "index/decoders/hdf5_file.h"
#include "index/decoders/xdmf_paths.h"
#include "index/error.h"
#include "index/formats/axis_positions.h"
#include "index/formats/stored_file.h"
#include "index/formats/text_header.h"
#include "index/system/input_file.h"

#include <fmt/format.h>
#include <tinyxml2.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;
using tinyxml2::XMLElement;

std::string attribute(const XMLElement& element, std::initializer_list<const char*> names) {
    for (const char* name : names)
        if (const char* text = element.Attribute(name))
            return text;
    return {};
}

class XdmfParser {
  public:
    explicit XdmfParser(const fs::path& path) : path_(path), name_(path.string()) {
        constexpr std::uint64_t kLargest = std::uint64_t{256} << 20;
        const std::string text = with_entities(read_text(path, kLargest), name_);
        if (document_.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS)
            fail(fmt::format("damaged XML at line {}", document_.ErrorLineNum()));
        const XMLElement* root = document_.RootElement();
        if (!root || std::string_view(root->Name()) != "Xdmf")
            fail("not XDMF");
        domain_ = root->FirstChildElement("Domain");
        if (!domain_)
            fail("holds no Domain");
    }

    std::vector<XdmfGrid> steps() {
        std::vector<const XMLElement*> grids;
        for (auto* grid = domain_->FirstChildElement("Grid"); grid;
             grid = grid->NextSiblingElement("Grid"))
            grids.push_back(referred(grid));
        if (grids.empty())
            fail("holds no Grid");
        const bool several = grids.size() > 1;
        if (several && !std::ranges::all_of(
                           grids, [](const auto* grid) { return grid->FirstChildElement("Time"); }))
            fail(fmt::format("{} grids beside each other, expected one, or one for each time",
                             grids.size()));
        for (const XMLElement* grid : grids)
            add(*grid, 0);
        if (steps_.empty())
            fail("holds no grid with values");
        return std::move(steps_);
    }

  private:
    [[noreturn]] void fail(const std::string& what) const {
        throw Error(fmt::format("{}: {}", name_, what));
    }

    /// The element that another refers to, if it does.
    const XMLElement* referred(const XMLElement* element) const {
        std::string path = attribute(*element, {"Reference"});
        if (path.empty())
            return element;
        if (lower_case(path) == "xml")
            path = element->GetText() ? std::string(trimmed(element->GetText())) : "";
        const XMLElement* found = xdmf_element(document_, path);
        if (!found || found == element || found->Attribute("Reference"))
            fail(fmt::format("refers to {}, which is not in it", excerpt(path)));
        return found;
    }

    const XMLElement* child_of(const XMLElement& element, const char* name) const {
        const XMLElement* child = element.FirstChildElement(name);
        return child ? referred(child) : nullptr;
    }

    void add(const XMLElement& grid, int depth) {
        constexpr int kDeepest = 8;
        const std::string type = lower_case(attribute(grid, {"GridType"}));
        if (type.empty() || type == "uniform")
            return steps_.push_back(uniform(grid));
        if (type != "collection" && type != "tree")
            fail(fmt::format("a grid of type {}, expected Uniform or Collection", excerpt(type)));
        if (depth > kDeepest)
            fail("grids within grids, too deep");
        std::vector<const XMLElement*> children;
        for (auto* child = grid.FirstChildElement("Grid"); child;
             child = child->NextSiblingElement("Grid"))
            children.push_back(referred(child));
        const bool temporal =
            lower_case(attribute(grid, {"CollectionType"})) == "temporal" && type == "collection";
        if (!temporal && children.size() > 1)
            fail(fmt::format("a collection of {} grids at one time, expected one grid",
                             children.size()));
        const std::size_t first = steps_.size();
        for (const XMLElement* child : children)
            add(*child, depth + 1);
        constexpr std::size_t kMostSteps = std::size_t{1} << 20;
        if (steps_.size() > kMostSteps)
            fail("too many steps");
        if (const XMLElement* time = child_of(grid, "Time"))
            give_xdmf_times(*time, first);
    }

    void give_xdmf_times(const XMLElement& time, std::size_t first) {
        const std::string type = lower_case(attribute(time, {"TimeType", "Type"}));
        const XMLElement* data = child_of(time, "DataItem");
        const std::size_t count = steps_.size() - first;
        std::vector<double> times;
        if (data)
            times = numbers_of_item(item_of(*data), path_);
        if (type == "hyperslab") {
            if (times.size() != 3 || times[2] < static_cast<double>(count))
                fail("times as a hyperslab, expected start, stride and the number of steps");
            const double start = times[0], stride = times[1];
            times.clear();
            for (std::size_t i = 0; i < count; ++i)
                times.push_back(start + static_cast<double>(i) * stride);
        }
        if (data && times.size() < count)
            fail(fmt::format("{} times, expected {}", times.size(), count));
        for (std::size_t i = 0; i < count && data; ++i)
            steps_[first + i].time = times[i];
        if (double value = 0; !data && count == 1 &&
                              time.QueryDoubleAttribute("Value", &value) == tinyxml2::XML_SUCCESS)
            steps_[first].time = value;
    }

    XdmfGrid uniform(const XMLElement& grid) {
        XdmfGrid step;
        place(grid, step);
        if (const XMLElement* time = child_of(grid, "Time")) {
            double value = 0;
            if (time->QueryDoubleAttribute("Value", &value) != tinyxml2::XML_SUCCESS)
                fail("a Time without a Value");
            step.time = value;
        }
        for (auto* one = grid.FirstChildElement("Attribute"); one;
             one = one->NextSiblingElement("Attribute")) {
            const XMLElement& element = *referred(one);
            const std::string center = lower_case(attribute(element, {"Center"}));
            const XMLElement* data = child_of(element, "DataItem");
            if (!data || (!center.empty() && center != "node" && center != "cell"))
                continue; // of the grid, of faces and edges
            step.attributes.push_back(
                {attribute(element, {"Name"}), center == "cell", item_of(*data)});
        }
        return step;
    }

    void place(const XMLElement& grid, XdmfGrid& step) {
        const XMLElement* topology = child_of(grid, "Topology");
        const XMLElement* geometry = child_of(grid, "Geometry");
        if (!topology || !geometry)
            fail("a grid without Topology or Geometry");
        const std::string type = attribute(*topology, {"TopologyType", "Type"});
        const std::string shape = lower_case(type);
        if (shape != "3dcorectmesh" && shape != "3drectmesh")
            fail(fmt::format("a grid of {}, expected 3DCoRectMesh or 3DRectMesh", excerpt(type)));
        std::vector<XdmfItem> items;
        for (auto* data = geometry->FirstChildElement("DataItem"); data;
             data = data->NextSiblingElement("DataItem"))
            items.push_back(item_of(*referred(data)));
        const std::string kind = lower_case(attribute(*geometry, {"GeometryType", "Type"}));
        const bool stretched = kind == "vxvyvz";
        if (!stretched && kind != "origin_dxdydz")
            fail(fmt::format("a geometry of {}, expected Origin_DxDyDz or VxVyVz", excerpt(kind)));
        if (items.size() != (stretched ? 3 : 2))
            fail(fmt::format("a geometry of {} items, expected {}", items.size(),
                             stretched ? 3 : 2));
        auto sizes = integers_of(attribute(*topology, {"Dimensions", "NumberOfElements"}),
                                 "Dimensions", name_);
        if (sizes.empty() && stretched)
            for (std::size_t axis = 3; axis-- > 0;)
                sizes.push_back(static_cast<std::int64_t>(
                    std::accumulate(items[axis].dimensions.begin(), items[axis].dimensions.end(),
                                    std::uint64_t{1}, std::multiplies<>())));
        if (sizes.size() != 3)
            fail(fmt::format("a topology of {} dimensions, expected 3", sizes.size()));
        step.grid.vertices = checked_vertices({sizes[2], sizes[1], sizes[0]}, name_);
        glm::dmat3 steps(1.0);
        std::array<std::vector<double>, 3> at;
        for (std::size_t i = 0; i < items.size(); ++i) {
            at[i] = numbers_of_item(items[i], path_);
            const std::size_t expected = stretched ? step.grid.vertices[i] : 3;
            if (at[i].size() != expected)
                fail(
                    fmt::format("{} numbers in its geometry, expected {}", at[i].size(), expected));
        }
        for (int axis = 0; axis < 3; ++axis) {
            const auto i = static_cast<std::size_t>(axis);
            if (!stretched) { // z, y, x
                step.grid.origin[axis] = at[0][2 - i];
                steps[axis][axis] = at[1][2 - i];
                continue;
            }
            const AxisSpread spread = spread_of(at[i], std::string(1, "xyz"[i]), "", name_);
            step.grid.origin[axis] = spread.first;
            steps[axis][axis] = spread.step;
            if (spread.note) {
                step.notes.push_back(*spread.note);
                set_positions(step.grid, i, at[i]);
            }
        }
        set_axes(step.grid, steps, name_);
    }

    XdmfItem item_of(const XMLElement& element) const {
        const std::string kind = lower_case(attribute(element, {"ItemType"}));
        if (kind == "hyperslab")
            return slab_of(element);
        if (!kind.empty() && kind != "uniform")
            fail(
                fmt::format("a DataItem of type {}, expected Uniform or HyperSlab", excerpt(kind)));
        XdmfItem item;
        for (const std::int64_t size :
             integers_of(attribute(element, {"Dimensions"}), "Dimensions", name_)) {
            if (size < 1 || item.dimensions.size() > 8)
                fail(fmt::format("a DataItem of dimensions {}, expected 1 to 8 of at least 1",
                                 excerpt(attribute(element, {"Dimensions"}))));
            item.dimensions.push_back(static_cast<std::uint64_t>(size));
        }
        item.type = type_of(element);
        const std::string format = lower_case(attribute(element, {"Format"}));
        item.where = format == "hdf" || format == "hdf5" ? XdmfItem::Where::hdf5
                     : format == "binary"                ? XdmfItem::Where::plain
                                                         : XdmfItem::Where::document;
        if (!format.empty() && format != "xml" && item.where == XdmfItem::Where::document)
            fail(fmt::format("a DataItem of format {}, expected XML, HDF or Binary",
                             excerpt(format)));
        item.text = element.GetText() ? std::string(trimmed(element.GetText())) : "";
        item.big_endian = lower_case(attribute(element, {"Endian"})) == "big";
        for (const std::int64_t seek : integers_of(attribute(element, {"Seek"}), "Seek", name_))
            item.seek = static_cast<std::uint64_t>(std::max<std::int64_t>(seek, 0));
        return item;
    }

    XdmfItem slab_of(const XMLElement& element) const {
        const XMLElement* how = element.FirstChildElement("DataItem");
        const XMLElement* what = how ? how->NextSiblingElement("DataItem") : nullptr;
        if (!what)
            fail("a HyperSlab without two DataItems in it");
        const auto numbers = numbers_of_item(item_of(*referred(how)), path_);
        XdmfItem item = item_of(*referred(what));
        const std::size_t rank = item.dimensions.size();
        if (numbers.size() != 3 * rank || !item.start.empty())
            fail(fmt::format("a HyperSlab of {} numbers, expected {}", numbers.size(), 3 * rank));
        for (std::size_t i = 0; i < rank; ++i) {
            const double start = numbers[i], stride = numbers[rank + i],
                         count = numbers[2 * rank + i];
            if (stride != 1 && count > 1)
                fail(fmt::format("a HyperSlab of stride {}, expected 1", stride));
            if (!(start >= 0 && count >= 1 &&
                  start + count <= static_cast<double>(item.dimensions[i])))
                fail(fmt::format("a HyperSlab of {} from {} on, its source has {}", count, start,
                                 item.dimensions[i]));
            item.start.push_back(static_cast<std::uint64_t>(start));
            item.count.push_back(static_cast<std::uint64_t>(count));
        }
        item.dimensions = item.count;
        return item;
    }

    StoredType type_of(const XMLElement& element) const {
        const std::string kind = lower_case(attribute(element, {"NumberType", "DataType"}));
        const std::string precision = attribute(element, {"Precision"});
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
        fail(fmt::format("a NumberType {} of Precision {}, expected Float, Int, UInt, Char or "
                         "UChar of 1 to 8",
                         excerpt(kind), excerpt(bytes)));
    }

    fs::path path_;
    std::string name_;
    tinyxml2::XMLDocument document_;
    const XMLElement* domain_ = nullptr;
    std::vector<XdmfGrid> steps_;
};

} // namespace

std::vector<XdmfGrid> read_xdmf(const fs::path& path) {
    return XdmfParser(path).steps();
}

std::vector<double> numbers_of_item(const XdmfItem& item, const fs::path& document) {
    const std::string name = document.string();
    if (item.where == XdmfItem::Where::document)
        return numbers_of(item.text, "a DataItem", name);
    if (item.where == XdmfItem::Where::plain || !item.start.empty())
        throw Error(fmt::format("{}: coordinates in another file, or a part of them, expected them "
                                "in the document or a dataset",
                                name));
    const XdmfHeavy heavy = heavy_of(item.text, document);
    const Hdf5File file(heavy.file);
    const auto dataset = file.dataset(heavy.path);
    if (!dataset)
        throw Error(fmt::format("{}: holds no dataset {}", file.name(), excerpt(heavy.path)));
    return file.values(*dataset);
}

} // namespace isochron::index
