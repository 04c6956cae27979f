// Hyperstacks as descriptions have them.
#include "index/readers/decoders/tiff/tiff_metadata.h"

#include "index/error.h"
#include "index/readers/decoders/tiff/tiff_microscopes.h"
#include "index/readers/formats/length_units.h"
#include "index/readers/formats/text_header.h"
#include "index/readers/formats/unread_fields.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tinyxml2.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <string_view>

namespace isochron::index {
namespace {

constexpr std::size_t kMostPlanes = 1 << 22;

std::size_t checked_count(double value, const std::string& what, const std::string& file) {
    if (!(value >= 1) || value > static_cast<double>(kMostPlanes) || value != std::floor(value))
        throw Error("{}: {} {} in its description, expected 1 to {}", file, what, value,
                    kMostPlanes);
    return static_cast<std::size_t>(value);
}

/// Number of planes, also where it is beyond whole numbers.
double product_of(const TiffStack& stack) {
    return static_cast<double>(stack.channels) * static_cast<double>(stack.slices) *
           static_cast<double>(stack.frames);
}

const tinyxml2::XMLElement* child(const tinyxml2::XMLNode* node, const char* name) {
    for (auto* each = node->FirstChildElement(); each; each = each->NextSiblingElement()) {
        const std::string full = each->Name();
        if (full.substr(full.rfind(':') + 1) == name)
            return each;
    }
    return nullptr;
}

const tinyxml2::XMLElement* next(const tinyxml2::XMLElement* element) {
    return element->NextSiblingElement(element->Name());
}

double attribute_of_ome(const tinyxml2::XMLElement& element, const char* name, double otherwise) {
    double value = otherwise;
    element.QueryDoubleAttribute(name, &value);
    return value;
}

std::string text_of_ome(const tinyxml2::XMLElement& element, const char* name,
                        const std::string& otherwise) {
    const char* text = element.Attribute(name);
    return text ? text : otherwise;
}

/// Where the planes of an OME file are, in the order of `TiffStack::planes`.
class OmePlanes {
  public:
    OmePlanes(const tinyxml2::XMLElement& pixels, const TiffStack& stack, const std::string& file)
        : order_(text_of_ome(pixels, "DimensionOrder", "XYCZT")),
          sizes_{{'C', stack.channels}, {'Z', stack.slices}, {'T', stack.frames}},
          planes_(stack.channels * stack.slices * stack.frames) {
        std::string sorted = order_;
        std::ranges::sort(sorted);
        if (sorted != "CTXYZ" || !order_.starts_with("XY"))
            throw Error("{}: DimensionOrder {}, expected XY and then C, Z and T", file, order_);
        const auto* data = child(&pixels, "TiffData");
        if (!data)
            fill({}, 0, 0, planes_.size());
        for (; data; data = next(data))
            take(*data);
    }

    std::vector<TiffPlane> take_all() { return std::move(planes_); }

  private:
    void take(const tinyxml2::XMLElement& data) {
        const auto number = [&](const char* name, std::size_t otherwise) {
            const double value = attribute_of_ome(data, name, static_cast<double>(otherwise));
            return value >= 0 && value < 1e9 ? static_cast<std::size_t>(value) : planes_.size();
        };
        const bool all = !data.FindAttribute("IFD") && !data.FindAttribute("PlaneCount");
        const std::size_t count = number("PlaneCount", all && !next(&data) ? planes_.size() : 1);
        std::map<char, std::size_t> first{
            {'C', number("FirstC", 0)}, {'Z', number("FirstZ", 0)}, {'T', number("FirstT", 0)}};
        std::size_t place = 0, stride = 1; // in the file's order
        for (const char axis : order_.substr(2)) {
            if (first[axis] >= sizes_[axis])
                return;
            place += first[axis] * stride;
            stride *= sizes_[axis];
        }
        std::string other;
        if (const auto* uuid = child(&data, "UUID"))
            other = text_of_ome(*uuid, "FileName", "");
        fill(other, number("IFD", 0), place, count);
    }

    /// Places `count` planes, from `place` on in the file's order: one page after the other.
    void fill(const std::string& file, std::size_t page, std::size_t place, std::size_t count) {
        for (std::size_t i = 0; i < count && place + i < planes_.size(); ++i) {
            std::map<char, std::size_t> at;
            std::size_t rest = place + i;
            for (const char axis : order_.substr(2)) {
                at[axis] = rest % sizes_[axis];
                rest /= sizes_[axis];
            }
            planes_[at['C'] + sizes_['C'] * (at['Z'] + sizes_['Z'] * at['T'])] = {file, page + i,
                                                                                  true};
        }
    }

    std::string order_;
    std::map<char, std::size_t> sizes_;
    std::vector<TiffPlane> planes_;
};

std::map<std::string, std::string> lines_of(const std::string& description) {
    std::map<std::string, std::string> values;
    std::istringstream lines(description);
    for (std::string line; std::getline(lines, line);)
        if (const std::size_t equals = line.find('='); equals != std::string::npos)
            values[std::string(trimmed(line.substr(0, equals)))] =
                std::string(trimmed(line.substr(equals + 1)));
    return values;
}

/// `{"shape": [7, 3, 480, 640]}`, as tifffile writes it; the pages' own axes last.
std::optional<TiffStack> shaped_stack(const std::string& description, std::size_t pages,
                                      std::uint32_t samples) {
    const auto json = nlohmann::json::parse(description, nullptr, false);
    if (!json.is_object() || !json.contains("shape") || !json["shape"].is_array())
        return std::nullopt;
    std::vector<std::size_t> sizes;
    for (const auto& size : json["shape"])
        if (size.is_number_unsigned() && size != 1u)
            sizes.push_back(size);
    const std::size_t of_page = samples > 1 ? 3 : 2;
    if (sizes.size() != of_page + 2 || sizes[1] == 0 || pages % sizes[1] != 0 ||
        sizes[0] * sizes[1] != pages)
        return std::nullopt;
    TiffStack stack{.slices = sizes[1], .frames = sizes[0]};
    stack.notes.push_back(
        fmt::format("the first axis of its shape {} is taken for time", json["shape"].dump()));
    return stack;
}

} // namespace

namespace {

/// Times of planes, and what else is said of them.
void take_planes_of_ome(const tinyxml2::XMLElement& pixels, const tinyxml2::XMLElement& image,
                        TiffStack& stack) {
    std::vector<std::string> unread;
    std::map<std::size_t, double> times;
    bool placed = false;
    std::string unit = "s";
    for (const auto* plane = child(&pixels, "Plane"); plane; plane = next(plane)) {
        const double frame = attribute_of_ome(*plane, "TheT", 0);
        if (plane->FindAttribute("DeltaT") && frame >= 0 && frame < 1e9) {
            times.try_emplace(static_cast<std::size_t>(frame),
                              attribute_of_ome(*plane, "DeltaT", 0));
            unit = text_of_ome(*plane, "DeltaTUnit", "s");
        }
        for (const char* name : {"PositionX", "PositionY", "PositionZ"})
            placed = placed || attribute_of_ome(*plane, name, 0) != 0;
    }
    if (placed)
        unread.emplace_back("positions of the planes on the stage (--origin)");
    if (child(&image, "StageLabel"))
        unread.emplace_back("StageLabel (--origin)");
    if (!(stack.time.step > 0 && stack.time.regular) && times.size() == stack.frames &&
        stack.frames > 1) {
        for (const auto& [frame, time] : times)
            stack.time.at.push_back(time);
        const bool increasing =
            std::ranges::adjacent_find(stack.time.at, std::greater_equal()) == stack.time.at.end();
        stack.time.unit = unit;
        if (!increasing) {
            stack.time.at.clear();
            unread.emplace_back("DeltaT of the planes, which does not increase");
        }
    }
    if (auto note = note_on_unread(unread))
        stack.notes.push_back(std::move(*note));
}

} // namespace

std::string ome_metadata_file(const std::string& description) {
    tinyxml2::XMLDocument document;
    if (description.find("BinaryOnly") == description.npos ||
        document.Parse(description.c_str(), description.size()) != tinyxml2::XML_SUCCESS ||
        !document.RootElement())
        return {};
    const auto* only = child(document.RootElement(), "BinaryOnly");
    return only ? text_of_ome(*only, "MetadataFile", "") : "";
}

namespace {

/// Names of images: those that several have are given by the images' identifiers.
std::vector<std::string> names_of_images(const tinyxml2::XMLElement& root) {
    std::vector<std::string> names;
    for (const auto* image = child(&root, "Image"); image; image = next(image)) {
        std::string name = text_of_ome(*image, "Name", "");
        if (name.empty() || std::ranges::find(names, name) != names.end())
            name = text_of_ome(*image, "ID", fmt::format("Image:{}", names.size()));
        names.push_back(std::move(name));
    }
    return names;
}

/// Whether planes of an image are in a file, as far as it says where they are.
bool has_planes_in(const tinyxml2::XMLElement& image, const std::string& file) {
    const auto* pixels = child(&image, "Pixels");
    for (const auto* data = pixels ? child(pixels, "TiffData") : nullptr; data; data = next(data))
        if (const auto* uuid = child(data, "UUID");
            uuid && text_of_ome(*uuid, "FileName", "") == file)
            return true;
    return false;
}

/// The image that an array's name means, `Pos1` or `Image:1`, also before a channel: `Pos1/GFP`. Else
/// the first one with planes in the file, or the first.
std::size_t image_named(const tinyxml2::XMLElement& root, const std::vector<std::string>& names,
                        const std::string& array, const std::string& file) {
    const auto means = [&](const std::string& name) {
        return array == name || array.starts_with(name + "/");
    };
    std::size_t number = 0;
    for (const auto* image = child(&root, "Image"); image; image = next(image), ++number)
        if (means(names[number]) || means(text_of_ome(*image, "ID", names[number])))
            return number;
    number = 0;
    const std::string name = std::filesystem::path(file).filename().string();
    for (const auto* image = child(&root, "Image"); image; image = next(image), ++number)
        if (has_planes_in(*image, name))
            return number;
    return 0;
}

} // namespace

TiffStack ome_stack(const std::string& description, std::uint32_t samples, const std::string& array,
                    const std::string& file) {
    tinyxml2::XMLDocument document;
    if (document.Parse(description.c_str(), description.size()) != tinyxml2::XML_SUCCESS)
        throw Error("{}: damaged OME-XML: {}", file, document.ErrorName());
    const auto* root = document.RootElement();
    const auto* image = root ? child(root, "Image") : nullptr;
    TiffStack stack;
    if (image && next(image)) {
        stack.images = names_of_images(*root);
        stack.image = image_named(*root, stack.images, array, file);
        for (std::size_t i = 0; i < stack.image; ++i)
            image = next(image);
    }
    const auto* pixels = image ? child(image, "Pixels") : nullptr;
    if (!pixels)
        throw Error("{}: its OME-XML has no pixels", file);
    const auto size = [&](const char* name) {
        return checked_count(attribute_of_ome(*pixels, name, 1), name, file);
    };
    stack.channels = std::max<std::size_t>(size("SizeC") / samples, 1);
    stack.slices = size("SizeZ");
    stack.frames = size("SizeT");
    if (product_of(stack) > kMostPlanes)
        throw Error("{}: more than {} planes", file, kMostPlanes);
    const std::array<std::string, 3> names{"PhysicalSizeX", "PhysicalSizeY", "PhysicalSizeZ"};
    for (std::size_t axis = 0; axis < 3; ++axis)
        set_spacing(stack.axes[axis], attribute_of_ome(*pixels, names[axis].c_str(), 0),
                    text_of_ome(*pixels, (names[axis] + "Unit").c_str(), "\u00b5m"));
    stack.time.regular = pixels->FindAttribute("TimeIncrement") != nullptr;
    stack.time.step = attribute_of_ome(*pixels, "TimeIncrement", 0);
    stack.time.unit = text_of_ome(*pixels, "TimeIncrementUnit", "s");
    for (const auto* channel = child(pixels, "Channel"); channel; channel = next(channel))
        stack.channel_names.push_back(text_of_ome(*channel, "Name", ""));
    take_planes_of_ome(*pixels, *image, stack);
    if (!stack.images.empty()) {
        const std::string& other = stack.images[stack.image == 0 ? 1 : 0];
        stack.notes.push_back(fmt::format("holds {} images: {} is read, --array '{}' reads another",
                                          stack.images.size(), stack.images[stack.image], other));
    }
    stack.planes = OmePlanes(*pixels, stack, file).take_all();
    return stack;
}

namespace {

/// The functions of ImageJ's Calibration.java by which stored values are shown: only the first is linear.
void take_calibration(const std::map<std::string, std::string>& values, const auto& number,
                      TiffStack& stack) {
    constexpr double kStraightLine = 0, kNone = 20;
    static const std::set<std::string_view> kRead{
        "ImageJ",    "images", "channels", "slices",  "frames",  "hyperstack", "mode",
        "unit",      "yunit",  "zunit",    "spacing", "loop",    "min",        "max",
        "finterval", "fps",    "tunit",    "xorigin", "yorigin", "zorigin",    "cf",
        "c0",        "c1",     "vunit",    "inverty", "axes",    "order"};
    std::vector<std::string> unread = fields_besides(kRead, values);
    const double function = values.contains("cf") ? number("cf", kNone) : kNone;
    const double slope = number("c1", 1), intercept = number("c0", 0);
    if (function == kStraightLine && slope != 0 && std::isfinite(slope) && std::isfinite(intercept))
        stack.scaling = {slope, intercept};
    else if (function != kNone)
        unread.push_back(
            fmt::format("calibration function {} (values are those stored)", function));
    if (const auto unit = values.find("vunit"); unit != values.end() && function == kStraightLine &&
                                                unit->second != "Gray Value" &&
                                                unit->second != "gray value")
        stack.value_unit = unit->second;
    if (const auto inverted = values.find("inverty");
        inverted != values.end() && inverted->second == "true")
        unread.emplace_back("inverty (y counts downwards)");
    if (const auto rate = values.find("fps"); rate != values.end())
        unread.push_back(fmt::format("fps {} (a speed of playback, not the data's time)",
                                     excerpt(rate->second)));
    if (auto note = note_on_unread(unread))
        stack.notes.push_back(std::move(*note));
}

} // namespace

namespace {

/// Pages that follow each other along other axes than `czt`, fastest first.
void order_planes(const std::string& order, TiffStack& stack) {
    std::string sorted = order;
    std::ranges::sort(sorted);
    if (sorted != "ctz") {
        if (order != "default" && order != "xyczt(default)")
            stack.notes.push_back(
                fmt::format("stated and not used: order {}, expected czt or another one of the "
                            "three",
                            excerpt(order)));
        return;
    }
    std::map<char, std::size_t> stride;
    std::size_t pages = 1;
    for (const char axis : order) {
        stride[axis] = pages;
        pages *= axis == 'c' ? stack.channels : axis == 'z' ? stack.slices : stack.frames;
    }
    for (std::size_t t = 0; t < stack.frames; ++t)
        for (std::size_t z = 0; z < stack.slices; ++z)
            for (std::size_t c = 0; c < stack.channels; ++c)
                stack.planes.push_back(
                    {"", c * stride['c'] + z * stride['z'] + t * stride['t'], true});
}

} // namespace

TiffStack imagej_stack(const std::string& description, std::size_t pages, double x_resolution,
                       double y_resolution, const std::string& file) {
    const auto values = lines_of(description);
    const auto number = [&](const char* key, double otherwise) {
        const auto found = values.find(key);
        if (found == values.end())
            return otherwise;
        double value = otherwise;
        std::from_chars(found->second.data(), found->second.data() + found->second.size(), value);
        return value;
    };
    TiffStack stack{.channels = checked_count(number("channels", 1), "channels", file),
                    .slices = checked_count(number("slices", 1), "slices", file),
                    .frames = checked_count(number("frames", 1), "frames", file)};
    const std::size_t images =
        checked_count(number("images", static_cast<double>(pages)), "images", file);
    if (product_of(stack) != static_cast<double>(images)) {
        stack.channels = stack.frames = 1; // a plain stack says nothing else
        stack.slices = images;
    }
    stack.appended = pages == 1 && images > 1;
    if (const auto order = values.find("order"); order != values.end() && order->second != "czt")
        order_planes(order->second, stack);
    const auto text = [&](const char* key, const std::string& otherwise) {
        const auto found = values.find(key);
        return found == values.end() || found->second.empty() ? otherwise : found->second;
    };
    const std::string x_unit = text("unit", "");
    const std::array<std::string, 3> units{x_unit, text("yunit", x_unit), text("zunit", x_unit)};
    const bool sized = std::ranges::any_of(
        units, [](const std::string& unit) { return !tidy_length_unit(unit).empty(); });
    const bool resolved = x_resolution > 0 && y_resolution > 0 && sized;
    set_spacing(stack.axes[0], resolved ? 1 / x_resolution : 1, units[0]);
    set_spacing(stack.axes[1], resolved ? 1 / y_resolution : 1, units[1]);
    set_spacing(stack.axes[2], std::abs(number("spacing", 1)), units[2]);
    // The origin is the pixel that lies at zero.
    const std::array<const char*, 3> origins{"xorigin", "yorigin", "zorigin"};
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (const double pixel = number(origins[axis], 0); std::isfinite(pixel) && pixel != 0)
            stack.axes[axis].first = -pixel * stack.axes[axis].step;
    take_calibration(values, number, stack);
    stack.time.regular = values.contains("finterval");
    stack.time.step = number("finterval", 0);
    stack.time.unit = text("tunit", "s");
    if (stack.time.unit == "sec")
        stack.time.unit = "s";
    return stack;
}

TiffStack stack_of(const std::string& description, std::size_t pages, std::uint32_t samples,
                   double x_resolution, double y_resolution, const std::string& array,
                   const std::string& file) {
    if (description.find("<OME") != std::string::npos)
        return ome_stack(description.substr(description.find('<')), samples, array, file);
    if (description.starts_with("ImageJ="))
        return imagej_stack(description, pages, x_resolution, y_resolution, file);
    if (auto stack = shaped_stack(description, pages, samples))
        return *stack;
    if (auto stack = scanimage_stack(description, pages))
        return *stack;
    return TiffStack{.slices = pages};
}

void keep_whole_frames(TiffStack& stack, const std::function<bool(const TiffPlane&)>& is_there,
                       const std::string& file) {
    if (product_of(stack) > kMostPlanes)
        throw Error("{}: more than {} planes", file, kMostPlanes);
    const std::size_t of_frame = stack.channels * stack.slices, all = of_frame * stack.frames;
    if (stack.planes.empty() && is_there({"", all - 1, true}))
        return;
    if (stack.planes.empty())
        for (std::size_t page = 0; page < all; ++page)
            stack.planes.push_back({"", page, true});
    const auto lacks = [&](const TiffPlane& plane) { return !plane.there || !is_there(plane); };
    const auto missing = static_cast<std::size_t>(std::ranges::count_if(stack.planes, lacks));
    if (missing == 0)
        return;
    const bool timed = stack.time.at.size() == stack.frames;
    const bool stepped = stack.time.regular && stack.time.step > 0;
    TiffStack whole = stack;
    whole.planes.clear();
    whole.time.at.clear();
    whole.frames = 0;
    bool gap = false;
    for (std::size_t frame = 0; frame < stack.frames; ++frame) {
        const auto begin = stack.planes.begin() + static_cast<std::ptrdiff_t>(frame * of_frame),
                   end = begin + static_cast<std::ptrdiff_t>(of_frame);
        if (std::any_of(begin, end, lacks))
            continue;
        gap = gap || frame != whole.frames;
        whole.planes.insert(whole.planes.end(), begin, end);
        if (timed || stepped)
            whole.time.at.push_back(timed ? stack.time.at[frame]
                                          : static_cast<double>(frame) * stack.time.step);
        ++whole.frames;
    }
    const std::string lacking =
        fmt::format("{} of {} planes are missing, as of a stopped run", missing, all);
    if (whole.frames == 0)
        throw Error("{}: {}: none of its {} step{} is whole", file, lacking, stack.frames,
                    stack.frames == 1 ? "" : "s");
    if (!timed && !gap) // they begin at 0, and are equally far apart
        whole.time.at.clear();
    whole.notes.push_back(fmt::format("{}: the {} whole step{} of {} {} read", lacking,
                                      whole.frames, whole.frames == 1 ? "" : "s", stack.frames,
                                      whole.frames == 1 ? "is" : "are"));
    stack = std::move(whole);
}

} // namespace isochron::index
