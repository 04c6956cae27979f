// The pool of reader processes.
#include "index/readers/process/reader_pool.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace isochron::index {
namespace {

constexpr std::size_t kMostIdle = 4; ///< each takes some megabytes for its libraries

} // namespace

void ReaderPool::let_read(const std::filesystem::path& file) {
    const std::lock_guard lock(mutex_);
    readable_.add(file);
}

void ReaderPool::let_read(std::span<const std::filesystem::path> files) {
    const std::lock_guard lock(mutex_);
    std::filesystem::path folder;
    std::error_code ignored;
    for (bool first = true; const std::filesystem::path& file : files) {
        // A link leads elsewhere, and a folder is a place of its own.
        if (first || file.parent_path() != folder ||
            std::filesystem::symlink_status(file, ignored).type() !=
                std::filesystem::file_type::regular)
            readable_.add(file);
        folder = file.parent_path();
        first = false;
    }
}

bool ReaderPool::may_read(const std::filesystem::path& file) const {
    const std::lock_guard lock(mutex_);
    return readable_.contain(file);
}

std::unique_ptr<ReaderProcess> ReaderPool::take(const std::string& program) {
    {
        const std::lock_guard lock(mutex_);
        std::erase_if(idle_, [&](const auto& reader) {
            return !reader->is_ours() || reader->readable_age() != readable_.age();
        });
        const auto found = std::find_if(idle_.rbegin(), idle_.rend(), [&](const auto& reader) {
            return reader->program() == program;
        });
        if (found != idle_.rend()) {
            auto reader = std::move(*found);
            idle_.erase(std::next(found).base());
            return reader;
        }
    }
    return take_new(program);
}

std::unique_ptr<ReaderProcess> ReaderPool::take_new(const std::string& program) const {
    LeftReadable readable;
    std::uint64_t age = 0;
    ReaderLimits limits;
    {
        const std::lock_guard lock(mutex_);
        readable.places = readable_.all();
        age = readable_.age();
        limits = limits_;
    }
    ++started_;
    return std::make_unique<ReaderProcess>(program, limits, readable, age, waiting_);
}

void ReaderPool::set_patience(std::chrono::milliseconds patience) {
    const std::lock_guard lock(mutex_);
    limits_.patience = patience;
}

void ReaderPool::give_back(std::unique_ptr<ReaderProcess> reader) {
    const std::lock_guard lock(mutex_);
    if (reader->answers() && idle_.size() < kMostIdle)
        idle_.push_back(std::move(reader));
}

ReaderPool& readers_of_this_process() {
    static ReaderPool pool;
    return pool;
}

} // namespace isochron::index
