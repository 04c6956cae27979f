// Finds earlier sessions by their names, which end in a date.
#include "app/kept/earlier_sessions.h"

#include "app/kept/session_claim.h"
#include "index/error.h"
#include "interaction/error.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <sys/stat.h>
#include <tuple>
#include <utility>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;

std::tm local(std::time_t time) {
    std::tm parts{};
    localtime_r(&time, &parts);
    return parts;
}

/// When a file was written; 0: it is not there.
std::time_t time_of(const fs::path& file) {
    struct stat status {};
    return stat(file.c_str(), &status) == 0 ? status.st_mtime : 0;
}

/// Whether a name is STEM, then `.2026-11-29T19-07-35`, then perhaps a number, then the extension.
bool is_dated(std::string_view name, const fs::path& path) {
    const std::string start = path.stem().string(), end = path.extension().string();
    if (name.size() < start.size() + end.size() || !name.starts_with(start) || !name.ends_with(end))
        return false;
    name = name.substr(start.size(), name.size() - start.size() - end.size());
    constexpr std::string_view kForm = ".0000-00-00T00-00-00";
    const auto fits = [](char c, char form) {
        return form == '0' ? std::isdigit(static_cast<unsigned char>(c)) != 0 : c == form;
    };
    return name.size() >= kForm.size() &&
           std::ranges::equal(name.substr(0, kForm.size()), kForm, fits) &&
           name.substr(kForm.size()).find_first_not_of("-0123456789") == name.npos;
}

} // namespace

std::string words_of(const EarlierSession& earlier) {
    const std::string& name = earlier.session.name;
    return fmt::format("{}{:%Y-%m-%d %H:%M:%S}{}", name.empty() ? name : name + ", ",
                       local(earlier.saved), earlier.session.only_looked ? ", only looked at" : "");
}

bool is_session_of(std::string_view name, const fs::path& path) {
    constexpr std::string_view kBefore = ".before";
    if (name.ends_with(kBefore))
        name.remove_suffix(kBefore.size());
    const std::string stem = path.stem().string(), end = path.extension().string();
    for (int window = 1; window <= kMostWindows; ++window) {
        const std::string of_window = window > 1 ? fmt::format("{}-{}", stem, window) : stem;
        if (name == of_window + end || is_dated(name, of_window + end))
            return true;
    }
    return false;
}

std::vector<EarlierSession>
sessions_in(const fs::path& folder, const std::function<bool(const std::string& name)>& wanted) {
    std::vector<EarlierSession> found;
    std::error_code error;
    for (fs::directory_iterator entry(folder.empty() ? "." : folder, error);
         !error && entry != fs::directory_iterator(); entry.increment(error)) {
        if (!wanted(entry->path().filename().string()))
            continue;
        try {
            found.push_back({entry->path(), time_of(entry->path()), read_session(entry->path())});
        } catch (const index::Error&) {       // no regular file, or gone meanwhile
        } catch (const interaction::Error&) { // no session
        }
    }
    std::ranges::sort(found, std::greater(),
                      [](const EarlierSession& each) { return std::tuple(each.saved, each.path); });
    return found;
}

std::vector<EarlierSession> sessions_to_drop(std::vector<EarlierSession> all,
                                             const fs::path& last) {
    const std::size_t kept = all.size() + 1; // with the new one
    std::erase_if(all, [&last](const EarlierSession& each) {
        std::error_code error;
        return each.path == last || is_lasting(each.session) ||
               fs::exists(claim_of(each.path), error);
    });
    std::ranges::sort(all, {}, [](const EarlierSession& each) {
        return std::tuple(!each.session.only_looked, each.saved, each.path);
    });
    all.resize(std::min(all.size(), kept - std::min(kept, kMostSessions)));
    return all;
}

void drop_sessions(const std::vector<fs::path>& files) {
    for (const fs::path& file : files) {
        try {
            std::error_code ignored;
            if (!is_lasting(read_session(file)))
                fs::remove(file, ignored);
        } catch (const index::Error&) {       // gone meanwhile
        } catch (const interaction::Error&) { // not ours any more
        }
    }
}

std::map<fs::path, std::string> newest_pictures(const fs::path& folder) {
    std::map<fs::path, std::string> pictures;
    const auto is_session = [](const std::string& name) {
        return name.ends_with(".isochron-session");
    };
    for (EarlierSession& each : sessions_in(folder, is_session)) {
        const std::string& data =
            each.session.opened.empty() ? each.session.data : each.session.opened;
        if (!each.session.picture.empty()) // the newest comes first
            pictures.try_emplace(data, std::move(each.session.picture));
    }
    return pictures;
}

fs::path keep_earlier(const fs::path& path) {
    const std::string start =
        fmt::format("{}.{:%Y-%m-%dT%H-%M-%S}", path.stem().string(), local(time_of(path)));
    fs::path dated = path;
    dated.replace_filename(start + path.extension().string());
    std::error_code error;
    for (int number = 2; fs::exists(fs::symlink_status(dated, error)); ++number)
        dated.replace_filename(fmt::format("{}-{}{}", start, number, path.extension().string()));
    fs::rename(path, dated, error);
    if (error)
        throw index::Error("{}: the earlier session there cannot be renamed: {}", path.string(),
                           error.message());
    return dated;
}

} // namespace isochron::app
