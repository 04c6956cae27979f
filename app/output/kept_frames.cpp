// Frames of a movie that are kept while it is made.
#include "app/output/kept_frames.h"

#include "index/error.h"
#include "index/file/sections/file_layout.h"
#include "index/system/input_file.h"
#include "index/system/new_file.h"

#include <fmt/format.h>
#include <zstd.h>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFramesEnd = ".frames";
constexpr std::string_view kKeptName = "frame_";
constexpr std::string_view kFrameMagic = "isochron frame 1\n";
constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 33; ///< bytes of a frame: far above any picture

std::string file_of(std::size_t frame) {
    return fmt::format("{}{:06}", kKeptName, frame);
}

std::uint64_t hash_of_text(std::string_view text) {
    return index::checksum_of(std::as_bytes(std::span(text)));
}

fs::path without_end_slash(const fs::path& path) {
    return path.has_filename() ? path : path.parent_path();
}

/// Values behind each other, as bytes.
class Packed {
  public:
    void add(std::uint64_t number) {
        bytes_.append(reinterpret_cast<const char*>(&number), sizeof number);
    }
    void add(std::string_view text) {
        add(text.size());
        bytes_.append(text);
    }
    const std::string& bytes() const { return bytes_; }

  private:
    std::string bytes_;
};

/// Takes them again. What is behind the end is 0 and empty: checksums tell damage before.
class Unpacked {
  public:
    explicit Unpacked(std::string_view bytes) : rest_(bytes) {}
    std::uint64_t number() {
        std::uint64_t value = 0;
        std::memcpy(&value, rest_.data(), std::min(sizeof value, rest_.size()));
        rest_.remove_prefix(std::min(sizeof value, rest_.size()));
        return value;
    }
    std::string_view text() {
        const std::size_t size = std::min<std::size_t>(number(), rest_.size());
        const std::string_view text = rest_.substr(0, size);
        rest_.remove_prefix(size);
        return text;
    }

  private:
    std::string_view rest_;
};

std::string packed(const std::vector<FramePart>& parts) {
    Packed all;
    all.add(parts.size());
    for (const FramePart& part : parts) {
        all.add(part.suffix);
        all.add(part.note);
        all.add(static_cast<std::uint64_t>(part.image.width));
        all.add(static_cast<std::uint64_t>(part.image.height));
        all.add(std::uint64_t{part.image.opaque});
        std::uint64_t dpi = 0;
        std::memcpy(&dpi, &part.image.dpi, sizeof dpi);
        all.add(dpi);
        all.add(std::string_view(reinterpret_cast<const char*>(part.image.rgba.data()),
                                 part.image.rgba.size()));
    }
    return all.bytes();
}

std::vector<FramePart> unpacked(std::string_view bytes) {
    Unpacked all(bytes);
    std::vector<FramePart> parts;
    for (std::uint64_t left = all.number(); left > 0; --left) {
        FramePart& part = parts.emplace_back();
        part.suffix = all.text();
        part.note = all.text();
        part.image.width = static_cast<int>(all.number());
        part.image.height = static_cast<int>(all.number());
        part.image.opaque = all.number() != 0;
        const std::uint64_t dpi = all.number();
        std::memcpy(&part.image.dpi, &dpi, sizeof dpi);
        const std::string_view rgba = all.text();
        part.image.rgba.assign(rgba.begin(), rgba.end());
    }
    return parts;
}

/// The bytes of a file: a mark, the checksum of all that follows, and the packed values in a frame of
/// zstd.
std::string encoded(const std::vector<FramePart>& parts) {
    const std::string all = packed(parts);
    std::string file(ZSTD_compressBound(all.size()), '\0');
    const std::size_t size = ZSTD_compress(file.data(), file.size(), all.data(), all.size(), 1);
    if (ZSTD_isError(size) != 0)
        throw index::Error("a frame cannot be packed");
    file.resize(size);
    return fmt::format("{}{:016x}", kFrameMagic, hash_of_text(file)) + file;
}

std::optional<std::vector<FramePart>> decoded(std::string_view file) {
    constexpr std::size_t kDigits = 16;
    if (!file.starts_with(kFrameMagic) || file.size() < kFrameMagic.size() + kDigits)
        return std::nullopt;
    const std::string_view sum = file.substr(kFrameMagic.size(), kDigits),
                           rest = file.substr(kFrameMagic.size() + kDigits);
    if (sum != fmt::format("{:016x}", hash_of_text(rest)))
        return std::nullopt;
    const auto size = ZSTD_getFrameContentSize(rest.data(), rest.size());
    if (size > kMostBytes) // as errors are
        return std::nullopt;
    std::string all(size, '\0');
    if (ZSTD_decompress(all.data(), all.size(), rest.data(), rest.size()) != size)
        return std::nullopt;
    return unpacked(all);
}

/// Whether an open folder is this user's, and nobody else can write in it.
bool is_own(int folder) {
    struct stat status {};
    return ::fstat(folder, &status) == 0 && S_ISDIR(status.st_mode) &&
           status.st_uid == ::geteuid() && (status.st_mode & 077) == 0;
}

} // namespace

KeptFrames::KeptFrames(const fs::path& movie, const std::string& question)
    : movie_(index::end_of_links(without_end_slash(movie))) {
    constexpr std::size_t kLongest = 200; // a name may have 255 bytes
    folder_ = movie_.parent_path() / fmt::format(".{}.{:016x}{}",
                                                 movie_.filename().string().substr(0, kLongest),
                                                 hash_of_text(question), kFramesEnd);
    ::mkdir(folder_.c_str(), 0700);
    index::Descriptor open(
        ::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
    if (!open || !is_own(open.number()))
        return;
    if (::flock(open.number(), LOCK_EX | LOCK_NB) != 0)
        throw index::Error("{}: another process is making this movie", movie_.string());
    open_ = std::move(open);
    keeps_ = true;
}

bool KeptFrames::holds(std::size_t frame) const {
    return open_ && ::faccessat(open_.number(), file_of(frame).c_str(), R_OK, 0) == 0;
}

std::optional<std::vector<FramePart>> KeptFrames::read(std::size_t frame) const {
    if (!holds(frame))
        return std::nullopt;
    const fs::path file = folder_ / file_of(frame);
    try {
        if (auto parts = decoded(index::read_text(file, kMostBytes)))
            return parts;
    } catch (const index::Error&) { // as if it were not there
    }
    ::unlinkat(open_.number(), file.filename().c_str(), 0);
    return std::nullopt;
}

void KeptFrames::keep(std::size_t frame, const std::vector<FramePart>& parts) {
    if (!keeps_)
        return;
    try {
        const std::string bytes = encoded(parts);
        index::write_file(folder_ / file_of(frame), std::as_bytes(std::span(bytes)));
    } catch (const index::Error&) { // the movie needs the room more
        keeps_ = false;
    }
}

void KeptFrames::remove() {
    if (open_)
        index::remove_temporary(folder_.c_str(), open_.number(), kKeptName);
    keeps_ = false;
    open_.reset();
}

std::vector<fs::path> KeptFrames::others() const {
    std::vector<fs::path> all;
    std::error_code error;
    const fs::path beside = movie_.has_parent_path() ? movie_.parent_path() : fs::path(".");
    const std::string begin = fmt::format(".{}.", movie_.filename().string());
    for (const auto& entry : fs::directory_iterator(beside, error)) {
        const std::string name = entry.path().filename().string();
        constexpr std::size_t kHash = 16;
        if (name.starts_with(begin) && name.ends_with(kFramesEnd) &&
            name.size() == begin.size() + kHash + std::strlen(kFramesEnd) &&
            name != folder_.filename())
            all.push_back(entry.path());
    }
    return all;
}

} // namespace isochron::app
