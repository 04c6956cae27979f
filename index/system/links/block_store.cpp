// Keeps blocks of files on web servers in the user's cache folder.
#include "index/system/links/block_store.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <cstdlib>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <sys/stat.h>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;

/// The sum of a block and its place; never 0.
std::uint64_t sum_of(std::uint64_t block, std::string_view bytes) {
    const std::uint64_t sum = XXH3_64bits_withSeed(bytes.data(), bytes.size(), block);
    return sum == 0 ? 1 : sum;
}

std::uint64_t disk_bytes(const fs::path& file) {
    struct stat found {};
    return stat(file.c_str(), &found) == 0 ? static_cast<std::uint64_t>(found.st_blocks) * 512 : 0;
}

/// What is kept of one file.
struct Kept {
    fs::path folder;
    std::uint64_t bytes = 0;
    fs::file_time_type used;
};

/// Removes what was used longest ago. @param mine stays @return bytes that the others have then
std::uint64_t make_room(const fs::path& folder, const fs::path& mine, std::uint64_t budget) {
    std::vector<Kept> all;
    std::uint64_t sum = 0;
    std::error_code error;
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
        std::error_code unknown;
        if (at->path() == mine || !fs::is_regular_file(at->path() / "sums", unknown))
            continue;
        all.push_back({at->path(),
                       disk_bytes(at->path() / "blocks") + disk_bytes(at->path() / "sums"),
                       fs::last_write_time(at->path() / "sums", unknown)});
        sum += all.back().bytes;
    }
    std::ranges::sort(all, {}, &Kept::used);
    for (const Kept& one : all) {
        if (sum <= budget)
            break;
        for (const char* name : {"blocks", "sums"})
            fs::remove(one.folder / name, error);
        fs::remove(one.folder, error);
        sum -= one.bytes;
    }
    return sum;
}

} // namespace

BlockStore::BlockStore(const std::optional<fs::path>& folder, std::string_view key,
                       std::uint32_t block_bytes, std::uint64_t budget)
    : block_bytes_(block_bytes) {
    if (!folder || budget == 0)
        return;
    const XXH128_hash_t hash = XXH3_128bits(key.data(), key.size());
    const fs::path mine = *folder / fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
    std::error_code error;
    fs::create_directories(*folder, error);
    chmod(folder->c_str(), S_IRWXU); // what is read may be nobody else's business
    fs::create_directories(mine, error);
    const auto open_file = [&](const char* name, int more) {
        return Descriptor(
            ::open((mine / name).c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | more, 0600));
    };
    const std::uint64_t half = budget / 2;
    const std::uint64_t others = make_room(*folder, mine, half);
    // A file that takes more than its half begins anew.
    const bool anew = disk_bytes(mine / "blocks") > half;
    blocks_ = open_file("blocks", 0);
    sums_ = open_file("sums", anew ? O_TRUNC : 0);
    if (!blocks_ || !sums_) {
        blocks_.reset();
        return;
    }
    if (anew && ::ftruncate(blocks_.number(), 0) != 0)
        return;
    futimens(sums_.number(), nullptr);
    const std::uint64_t free = fs::space(mine, error).available / 2;
    const std::uint64_t used = others + disk_bytes(mine / "blocks");
    room_ = static_cast<std::int64_t>(std::min(budget - std::min(budget, used), error ? 0 : free));
}

std::uint64_t BlockStore::sum_at(std::uint64_t block) const {
    std::uint64_t sum = 0;
    return blocks_ && ::pread(sums_.number(), &sum, sizeof sum,
                              static_cast<off_t>(block * sizeof sum)) ==
                          static_cast<ssize_t>(sizeof sum)
               ? sum
               : 0;
}

bool BlockStore::has(std::uint64_t block) const {
    return sum_at(block) != 0;
}

bool BlockStore::get(std::uint64_t block, std::span<char> out) const {
    const std::uint64_t sum = sum_at(block);
    return sum != 0 &&
           ::pread(blocks_.number(), out.data(), out.size(),
                   static_cast<off_t>(block * block_bytes_)) == static_cast<ssize_t>(out.size()) &&
           sum_of(block, {out.data(), out.size()}) == sum;
}

void BlockStore::put(std::uint64_t block, std::string_view bytes) {
    if (!blocks_ || (room_ -= block_bytes_) < 0)
        return;
    if (::pwrite(blocks_.number(), bytes.data(), bytes.size(),
                 static_cast<off_t>(block * block_bytes_)) != static_cast<ssize_t>(bytes.size())) {
        room_ = 0;
        return;
    }
    const std::uint64_t sum = sum_of(block, bytes);
    if (::pwrite(sums_.number(), &sum, sizeof sum, static_cast<off_t>(block * sizeof sum)) !=
        static_cast<ssize_t>(sizeof sum))
        room_ = 0;
}

std::uint64_t link_cache_budget() {
    constexpr std::uint64_t kUsual = std::uint64_t{4} << 30, kMostMiB = std::uint64_t{1} << 24;
    const char* const set = std::getenv("ISOCHRON_LINK_CACHE");
    if (!set)
        return kUsual;
    const double mib = std::strtod(set, nullptr);
    return mib >= 0 && mib <= static_cast<double>(kMostMiB)
               ? static_cast<std::uint64_t>(mib * (1 << 20))
               : kUsual;
}

} // namespace isochron::index
