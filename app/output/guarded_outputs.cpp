// What commands may write over.
#include "app/output/guarded_outputs.h"

#include "app/output/movie_file.h"
#include "index/error.h"
#include "index/readers/formats/format.h"
#include "index/readers/formats/series/file_series.h"
#include "index/system/input_file.h"
#include "index/system/new_file.h"
#include "index/system/whole_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;

std::string_view words_of(OutputKind kind) {
    switch (kind) {
    case OutputKind::index: return "an isochron index";
    case OutputKind::ids: return "a file of ascending ids of cells of this index";
    case OutputKind::picture: return "a picture that this program wrote";
    case OutputKind::report: return "a report";
    case OutputKind::session: return "a session";
    case OutputKind::manual_page: return "a manual page that this program wrote";
    case OutputKind::configuration: return "the same configuration";
    case OutputKind::recording:
    case OutputKind::surface:
    case OutputKind::movie: break;
    }
    return {};
}

/// Where outputs lie, most of which share their folder: it is looked up once.
class Places {
  public:
    fs::path of(const fs::path& file) {
        const fs::path folder = file.parent_path();
        const auto [known, is_new] = folders_.try_emplace(folder.native());
        if (is_new)
            known->second = index::whole_path(folder.empty() ? fs::path(".") : folder);
        return known->second / file.filename();
    }

  private:
    std::map<std::string, fs::path> folders_;
};

/// Whether a file that may name others names this one.
bool is_named_in(const fs::path& naming, const std::string& name) {
    constexpr std::uint64_t kMost = std::uint64_t{64} << 20;
    const index::Format* format = index::known_file(naming).format;
    if (!format || !format->names_files)
        return false;
    try {
        const index::InputFile file(naming);
        std::string text(std::min(file.size(), kMost), '\0');
        text.resize(file.read(0, std::as_writable_bytes(std::span(text))));
        return text.find(name) != std::string::npos;
    } catch (const index::Error&) { // who reads it says so
        return false;
    }
}

/// An output that exists.
struct Found {
    fs::path path;
    bool known = false;  ///< a file of ours, by all that can be told
    bool marked = false; ///< and beyond doubt, so that it is no part of anybody's data
};

/// What writing over a file would do to one that is read; empty: nothing.
std::optional<std::string> harm_to(const fs::path& input, const Found& found) {
    std::error_code ignored;
    if (fs::equivalent(input, found.path, ignored))
        return "is an input";
    if (found.marked)
        return std::nullopt;
    fs::path folder = index::described_folder(index::known_file(input).path);
    // In other folders, files of values are read.
    if (folder.empty() && fs::is_directory(input, ignored) &&
        !(found.known && !index::known_file(found.path).format))
        folder = input;
    if (!folder.empty() &&
        index::lies_within(index::whole_path(found.path), index::whole_path(folder)))
        return fmt::format("is an input, as {} is read", folder.string());
    const std::string name = found.path.filename().string(),
                      real = index::whole_path(found.path).filename().string();
    if (is_named_in(input, name) || (real != name && is_named_in(input, real)))
        return fmt::format("is an input, as {} names it", input.string());
    return std::nullopt;
}

/// Whether an index was built of this file, by its name or by its size and time.
bool is_source_of(const index::IndexFile& index, const fs::path& file) {
    const std::string name = index::whole_path(file).filename().string();
    std::uint64_t state = 0;
    try {
        const index::FileState now = index::state_of(file);
        state = index::number_of(std::span(&now, 1));
    } catch (const index::Error&) { // a folder, or it cannot be read
    }
    for (std::size_t i = 0; i < index.arrays(); ++i) {
        const index::IndexFile& array = index.array(i);
        const auto& sources = array.info().sources;
        if (std::ranges::find(sources, name) != sources.end() ||
            std::ranges::find(sources, file.filename().string()) != sources.end() ||
            (state != 0 &&
             std::ranges::find(array.source_states(), state) != array.source_states().end()))
            return true;
    }
    return false;
}

/// What is known of where the sources of an index are: where it refers to them, and files of their
/// names beside or around an output.
std::vector<fs::path> sources_near(const index::IndexFile& index, const fs::path& output) {
    std::vector<fs::path> near;
    if (const auto& referral = index.referral())
        for (const fs::path& file : referral->files)
            near.push_back(fs::path(index.name()).parent_path() / file);
    constexpr int kDeepest = 6; // levels of folders in a store
    const auto& names = index.info().sources;
    if (names.empty())
        return near;
    fs::path folder = index::whole_path(output).parent_path();
    for (int up = 0; up < kDeepest && folder.has_relative_path(); ++up) {
        std::error_code ignored;
        for (const std::string& name : std::set<std::string>{names.front(), names.back()})
            for (const fs::path& file : {folder / name, folder / "system" / name})
                if (fs::is_regular_file(file, ignored))
                    near.push_back(file);
        folder = folder.parent_path();
    }
    return near;
}

std::optional<std::string> harm_of(const Found& found, const Reads& reads) {
    for (const fs::path& input : reads.files)
        if (auto harm = harm_to(input, found))
            return harm;
    if (!reads.index)
        return std::nullopt;
    const std::string source = fmt::format("is a source of {}", reads.index->name());
    if (is_source_of(*reads.index, found.path))
        return source;
    for (const fs::path& input : sources_near(*reads.index, found.path))
        if (harm_to(input, found))
            return source;
    return std::nullopt;
}

void guard(const Output& output, const Reads& reads, bool force) {
    std::error_code ignored;
    const fs::file_status status = fs::status(output.path, ignored);
    const bool frames = output.kind == OutputKind::movie && is_movie_folder(output.path);
    if (!fs::exists(status))
        return;
    if (!fs::is_regular_file(status) && !frames)
        throw index::Error("{}: cannot be written: not a regular file", output.path.string());
    const bool known = !frames && is_known(output.path, output);
    const bool marked = frames || (known && output.kind != OutputKind::ids &&
                                   output.kind != OutputKind::configuration &&
                                   fs::file_size(output.path, ignored) > 0);
    if (const auto harm = harm_of({output.path, known, marked}, reads))
        throw index::Error("{}: {}, it would be overwritten: expected another name",
                           output.path.string(), *harm);
    if (known || force || (frames && !holds_movie(output.path)))
        return;
    const std::string_view expected = words_of(output.kind);
    if (expected.empty())
        throw index::Error("{}: exists already; --force replaces it", output.path.string());
    throw index::Error("{}: exists and is not {}, but {}: expected a new name; --force replaces it",
                       output.path.string(), expected, words_for(output.path));
}

} // namespace

void guard_outputs(const std::vector<Output>& outputs, const Reads& reads, bool force) {
    Places places;
    std::set<std::string> taken;
    for (const Output& output : outputs) {
        if (!taken.insert(places.of(index::end_of_links(output.path)).native()).second)
            throw index::Error("{}: two outputs have this name, expected two names",
                               output.path.string());
        guard(output, reads, force);
    }
}

} // namespace isochron::app
