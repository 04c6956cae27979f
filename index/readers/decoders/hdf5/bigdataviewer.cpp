// Reads what BigDataViewer says of its views.
//
// T. Pietzsch and others, "BigDataViewer: visualization and processing for large image data sets",
// Nature Methods 12, 2015, doi:10.1038/nmeth.3392; https://imagej.net/plugins/bdv.
#include "index/readers/decoders/hdf5/bigdataviewer.h"

#include "index/error.h"
#include "index/readers/formats/text_header.h"
#include "index/readers/formats/unread_fields.h"
#include "index/system/input_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tinyxml2.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <system_error>
#include <utility>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;

using Element = tinyxml2::XMLElement;

/// The element along names from the root's child on; null: it is not there.
const Element* element_at(const Element* from, std::initializer_list<const char*> names) {
    for (const char* name : names)
        from = from ? from->FirstChildElement(name) : nullptr;
    return from;
}

std::string text_in(const Element* element) {
    return element && element->GetText() ? std::string(trimmed(element->GetText())) : std::string();
}

/// Numbers between blanks; those that are none are left out.
std::vector<double> numbers_in(const std::string& text) {
    std::vector<double> numbers;
    for (const std::string& word : words_of(text))
        if (double number = 0;
            std::from_chars(word.data(), word.data() + word.size(), number).ec == std::errc())
            numbers.push_back(number);
    return numbers;
}

/// Setup and level of `/t00000/s01/2/cells`.
std::optional<std::pair<std::string, std::size_t>> view_in(const std::string& array) {
    std::vector<std::string> parts;
    for (std::size_t at = 0; at < array.size();) {
        const std::size_t end = std::min(array.find('/', at), array.size());
        if (end > at)
            parts.push_back(array.substr(at, end - at));
        at = end + 1;
    }
    if (parts.size() != 4 || !parts[0].starts_with('t') || !parts[1].starts_with('s') ||
        parts[3] != "cells")
        return std::nullopt;
    std::size_t level = 0;
    const auto [end, failure] =
        std::from_chars(parts[2].data(), parts[2].data() + parts[2].size(), level);
    if (failure != std::errc() || end != parts[2].data() + parts[2].size())
        return std::nullopt;
    return std::pair(parts[1], level);
}

/// Whether a view is moved or turned besides being scaled.
bool is_moved(const Element* registration) {
    for (const Element* transform = element_at(registration, {"ViewTransform"}); transform;
         transform = transform->NextSiblingElement("ViewTransform")) {
        const std::vector<double> m = numbers_in(text_in(element_at(transform, {"affine"})));
        for (std::size_t i = 0; i < m.size() && m.size() == 12; ++i)
            if (i % 5 != 0 && m[i] != 0)
                return true;
    }
    return false;
}

} // namespace

bool is_bigdataviewer(const Hdf5File& file) {
    return file.holds("/s00/resolutions") && file.holds("/s00/subdivisions");
}

std::string view_of_bigdataviewer(const Hdf5File& file) {
    constexpr int kMost = 1000;
    std::vector<std::string> views;
    for (int setup = 0; setup < kMost && file.holds(fmt::format("/s{:02}/resolutions", setup));
         ++setup)
        views.push_back(fmt::format("/t*/s{:02}/0/cells", setup));
    if (views.size() > 1)
        throw Error("{}: several setups of BigDataViewer, choose one with --array: '{}'",
                    file.name(), fmt::join(views, "', '"));
    return views.front();
}

void take_bigdataviewer(const Hdf5File& file, const Hdf5Dataset& view, StatedArray& array,
                        std::vector<std::string>& notes) {
    const auto parts = view_in(view.path);
    if (!parts || array.axes.size() != 3)
        return;
    const auto& [setup, level] = *parts;
    std::string unit;
    glm::dvec3 factor(1.0), size(1.0);
    if (const auto resolutions = file.dataset("/" + setup + "/resolutions")) {
        const std::vector<double> all = file.values(*resolutions);
        for (std::size_t axis = 0; axis < 3 && 3 * level + 2 < all.size(); ++axis)
            if (all[3 * level + axis] > 0)
                factor[static_cast<int>(axis)] = all[3 * level + axis];
    }
    const fs::path beside = fs::path(file.name()).replace_extension(".xml");
    std::error_code ignored;
    tinyxml2::XMLDocument document;
    constexpr std::uint64_t kMost = std::uint64_t{64} << 20;
    const std::string text = fs::is_regular_file(beside, ignored) ? read_text(beside, kMost) : "";
    const Element* root = nullptr;
    if (document.Parse(text.c_str(), text.size()) == tinyxml2::XML_SUCCESS)
        root = document.RootElement();
    else if (!text.empty())
        throw Error("{}: damaged XML: {}", beside.string(), document.ErrorName());
    if (!root)
        notes.push_back(fmt::format("{} is not there, which has the size of the voxels",
                                    beside.filename().string()));
    const std::string id = std::to_string(std::atoi(setup.c_str() + 1));
    const Element* described = element_at(root, {"SequenceDescription", "ViewSetups", "ViewSetup"});
    while (described && text_in(element_at(described, {"id"})) != id)
        described = described->NextSiblingElement("ViewSetup");
    const std::vector<double> stated =
        numbers_in(text_in(element_at(described, {"voxelSize", "size"})));
    if (stated.size() == 3 &&
        std::ranges::all_of(stated, [](double s) { return s > 0 && s < 1e30; })) {
        size = {stated[0], stated[1], stated[2]};
        unit = text_in(element_at(described, {"voxelSize", "unit"}));
    }
    for (int axis = 0; axis < 3; ++axis) { // vertices are the centers of what they stand for
        StatedAxis& along = array.axes[static_cast<std::size_t>(2 - axis)];
        along.step = size[axis] * factor[axis];
        along.first = size[axis] * (factor[axis] - 1) / 2;
        along.unit = unit;
        along.regular = true;
    }
    for (const Element* registration = element_at(root, {"ViewRegistrations", "ViewRegistration"});
         registration; registration = registration->NextSiblingElement("ViewRegistration"))
        if (registration->IntAttribute("setup", -1) == std::atoi(id.c_str()) &&
            is_moved(registration)) {
            if (auto note = note_on_unread({"ViewRegistrations, which move or turn the view"}))
                notes.push_back(std::move(*note));
            break;
        }
    if (view.type == StoredType::i16)
        notes.emplace_back("BigDataViewer stores unsigned values as i16: those above 32767 are "
                           "negative here");
}

} // namespace isochron::index
