// The ledger of temporary files and folders: $XDG_STATE_HOME/isochron/unfinished.
#include "index/system/temporary/remains.h"

#include "index/system/descriptor.h"
#include "index/system/temporary/own_remains.h"
#include "index/system/user_folders.h"

#include <fmt/format.h>

#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <climits>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <random>
#include <set>
#include <vector>

namespace isochron::index {
namespace fs = std::filesystem;

namespace {

constexpr std::string_view kMark = ".isochron-", kTemporary = ".tmp";

/// Which file or folder it is. A number is used again once its file is gone, the time of its birth
/// is not; where a file system does not know that time, it is 0.
struct Identity {
    std::uint64_t device, number, born;
    bool operator==(const Identity&) const = default;
};

/// @param name of it in `folder`; empty: `folder` itself, which may also be a file
std::optional<Identity> identity_of(int folder, const char* name) {
    struct statx status{};
    if (::statx(folder, name, AT_EMPTY_PATH | AT_SYMLINK_NOFOLLOW, STATX_INO | STATX_BTIME,
                &status) != 0)
        return std::nullopt;
    constexpr std::uint64_t kSecond = 1'000'000'000; // [ns]
    const bool knows = (status.stx_mask & STATX_BTIME) != 0;
    return Identity{std::uint64_t{status.stx_dev_major} << 32 | status.stx_dev_minor,
                    status.stx_ino,
                    knows ? static_cast<std::uint64_t>(status.stx_btime.tv_sec) * kSecond +
                                status.stx_btime.tv_nsec
                          : 0};
}

bool is_folder(int file) {
    struct stat status{};
    return ::fstat(file, &status) == 0 && S_ISDIR(status.st_mode);
}

using Entries = std::unique_ptr<DIR, int (*)(DIR*)>;

/// The entries of an open folder. Not std::filesystem's iterator, which ends the program when memory
/// runs out.
Entries entries_of(int folder) {
    const int again = ::openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    return {again < 0 ? nullptr : ::fdopendir(again), ::closedir};
}

/// Whether nobody writes a file or a folder, which no longer grows. Locks may hold only among the
/// processes of one machine, hence the age.
bool is_abandoned(int file) {
    struct stat status{};
    constexpr time_t kOld = 60; // [s]
    return ::fstat(file, &status) == 0 && (S_ISREG(status.st_mode) || S_ISDIR(status.st_mode)) &&
           status.st_uid == ::geteuid() && status.st_mtime + kOld < std::time(nullptr) &&
           ::flock(file, LOCK_EX | LOCK_NB) == 0;
}

fs::path ledger_path() {
    const auto state = user_state_folder();
    std::error_code error; // then there is no such folder
    return state ? fs::absolute(*state / "unfinished", error) : fs::path();
}

/// None where there is no ledger, or where somebody else could have written in it.
Descriptor open_ledger(const fs::path& path) {
    Descriptor ledger(::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
    struct stat status{};
    const bool ours = ledger && ::fstat(ledger.number(), &status) == 0 &&
                      status.st_uid == ::geteuid() && (status.st_mode & 077) == 0;
    return ours ? std::move(ledger) : Descriptor();
}

/// What an entry says.
struct Remain {
    Identity identity;
    std::string contents; ///< as for `remove_temporary`
    fs::path path;        ///< absolute, without links on its way
};

/// An entry's text: device, number and time of birth, and behind another space the beginning of the
/// names of its contents, which has no slash, and the path, which begins with one.
std::optional<Remain> remain_from(const char* text) {
    unsigned long long device = 0, number = 0, born = 0;
    int begin = 0;
    if (std::sscanf(text, "%llx %llx %llx%n", &device, &number, &born, &begin) != 3 ||
        text[begin] != ' ')
        return std::nullopt;
    const std::string_view rest(text + begin + 1);
    const std::size_t slash = rest.find('/');
    if (slash == rest.npos)
        return std::nullopt;
    Remain remain{{device, number, born}, std::string(rest.substr(0, slash)), rest.substr(slash)};
    const std::string name = remain.path.filename().string();
    const bool is_temporary =
        name.starts_with('.') && name.ends_with(kTemporary) && name.rfind(kMark) != name.npos;
    return is_temporary ? std::optional(std::move(remain)) : std::nullopt;
}

/// @return whether nothing of it is left under its name, so that its entry may go
bool remove_remain(const Remain& remain) {
    // Anything may have such a name meanwhile, even a pipe or a link.
    const Descriptor file(
        ::open(remain.path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOFOLLOW));
    if (!file)
        return errno == ENOENT || errno == ENOTDIR || errno == ELOOP;
    if (identity_of(file.number(), "") != remain.identity)
        return true;
    if (!is_abandoned(file.number()))
        return false;
    remove_temporary(remain.path.c_str(), file.number(), remain.contents);
    return identity_of(AT_FDCWD, remain.path.c_str()) != remain.identity;
}

/// @param folder without links on its way
void sweep(const fs::path& folder) {
    const Descriptor ledger = open_ledger(ledger_path());
    const Entries entries = ledger ? entries_of(ledger.number()) : Entries(nullptr, ::closedir);
    std::vector<std::pair<std::int64_t, std::string>> others; // by their age
    while (const dirent* entry = entries ? ::readdir(entries.get()) : nullptr) {
        std::array<char, PATH_MAX + 1> text{};
        struct stat status{};
        if (::readlinkat(ledger.number(), entry->d_name, text.data(), PATH_MAX) <= 0 ||
            ::fstatat(ledger.number(), entry->d_name, &status, AT_SYMLINK_NOFOLLOW) != 0)
            continue;
        const auto remain = remain_from(text.data());
        if (!remain || (remain->path.parent_path() == folder && remove_remain(*remain)))
            ::unlinkat(ledger.number(), entry->d_name, 0);
        else
            others.emplace_back(status.st_mtime, entry->d_name);
    }
    // Remains in folders that nobody names again would become more and more.
    constexpr std::size_t kMost = 1000;
    if (others.size() <= kMost)
        return;
    std::ranges::sort(others);
    for (std::size_t i = 0; i < others.size() - kMost; ++i)
        ::unlinkat(ledger.number(), others[i].second.c_str(), 0);
}

/// What stands in the ledger for this process, by the path of its link. Never destroyed: another thread
/// may read it while the process ends.
struct OwnRemain {
    std::string path, contents;
    int file;
};
struct OwnRemains {
    std::mutex mutex;
    std::map<std::string, OwnRemain> by_link;
};
OwnRemains& own_remains() {
    static OwnRemains* const all = new OwnRemains;
    return *all;
}

std::uint32_t random_number() {
    static std::mutex mutex;
    static std::random_device random;
    const std::lock_guard lock(mutex);
    return random();
}

} // namespace

fs::path temporary_name_of(const fs::path& file) {
    constexpr std::size_t kLongest = 200; // a name may have 255 bytes
    return file.parent_path() / fmt::format(".{}{}{:08x}{}",
                                            file.filename().string().substr(0, kLongest), kMark,
                                            random_number(), kTemporary);
}

void remove_temporary(const char* path, int file, std::string_view contents) noexcept {
    const auto identity = identity_of(file, "");
    if (!identity || identity != identity_of(AT_FDCWD, path))
        return;
    const bool folder = is_folder(file);
    const Entries entries =
        folder && !contents.empty() ? entries_of(file) : Entries(nullptr, ::closedir);
    while (const dirent* entry = entries ? ::readdir(entries.get()) : nullptr) {
        std::string_view name(entry->d_name);
        if (name.starts_with('.')) // a temporary file for one of them
            name.remove_prefix(1);
        if (name.starts_with(contents))
            ::unlinkat(file, entry->d_name, 0); // refuses folders
    }
    if (identity == identity_of(AT_FDCWD, path))
        ::unlinkat(AT_FDCWD, path, folder ? AT_REMOVEDIR : 0); // refuses a folder that holds more
}

LedgerEntry::LedgerEntry(const fs::path& path, int file, std::string_view contents) noexcept {
    try {
        const fs::path ledger = ledger_path();
        const auto identity = identity_of(file, "");
        std::error_code error;
        const fs::path parent = fs::weakly_canonical(fs::absolute(path).parent_path(), error);
        if (ledger.empty() || !identity || error)
            return;
        fs::create_directories(ledger.parent_path(), error);
        ::mkdir(ledger.c_str(), 0700);
        const Descriptor open = open_ledger(ledger);
        const std::string name = fmt::format("{:08x}{:08x}", random_number(), random_number());
        std::string link = (ledger / name).string();
        const std::string text =
            fmt::format("{:x} {:x} {:x} {}{}", identity->device, identity->number, identity->born,
                        contents, (parent / path.filename()).string());
        if (!open || ::symlinkat(text.c_str(), open.number(), name.c_str()) != 0)
            return;
        link_ = std::move(link);
        OwnRemains& own = own_remains();
        const std::lock_guard lock(own.mutex);
        own.by_link[link_] = {path.string(), std::string(contents), file};
    } catch (const std::exception&) { // then there is no entry
    }
}

void LedgerEntry::strike() noexcept {
    if (link_.empty())
        return;
    ::unlink(link_.c_str());
    OwnRemains& own = own_remains();
    const std::lock_guard lock(own.mutex);
    own.by_link.erase(link_);
}

void remove_own_remains() noexcept {
    OwnRemains& own = own_remains();
    const std::lock_guard lock(own.mutex);
    for (const auto& [link, remain] : own.by_link) {
        remove_temporary(remain.path.c_str(), remain.file, remain.contents);
        if (identity_of(AT_FDCWD, remain.path.c_str()) != identity_of(remain.file, ""))
            ::unlink(link.c_str());
    }
}

void remove_remains_in(const fs::path& folder) {
    static std::mutex mutex;
    static std::set<std::string> done; // as they were named, and as they are at the end of links
    std::error_code ignored;
    const fs::path named = fs::absolute(folder, ignored);
    {
        const std::lock_guard lock(mutex);
        if (!done.insert(named.native()).second)
            return;
    }
    const fs::path whole = fs::weakly_canonical(named, ignored);
    {
        const std::lock_guard lock(mutex);
        if (whole != named && !done.insert(whole.native()).second)
            return;
    }
    sweep(whole);
}

} // namespace isochron::index
