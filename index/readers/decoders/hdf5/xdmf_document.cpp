// Parses XDMF documents with tinyxml2.
#include "index/readers/decoders/hdf5/xdmf_document.h"

#include "index/error.h"
#include "index/lower_case.h"
#include "index/readers/decoders/hdf5/hdf5_file.h"
#include "index/readers/decoders/hdf5/xdmf_fields.h"
#include "index/readers/decoders/hdf5/xdmf_paths.h"
#include "index/readers/formats/named_file.h"
#include "index/readers/formats/stated/array_places.h"
#include "index/readers/formats/stated/stated_times.h"
#include "index/readers/formats/stored_file.h"
#include "index/readers/formats/text_header.h"
#include "index/readers/formats/unread_fields.h"
#include "index/system/input_file.h"

#include <fmt/format.h>
#include <tinyxml2.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <numeric>
#include <span>
#include <utility>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;
using tinyxml2::XMLElement;

class XdmfParser {
  public:
    /// @param chain documents, each included by the one before it
    /// @param seen grids so far, of all documents
    XdmfParser(const fs::path& path, std::vector<fs::path> chain, std::size_t& seen)
        : path_(path), name_(path.string()), chain_(std::move(chain)), seen_(seen) {
        chain_.push_back(path.lexically_normal());
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
        const std::size_t grids = add_children(*domain_, 0);
        if (grids == 0)
            fail("holds no Grid");
        if (grids > 1 && !std::ranges::all_of(
                             steps_, [](const XdmfGrid& step) { return step.time.has_value(); }))
            fail(fmt::format("{} grids beside each other, expected one, or one for each time",
                             grids));
        if (steps_.empty())
            fail("holds no grid with values");
        if (auto note = note_on_unread(unread_of_xdmf(document_)))
            steps_.front().notes.push_back(std::move(*note));
        return std::move(steps_);
    }

  private:
    [[noreturn]] void fail(const std::string& what) const { throw Error("{}: {}", name_, what); }

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
        constexpr std::size_t kMostGrids = std::size_t{1} << 21;
        if (++seen_ > kMostGrids)
            fail("too many grids");
        const std::string type = lower_case(attribute(grid, {"GridType"}));
        if (type.empty() || type == "uniform")
            return steps_.push_back(uniform(grid));
        if (type != "collection" && type != "tree")
            fail(fmt::format("a grid of type {}, expected Uniform or Collection", excerpt(type)));
        if (depth > kDeepest)
            fail("grids within grids, too deep");
        const bool temporal =
            lower_case(attribute(grid, {"CollectionType"})) == "temporal" && type == "collection";
        const std::size_t first = steps_.size();
        const std::size_t grids = add_children(grid, depth + 1);
        if (!temporal && grids > 1)
            join(first, grids);
        if (const XMLElement* time = child_of(grid, "Time"))
            give_xdmf_times(*time, first);
    }

    /// Adds the steps of the grids in an element, included grids too.
    /// @return number of grids
    std::size_t add_children(const XMLElement& parent, int depth) {
        std::size_t grids = 0;
        for (auto* child = parent.FirstChildElement(); child; child = child->NextSiblingElement()) {
            const std::string_view name = child->Name();
            if (name == "Grid")
                add(*referred(child), depth);
            else if (name == "include" || name.ends_with(":include"))
                include(*child, depth);
            else
                continue;
            ++grids;
        }
        return grids;
    }

    /// A grid of another document, or of this one: `href`, and `xpointer` as it is written in
    /// XDMF, xpointer(//Xdmf/Domain/Grid[2]).
    void include(const XMLElement& element, int depth) {
        const std::string href = attribute(element, {"href"});
        std::string pointer = attribute(element, {"xpointer"});
        if (pointer.starts_with("xpointer(") && pointer.ends_with(")"))
            pointer = pointer.substr(9, pointer.size() - 10);
        if (pointer.empty())
            pointer = "/Xdmf/Domain/Grid";
        if (href.empty()) {
            add(grid_at(pointer), depth + 1);
            return;
        }
        const fs::path other = file_named_in(path_, href);
        constexpr std::size_t kDeepest = 8;
        if (chain_.size() > kDeepest ||
            std::ranges::find(chain_, other.lexically_normal()) != chain_.end())
            fail(fmt::format("includes {}, which includes it", excerpt(href)));
        constexpr std::size_t kCost = 100; // what reading a document costs, in grids
        seen_ += kCost;
        XdmfParser parser(other, chain_, seen_);
        parser.add(parser.grid_at(pointer), depth);
        std::ranges::move(parser.steps_, std::back_inserter(steps_));
    }

    const XMLElement& grid_at(const std::string& pointer) const {
        const XMLElement* found = xdmf_element(document_, pointer);
        if (!found || std::string_view(found->Name()) != "Grid")
            fail(fmt::format("has no grid {}", excerpt(pointer)));
        return *referred(found);
    }

    /// Joins the grids from `first` on into one step: they are the blocks of its grid.
    void join(std::size_t first, std::size_t grids) {
        const std::span<XdmfGrid> blocks = std::span(steps_).subspan(first);
        std::vector<Grid> places;
        std::vector<std::string> names;
        for (const XdmfGrid& block : blocks) {
            if (blocks.size() != grids || block.parts.size() != 1)
                fail(fmt::format("a collection of {} grids at one time, expected uniform ones",
                                 grids));
            names.push_back(fmt::format("{}: block {}", name_, places.size()));
            places.push_back(block.grid);
        }
        const BlockPlaces found = places_of_blocks(places, names);
        XdmfGrid whole = std::move(blocks.front());
        whole.grid = found.whole;
        whole.notes.push_back(fmt::format("put together from {} parts", grids));
        whole.parts.front().begin = found.begins.front();
        for (std::size_t i = 1; i < blocks.size(); ++i) {
            if (!whole.time) {
                whole.time = blocks[i].time;
                whole.date = std::move(blocks[i].date);
            }
            whole.parts.push_back(std::move(blocks[i].parts.front()));
            whole.parts.back().begin = found.begins[i];
        }
        steps_.resize(first);
        steps_.push_back(std::move(whole));
    }

    void give_xdmf_times(const XMLElement& time, std::size_t first) {
        const std::string type = lower_case(attribute(time, {"TimeType", "Type"}));
        const XMLElement* data = child_of(time, "DataItem");
        const std::size_t count = steps_.size() - first;
        if (!type.empty() && type != "single" && type != "list" && type != "hyperslab")
            fail(fmt::format("a Time of type {}, expected Single, List or HyperSlab",
                             excerpt(type)));
        std::vector<double> times;
        if (data)
            times = numbers_of_item(item_of(*data));
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
        if (!data && count == 1 && time.Attribute("Value"))
            give_xdmf_time(time, steps_[first]);
    }

    void give_xdmf_time(const XMLElement& time, XdmfGrid& step) const {
        std::string value = attribute(time, {"Value"});
        value = trimmed(value);
        double number = 0;
        const auto [end, failure] = std::from_chars(value.data() + value.starts_with('+'),
                                                    value.data() + value.size(), number);
        const bool is_number = failure == std::errc{} && end == value.data() + value.size();
        if (!is_number && !are_dates(std::span(&value, 1)))
            fail(
                fmt::format("a Time of Value \"{}\", expected a number or a date", excerpt(value)));
        step.time = is_number ? number : 0;
        step.date = is_number ? "" : value;
    }

    XdmfGrid uniform(const XMLElement& grid) {
        XdmfGrid step;
        place(grid, step);
        XdmfPart& part = step.parts.emplace_back();
        part.grid = step.grid;
        if (const XMLElement* time = child_of(grid, "Time"))
            give_xdmf_time(*time, step);
        for (auto* one = grid.FirstChildElement("Attribute"); one;
             one = one->NextSiblingElement("Attribute")) {
            const XMLElement& element = *referred(one);
            const std::string center = lower_case(attribute(element, {"Center"}));
            const XMLElement* data = child_of(element, "DataItem");
            if (!data || (!center.empty() && center != "node" && center != "cell"))
                continue; // an attribute of the grid, of faces or edges
            part.attributes.push_back({attribute(element, {"Name"}),
                                       attribute(element, {"AttributeType", "Type"}),
                                       center == "cell", item_of(*data)});
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
        StatedArray stated{
            .file = name_, .name = {}, .axes = std::vector<StatedAxis>(3)}; // z, y, x
        for (std::size_t i = 0; i < items.size(); ++i) {
            const std::vector<double> at = numbers_of_item(items[i]);
            const std::size_t expected = stretched ? step.grid.vertices[i] : 3;
            if (at.size() != expected)
                fail(fmt::format("{} numbers in its geometry, expected {}", at.size(), expected));
            if (stretched)
                stated.axes[2 - i].at = at;
            for (std::size_t axis = 0; axis < 3 && !stretched; ++axis) {
                (i == 0 ? stated.axes[axis].first : stated.axes[axis].step) = at[axis];
                stated.axes[axis].regular = true;
            }
        }
        SeriesInfo placed;
        placed.grid = step.grid;
        place_axes(stated, layout_of_zyx(), {}, placed);
        step.grid = placed.grid;
        std::ranges::move(placed.notes, std::back_inserter(step.notes));
    }

    XdmfItem item_of(const XMLElement& element) const {
        const std::string kind = lower_case(attribute(element, {"ItemType"}));
        if (kind == "hyperslab")
            return slab_of(element);
        if (!kind.empty() && kind != "uniform")
            fail(
                fmt::format("a DataItem of type {}, expected Uniform or HyperSlab", excerpt(kind)));
        XdmfItem item;
        item.document = path_;
        for (const std::int64_t size :
             integers_of(attribute(element, {"Dimensions"}), "Dimensions", name_)) {
            if (size < 1 || item.dimensions.size() > 8)
                fail(fmt::format("a DataItem of dimensions {}, expected 1 to 8 of at least 1",
                                 excerpt(attribute(element, {"Dimensions"}))));
            item.dimensions.push_back(static_cast<std::uint64_t>(size));
        }
        item.type = type_of(element);
        if (const std::string packed = lower_case(attribute(element, {"Compression"}));
            !packed.empty() && packed != "raw")
            fail(fmt::format("a DataItem of Compression {}, expected Raw", excerpt(packed)));
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
        const auto numbers = numbers_of_item(item_of(*referred(how)));
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
        if (const auto type = xdmf_type(kind, precision))
            return *type;
        fail(fmt::format("a NumberType {} of Precision {}, expected Float, Int, UInt, Char or "
                         "UChar of 1 to 8",
                         excerpt(kind), excerpt(precision)));
    }

    fs::path path_;
    std::string name_;
    std::vector<fs::path> chain_; ///< this document the last
    std::size_t& seen_;
    tinyxml2::XMLDocument document_;
    const XMLElement* domain_ = nullptr;
    std::vector<XdmfGrid> steps_;
};

} // namespace

std::vector<XdmfGrid> read_xdmf(const fs::path& path) {
    std::size_t seen = 0;
    return XdmfParser(path, {}, seen).steps();
}

std::vector<double> numbers_of_item(const XdmfItem& item) {
    const std::string name = item.document.string();
    if (item.where == XdmfItem::Where::document)
        return numbers_of(item.text, "a DataItem", name);
    if (item.where == XdmfItem::Where::plain || !item.start.empty())
        throw Error("{}: coordinates in another file, or a part of them, expected them in the "
                    "document or a dataset",
                    name);
    const XdmfHeavy heavy = heavy_of(item.text, item.document);
    const Hdf5File file(heavy.file);
    const auto dataset = file.dataset(heavy.path);
    if (!dataset)
        throw Error("{}: holds no dataset {}", file.name(), excerpt(heavy.path));
    return file.values(*dataset);
}

} // namespace isochron::index
