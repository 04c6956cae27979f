// The pool of reader processes.
#include "index/reader/reader_pool.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace isochron::index {
namespace {

constexpr std::size_t kMostIdle = 4; ///< each takes some megabytes for its libraries

} // namespace

std::unique_ptr<ReaderProcess> ReaderPool::take(const std::string& program) {
    {
        const std::lock_guard lock(mutex_);
        std::erase_if(idle_, [](const auto& reader) { return !reader->is_ours(); });
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
    return std::make_unique<ReaderProcess>(program, limits_);
}

void ReaderPool::give_back(std::unique_ptr<ReaderProcess> reader) {
    const std::lock_guard lock(mutex_);
    if (idle_.size() < kMostIdle)
        idle_.push_back(std::move(reader));
}

ReaderPool& readers_of_this_process() {
    static ReaderPool pool;
    return pool;
}

} // namespace isochron::index
