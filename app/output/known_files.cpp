// Recognizes the files that this program writes.
#include "app/output/known_files.h"

#include "app/output/page.h"
#include "app/output/picture_note.h"
#include "index/file/index_series.h"
#include "index/system/input_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <span>
#include <vector>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;

/// The first bytes of a file; empty where it cannot be read.
std::string beginning_of(const fs::path& path, std::size_t most) {
    std::string bytes(most, '\0');
    const index::InputFile file(path);
    bytes.resize(file.read(0, std::as_writable_bytes(std::span(bytes))));
    return bytes;
}

/// Whether a file holds nothing but ascending numbers below `cells`.
template <class Id>
bool holds_ids(const fs::path& path, std::uint64_t cells) {
    const index::InputFile file(path);
    if (file.size() % sizeof(Id) != 0)
        return false;
    constexpr std::size_t kAtOnce = 1 << 16;
    std::vector<Id> ids(kAtOnce);
    std::uint64_t least = 0; // that the next one may be
    for (std::uint64_t at = 0; at < file.size();) {
        const std::size_t bytes = file.read(at, std::as_writable_bytes(std::span(ids)));
        if (bytes == 0)
            return false;
        for (std::size_t i = 0; i < bytes / sizeof(Id); ++i) {
            if (ids[i] < least || ids[i] >= cells)
                return false;
            least = std::uint64_t{ids[i]} + 1;
        }
        at += bytes;
    }
    return true;
}

constexpr std::size_t kLooked = 1 << 20;

/// Rows first, as they are written; or, of older programs, objects whose keys stand in the order of the
/// alphabet.
bool is_report(const fs::path& path) {
    const std::string text = beginning_of(path, kLooked);
    if (text.starts_with("{\n \"program\": \"isochron "))
        return text.find(",\n \"rows\": [") != std::string::npos;
    return text.starts_with("{\n \"context\": ") &&
           text.find("\n \"program\": \"isochron ") != std::string::npos;
}

bool is_session(const fs::path& path) {
    const std::string text = beginning_of(path, kLooked);
    return text.starts_with("{\n") &&
           text.find("\n  \"format\": \"isochron session\"") != std::string::npos;
}

bool is_recording(const fs::path& path) {
    return names_format(path, "isochron recording");
}

bool is_manual_page(const fs::path& path) {
    return beginning_of(path, kLooked).starts_with(".\\\" Made by `isochron manual`");
}

bool is_of_kind(const fs::path& file, const Output& output) {
    switch (output.kind) {
    case OutputKind::index: return index::is_index(file);
    case OutputKind::ids:
        return holds_ids<std::uint32_t>(file, output.cells) ||
               holds_ids<std::uint64_t>(file, output.cells);
    case OutputKind::picture: return !note_text_in(file).empty() || !figure_note_in(file).empty();
    case OutputKind::report: return is_report(file);
    case OutputKind::session: return is_session(file);
    case OutputKind::manual_page: return is_manual_page(file);
    case OutputKind::configuration:
        return index::read_text(file, fs::file_size(file)) == output.content;
    case OutputKind::recording:
    case OutputKind::surface:
    case OutputKind::movie: break;
    }
    return false;
}

} // namespace

bool names_format(const fs::path& file, const std::string& format) {
    return beginning_of(file, kLooked).find("\"" + format + "\"") != std::string::npos;
}

bool is_known(const fs::path& file, const Output& output) {
    std::error_code ignored;
    const bool replaced_unasked = output.kind != OutputKind::recording &&
                                  output.kind != OutputKind::surface &&
                                  output.kind != OutputKind::movie;
    try {
        return (replaced_unasked && fs::file_size(file, ignored) == 0) || is_of_kind(file, output);
    } catch (const std::exception&) { // it cannot be read, so it is not known
        return false;
    }
}

std::string words_for(const fs::path& file) {
    std::error_code ignored;
    if (fs::is_directory(file, ignored))
        return "a folder";
    try {
        if (index::is_index(file))
            return "an index";
        if (is_recording(file))
            return "a recording";
        if (is_session(file))
            return "a session";
        if (is_report(file))
            return "a report";
        const std::string extension = file.extension().string();
        if ((extension == ".png" || extension == ".exr") && !note_text_in(file).empty())
            return "a picture of this program";
    } catch (const std::exception&) { // told by its size
    }
    return fmt::format("another file of {} bytes", fs::file_size(file, ignored));
}

} // namespace isochron::app
