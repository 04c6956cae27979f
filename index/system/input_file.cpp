// Opens regular files.
#include "index/system/input_file.h"

#include "index/missing_file.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <tuple>
#include <unordered_map>

namespace isochron::index {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, int error) {
    const std::string name = path.string();
    if (error == ENOENT)
        throw MissingFile("{}: there is no such file", name);
    if (error == ENXIO) // a socket, or a device that does not exist
        throw Error("{}: not a regular file", name);
    throw Error("{}: cannot be opened: {}", name, std::strerror(error));
}

void expect_regular(const std::filesystem::path& path, const struct stat& status) {
    if (S_ISDIR(status.st_mode))
        throw Error("{}: a folder, expected a file", path.string());
    if (!S_ISREG(status.st_mode))
        throw Error("{}: not a regular file", path.string());
}

FileState state_in(const struct stat& status) {
    return {.device = status.st_dev,
            .inode = status.st_ino,
            .size = static_cast<std::uint64_t>(status.st_size),
            .written =
                std::int64_t{status.st_mtim.tv_sec} * 1'000'000'000 + status.st_mtim.tv_nsec};
}

/// Opens a regular file. @return its descriptor and state
std::pair<int, FileState> opened(const std::filesystem::path& path) {
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
    if (file < 0)
        refuse(path, errno);
    try {
        struct stat status{};
        if (::fstat(file, &status) != 0)
            refuse(path, errno);
        expect_regular(path, status);
        return {file, state_in(status)};
    } catch (...) {
        ::close(file);
        throw;
    }
}

/// Reads from `offset` until `out` is full or the file ends. @return bytes read
std::size_t read_at(int file, const std::filesystem::path& path, std::uint64_t offset,
                    std::span<std::byte> out) {
    std::size_t done = 0;
    while (done < out.size()) {
        const ssize_t got =
            ::pread(file, out.data() + done, out.size() - done, static_cast<off_t>(offset + done));
        if (got < 0 && errno == EINTR)
            continue;
        if (got < 0)
            throw Error("{}: cannot be read: {}", path.string(), std::strerror(errno));
        if (got == 0)
            break;
        done += static_cast<std::size_t>(got);
    }
    return done;
}

/// The files that a thread has seen.
struct Seen {
    static constexpr std::size_t kMost = 64 << 20; ///< bytes of their heads
    std::unordered_map<std::string, std::shared_ptr<const FileHead>> heads;
    std::size_t bytes = 0;
};
thread_local std::unique_ptr<Seen> seen_here; ///< null: nothing is kept

std::shared_ptr<const FileHead> seen(const std::filesystem::path& path) {
    if (!seen_here)
        return nullptr;
    const auto found = seen_here->heads.find(path.native());
    return found == seen_here->heads.end() ? nullptr : found->second;
}

} // namespace

FilesSeen::FilesSeen() : keeps_(!seen_here) {
    if (keeps_)
        seen_here = std::make_unique<Seen>();
}

FilesSeen::~FilesSeen() {
    if (keeps_)
        seen_here.reset();
}

FileState state_of(const std::filesystem::path& path) {
    if (const auto known = seen(path))
        return known->state;
    struct stat status{};
    if (::stat(path.c_str(), &status) != 0)
        refuse(path, errno);
    expect_regular(path, status);
    return state_in(status);
}

int open_regular(const std::filesystem::path& path) {
    return opened(path).first;
}

InputFile::InputFile(std::filesystem::path path) : path_(std::move(path)), seen_(seen(path_)) {
    if (seen_) {
        size_ = seen_->state.size;
        return;
    }
    FileHead head;
    std::tie(file_, head.state) = opened(path_);
    size_ = head.state.size;
    if (!seen_here || seen_here->bytes + FilesSeen::kHead > Seen::kMost)
        return;
    try {
        head.bytes.resize(std::min<std::uint64_t>(size_, FilesSeen::kHead));
        head.bytes.resize(read_at(file_, path_, 0, std::as_writable_bytes(std::span(head.bytes))));
        seen_here->bytes += head.bytes.size();
        seen_ = std::make_shared<const FileHead>(std::move(head));
        seen_here->heads[path_.native()] = seen_;
    } catch (...) {
        ::close(file_);
        throw;
    }
}

InputFile::~InputFile() {
    if (file_ >= 0)
        ::close(file_);
}

int InputFile::descriptor() const {
    std::call_once(opened_, [&] {
        if (file_ >= 0)
            return;
        const auto [file, state] = opened(path_);
        if (state != seen_->state) {
            ::close(file);
            throw Error("{}: changed while it was read", path_.string());
        }
        file_ = file;
    });
    return file_;
}

std::size_t InputFile::read(std::uint64_t offset, std::span<std::byte> out) const {
    if (seen_) {
        const std::string& head = seen_->bytes;
        const bool is_all = head.size() == size_;
        if (is_all || (offset <= head.size() && out.size() <= head.size() - offset)) {
            const std::size_t count =
                offset < head.size() ? std::min<std::size_t>(out.size(), head.size() - offset) : 0;
            std::memcpy(out.data(), head.data() + std::min(offset, size_), count);
            return count;
        }
    }
    return read_at(descriptor(), path_, offset, out);
}

std::unique_ptr<InputFile> InputFile::opened_again() const {
    const int again =
        ::open(fmt::format("/proc/self/fd/{}", descriptor()).c_str(), O_RDONLY | O_CLOEXEC);
    return again < 0 ? nullptr : std::unique_ptr<InputFile>(new InputFile(path_, again, size_));
}

InputStream::InputStream(const std::filesystem::path& path) : std::istream(nullptr), buffer_(path) {
    rdbuf(&buffer_);
}

InputStream::Buffer::int_type InputStream::Buffer::underflow() {
    constexpr std::size_t kBlock = 1 << 16;
    block_.resize(next_ == 0 ? FilesSeen::kHead : kBlock);
    const std::size_t got = file_.read(next_, std::as_writable_bytes(std::span(block_)));
    next_ += got;
    setg(block_.data(), block_.data(), block_.data() + got);
    return got == 0 ? traits_type::eof() : traits_type::to_int_type(block_[0]);
}

std::string read_text(const std::filesystem::path& path, std::uint64_t most) {
    const InputFile file(path);
    if (file.size() > most)
        throw Error("{}: {} bytes, expected at most {}", path.string(), file.size(), most);
    std::string text(file.size(), '\0');
    text.resize(file.read(0, std::as_writable_bytes(std::span(text))));
    return text;
}

} // namespace isochron::index
