// Lists of files in JSON.
#include "index/readers/formats/series/json_series.h"

#include "index/error.h"
#include "index/readers/formats/named_file.h"
#include "index/system/input_file.h"

#include <nlohmann/json.hpp>

namespace isochron::index {

ListedFiles read_json_series(const std::filesystem::path& path) {
    constexpr std::uint64_t kLargest = std::uint64_t{64} << 20;
    const std::string name = path.string();
    const auto json = nlohmann::json::parse(read_text(path, kLargest), nullptr, false);
    if (!json.is_object() || !json.contains("files") || !json["files"].is_array())
        throw Error(
            "{}: no list of files, expected {{\"files\": [{{\"name\": ..., \"time\": ...}}, ...]}}",
            name);
    ListedFiles files;
    for (const auto& file : json["files"]) {
        if (!file.is_object() || !file.contains("name") || !file["name"].is_string() ||
            !file.contains("time") || !file["time"].is_number())
            throw Error("{}: file {} has no name, or no time that is a number", name, files.size());
        files.push_back({.path = file_named_in(path, file["name"].get<std::string>()),
                         .time = file["time"].get<double>()});
    }
    if (files.empty())
        throw Error("{}: an empty list of files", name);
    return files;
}

} // namespace isochron::index
