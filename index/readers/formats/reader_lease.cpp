// Lends readers, and finds those that the same thread has lent for the same file.
#include "index/readers/formats/reader_lease.h"

#include <map>
#include <tuple>

namespace isochron::index {
namespace {

/// The reader that this thread shares among the leases of a file.
std::shared_ptr<LentReader> shared_reader(ReaderPool& pool, const std::string& program,
                                          const std::filesystem::path& path) {
    using Key = std::tuple<ReaderPool*, std::string, std::filesystem::path>;
    thread_local std::map<Key, std::weak_ptr<LentReader>> lent;
    std::erase_if(lent, [](const auto& entry) { return entry.second.expired(); });
    std::weak_ptr<LentReader>& known = lent[Key{&pool, program, path}];
    auto reader = known.lock();
    if (!reader)
        known = reader = std::make_shared<LentReader>(pool);
    return reader;
}

std::uint64_t next_lease() {
    static std::atomic<std::uint64_t> last = 0;
    return ++last;
}

} // namespace

LentReader::~LentReader() {
    while (!open.empty())
        close(*open.begin());
    if (reader)
        pool_.give_back(std::move(reader));
}

void LentReader::close(std::uint64_t file) {
    if (open.erase(file) == 0)
        return;
    if (!reader->is_ours())
        return let_go();
    try {
        reader->ask(CloseFile{file});
        reader->reply();
    } catch (...) { // it has gone, or is no longer waited for
        let_go();
    }
}

void LentReader::let_go() {
    reader.reset();
    open.clear();
}

ReaderLease::ReaderLease(ReaderPool& pool, std::string program, std::filesystem::path path,
                         bool shared)
    : pool_(pool), program_(std::move(program)), path_(std::move(path)), number_(next_lease()),
      lent_(shared ? shared_reader(pool, program_, path_) : std::make_shared<LentReader>(pool)) {}

ReaderLease::~ReaderLease() {
    if (lent_->in_use.exchange(true))
        return; // another file uses the reader, and closes it in the end
    lent_->close(number_);
    lent_->in_use = false;
}

void ReaderLease::start(bool again) {
    try {
        lent_->reader = again ? pool_.take_new(program_) : pool_.take(program_);
    } catch (const Error& error) {
        fail(error.what());
    }
}

} // namespace isochron::index
