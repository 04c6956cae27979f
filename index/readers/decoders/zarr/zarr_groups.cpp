// Reads descriptions of groups.
//
// J. Moore and others, "Next-generation file formats (NGFF)", versions 0.4 and 0.5,
// https://ngff.openmicroscopy.org.
#include "index/readers/decoders/zarr/zarr_groups.h"

#include "index/error.h"

#include <initializer_list>
#include <utility>

namespace isochron::index {

using nlohmann::json;

json attributes_of_group(const ZarrStore& store, const std::string& group) {
    const std::string prefix = group.empty() ? "" : group + "/";
    for (const char* file : {"zarr.json", ".zattrs"}) {
        const auto bytes = store.read(prefix + file);
        if (!bytes)
            continue;
        const auto* text = reinterpret_cast<const char*>(bytes->data());
        json parsed = json::parse(text, text + bytes->size(), nullptr, false);
        if (!parsed.is_object())
            throw Error("{}: {}{} is no JSON object", store.name(), prefix, file);
        return std::string(file) == "zarr.json" ? parsed.value("attributes", json::object())
                                                : parsed;
    }
    return json::object();
}

json multiscale_of(const json& attributes) {
    for (const json& place : {attributes.value("ome", json::object()), attributes})
        if (const auto found = place.find("multiscales");
            found != place.end() && found->is_array() && !found->empty())
            return found->front();
    return {};
}

ZarrLevel level_of(const ZarrStore& store, const std::string& array) {
    for (std::string group = array; !group.empty();) {
        const std::size_t end = group.rfind('/');
        group.resize(end == group.npos ? 0 : end);
        ZarrLevel level{
            .attributes = attributes_of_group(store, group), .image = {}, .dataset = {}};
        level.image = multiscale_of(level.attributes);
        const json datasets =
            level.image.is_object() ? level.image.value("datasets", json::array()) : json::array();
        for (const json& dataset : datasets)
            if (dataset.is_object() &&
                (group.empty() ? "" : group + "/") + dataset.value("path", "") == array) {
                level.dataset = dataset;
                return level;
            }
    }
    return {.attributes = attributes_of_group(store, ""), .image = {}, .dataset = {}};
}

void find_arrays(const ZarrStore& store, const std::string& group, int depth,
                 std::vector<std::string>& paths) {
    constexpr int kDeepest = 6;
    constexpr std::size_t kMost = 20'000;
    for (const std::string& name : store.names(group)) {
        if (depth >= kDeepest || paths.size() >= kMost || name.starts_with('.') ||
            name == "zarr.json")
            continue;
        const std::string path = group.empty() ? name : group + "/" + name;
        if (store.read(path + "/.zarray")) {
            paths.push_back(path);
            continue;
        }
        const auto v3 = store.read(path + "/zarr.json");
        const auto* text = v3 ? reinterpret_cast<const char*>(v3->data()) : nullptr;
        const json parsed = v3 ? json::parse(text, text + v3->size(), nullptr, false) : json();
        if (parsed.is_object() && parsed.value("node_type", "") == "array")
            paths.push_back(path);
        else if (v3 || store.read(path + "/.zgroup"))
            find_arrays(store, path, depth + 1, paths);
    }
}

std::string tidy_unit_of_ome(const std::string& unit) {
    for (const auto& [known, tidy] :
         std::initializer_list<std::pair<const char*, const char*>>{{"micrometer", "um"},
                                                                    {"nanometer", "nm"},
                                                                    {"millimeter", "mm"},
                                                                    {"meter", "m"},
                                                                    {"angstrom", "angstrom"},
                                                                    {"second", "s"},
                                                                    {"millisecond", "ms"},
                                                                    {"minute", "min"},
                                                                    {"hour", "h"}})
        if (unit == known)
            return tidy;
    return unit;
}

} // namespace isochron::index
