// Remembers in small files in the user's folder.
#include "app/kept/user_memory.h"

#include "app/config/series_names.h"
#include "index/error.h"
#include "index/system/input_file.h"
#include "index/system/links/link.h"
#include "index/system/new_file.h"

#include <algorithm>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;

void write_text(const fs::path& path, const std::string& text) {
    try {
        index::make_folder(path.parent_path());
        index::write_file(path, text);
    } catch (const index::Error&) { // then nothing is remembered
    }
}

fs::path whole_name(const fs::path& data) {
    return index::is_link(data.native()) ? data : fs::absolute(data).lexically_normal();
}

/// What stands before the name of an array.
std::string key_of(const fs::path& data) {
    return whole_name(data).string() + "\t";
}

} // namespace

UserMemory::UserMemory(std::optional<fs::path> folder) : folder_(std::move(folder)) {}

std::vector<std::string> UserMemory::lines_of(const char* file) const {
    constexpr std::uint64_t kLargest = 1 << 16;
    std::vector<std::string> all;
    std::error_code error;
    if (!folder_ || !fs::is_regular_file(*folder_ / file, error))
        return all;
    try {
        const std::string lines = index::read_text(*folder_ / file, kLargest);
        for (std::size_t at = 0; at < lines.size();) {
            const std::size_t end = std::min(lines.find('\n', at), lines.size());
            all.push_back(lines.substr(at, end - at));
            at = end + 1;
        }
    } catch (const index::Error&) { // then nothing is remembered
    }
    return all;
}

std::vector<fs::path> UserMemory::recent() const {
    std::vector<fs::path> paths;
    std::error_code error;
    for (const fs::path path : lines_of("recent"))
        if (paths.size() < kMost &&
            (index::is_link(path.native()) || fs::exists(path, error) ||
             (is_pattern(path.filename().string()) && fs::exists(path.parent_path(), error))))
            paths.push_back(path);
    return paths;
}

std::string UserMemory::array_of(const fs::path& data) const {
    const std::string key = key_of(data);
    for (const std::string& line : lines_of("arrays"))
        if (line.starts_with(key))
            return line.substr(key.size());
    return {};
}

void UserMemory::remember_array(const fs::path& data, const std::string& array) {
    constexpr std::size_t kMostArrays = 100;
    const std::string key = key_of(data);
    if (!folder_ || (key + array).find('\n') != std::string::npos)
        return;
    std::string lines = key + array + "\n";
    std::size_t kept = 1;
    for (const std::string& line : lines_of("arrays"))
        if (!line.starts_with(key) && kept++ < kMostArrays)
            lines += line + "\n";
    write_text(*folder_ / "arrays", lines);
}

void UserMemory::remember(const fs::path& data) {
    if (!folder_)
        return;
    const fs::path newest = whole_name(data);
    std::string lines = newest.string() + "\n";
    for (const fs::path& path : recent())
        if (path != newest)
            lines += path.string() + "\n";
    write_text(*folder_ / "recent", lines);
}

bool UserMemory::has(const char* file) const {
    std::error_code error;
    return !folder_ || fs::exists(*folder_ / file, error);
}

void UserMemory::keep(const char* file) const {
    if (folder_)
        write_text(*folder_ / file, "The first lines were shown.\n");
}

} // namespace isochron::app
