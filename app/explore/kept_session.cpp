// Saving and resuming of the session of `explore`.
#include "app/explore/kept_session.h"

#include "app/explore/explored_data.h"
#include "app/loop/session_keeper.h"
#include "app/telling.h"
#include "app/version.h"
#include "index/file/index_states.h"
#include "index/system/links/link.h"
#include "index/system/new_file.h"
#include "interaction/error.h"
#include "interaction/navigation/key_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <string_view>
#include <unistd.h>

namespace isochron::app {

std::string data_hash_of(const index::IndexFile& file) {
    return fmt::format("{:016x}", file.content_hash());
}

namespace {

constexpr std::size_t kHash = 16; // digits of HASH in NAME-HASH.isochron-session

/// Whether the data have this hash, or had it when they had fewer steps.
bool is_held(const index::IndexFile& file, std::string_view hash) {
    std::uint64_t number = 0;
    const char* const end = hash.data() + hash.size();
    const auto read = std::from_chars(hash.data(), end, number, 16);
    return read.ptr == end && read.ec == std::errc() && index::has_had(file, number);
}

} // namespace

std::string held_hash(const index::IndexFile& file, const std::string& hash) {
    return is_held(file, hash) ? hash : data_hash_of(file);
}

std::string other_reading(const std::string& name, std::uint32_t reading,
                          const index::IndexFile& file) {
    const std::uint32_t now = file.metadata().reading_number;
    return reading == 0 || reading == now
               ? std::string()
               : fmt::format("{}: made on data whose files were read otherwise (reading {}, {} has "
                             "{}): places, times or missing values may differ",
                             name, reading, file.name(), now);
}

std::filesystem::path kept_on_fewer_steps(const std::filesystem::path& path,
                                          const index::IndexFile& file) {
    namespace fs = std::filesystem;
    std::error_code error;
    if (fs::exists(path, error))
        return path;
    const std::string stem = path.stem().string();
    const std::string start = stem.substr(0, stem.size() - kHash);
    fs::path newest = path;
    fs::file_time_type newest_time;
    for (fs::directory_iterator entry(path.parent_path(), error);
         !error && entry != fs::directory_iterator(); entry.increment(error)) {
        const std::string name = entry->path().stem().string();
        if (entry->path().extension() != path.extension() || name.size() != stem.size() ||
            !name.starts_with(start) || !is_held(file, std::string_view(name).substr(start.size())))
            continue;
        std::error_code unknown;
        const fs::file_time_type time = fs::last_write_time(entry->path(), unknown);
        if (newest == path || time > newest_time) {
            newest = entry->path();
            newest_time = time;
        }
    }
    return newest;
}

std::optional<std::filesystem::path> kept_in(const ExploreOptions& options,
                                             const index::IndexFile& file) {
    if (options.session)
        return index::end_of_links(*options.session);
    return session_path(*options.data, data_hash_of(file));
}

std::optional<std::filesystem::path> earlier_kept_in(const ExploreOptions& options,
                                                     const index::IndexFile& file) {
    const auto path = kept_in(options, file);
    return options.session || !path ? path : kept_on_fewer_steps(*path, file);
}

std::vector<EarlierSession> earlier_sessions(const ExploreOptions& options,
                                             const index::IndexFile& file) {
    const auto path = earlier_kept_in(options, file);
    if (!path)
        return {};
    const std::string stem = path->stem().string(), end = path->extension().string();
    const std::string start = stem.substr(0, stem.size() - std::min(stem.size(), kHash));
    auto all = sessions_in(path->parent_path(), [&](const std::string& name) {
        if (options.session)
            return is_session_of(name, *path);
        return name.starts_with(start) && name.size() > start.size() + kHash &&
               is_held(file, std::string_view(name).substr(start.size(), kHash)) &&
               is_session_of(name, name.substr(0, start.size() + kHash) + end);
    });
    const auto last = std::ranges::find(all, *path, &EarlierSession::path);
    if (last != all.end())
        std::rotate(all.begin(), last, last + 1);
    return all;
}

std::optional<SavedSession> earlier_session(const std::optional<std::filesystem::path>& path,
                                            bool resume) {
    const bool there = path && std::filesystem::exists(*path);
    if (resume && !there)
        throw interaction::Error("--resume: there is no saved session for these data{}",
                                 path ? " in " + path->string() : "");
    if (resume)
        return read_session(*path);
    if (there)
        print_note("--resume goes on with the session in {}", path->string());
    return std::nullopt;
}

std::string why_not_kept(const std::optional<std::filesystem::path>& path) {
    if (!path)
        return "this session is not saved: neither HOME nor XDG_STATE_HOME is set; --session names "
               "a file for it";
    std::filesystem::path folder = path->parent_path();
    if (folder.empty())
        folder = ".";
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (!error && access(folder.c_str(), W_OK) == 0)
        return "";
    return fmt::format("this session is not saved: {}: {}; --session names a file elsewhere",
                       folder.string(),
                       error ? error.message() : std::string(std::strerror(errno)));
}

void keep_session(LiveLoop& live, const std::optional<std::filesystem::path>& path,
                  const ExploreOptions& options, const index::IndexFile& file,
                  const Session& session, const std::optional<SavedSession>& earlier, bool resumed,
                  std::vector<std::filesystem::path> drops) {
    namespace fs = std::filesystem;
    if (earlier)
        live.stand(earlier->head);
    if (!path)
        return;
    SavedSession kept{.program = std::string(kProgram),
                      .data = index::absolute_name(*options.data),
                      .data_hash = data_hash_of(file),
                      .state = interaction::kept_state(session.state().as_commands()),
                      .head = live.standing(),
                      .arrays = session.left_arrays(),
                      .only_looked = !earlier || earlier->only_looked,
                      .reading = file.metadata().reading_number};
    if (const auto opened = name_to_remember(options))
        kept.opened =
            index::is_link(*opened) ? *opened : fs::absolute(*opened).lexically_normal().string();
    if (earlier && resumed) {
        kept.name = earlier->name;
        kept.picture = earlier->picture;
    }
    live.join(CompanionPlace::keeper,
              std::make_shared<SessionKeeper>(*path, std::move(kept), resumed, std::move(drops)));
}

} // namespace isochron::app
