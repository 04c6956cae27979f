// A reader from the pool, lent to a file, or to several that are arrays of the same file.
#pragma once

#include "index/error.h"
#include "index/readers/process/reader_pool.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <set>
#include <stop_token>
#include <string>
#include <utility>
#include <variant>

namespace isochron::index {

/// A reader that is given back to its pool when its last file is closed.
class LentReader {
  public:
    explicit LentReader(ReaderPool& pool) : pool_(pool) {}
    ~LentReader();
    LentReader(const LentReader&) = delete;
    LentReader& operator=(const LentReader&) = delete;

    /// Closes the file of a lease, if it is open.
    void close(std::uint64_t file);
    /// Forgets the reader.
    void let_go();

    std::unique_ptr<ReaderProcess> reader; ///< null: it must be started
    std::set<std::uint64_t> open;          ///< numbers of the leases whose files it has open
    std::atomic<bool> in_use = false;      ///< whoever sets it may use the other members

  private:
    ReaderPool& pool_;
};

/// A file's right to a reader. Any failure of the reader becomes an Error that names the file.
class ReaderLease {
  public:
    /// @param shared whether the reader is shared with the leases of the same file that this thread
    ///   has taken before: for libraries that decode all arrays of a file in one go
    ReaderLease(ReaderPool& pool, std::string program, std::filesystem::path path, bool shared);
    ~ReaderLease();
    ReaderLease(const ReaderLease&) = delete;
    ReaderLease& operator=(const ReaderLease&) = delete;

    ReaderProcess& reader() { return *lent_->reader; }
    /// The reader's number for the file.
    std::uint64_t number() const { return number_; }

    /// Does work with the reader; `prepare` opens the file in a reader that does not have it open.
    /// If a reader that has had other files ends, one of the other files may be the cause: then a
    /// new reader tries again. If another lease is using the reader, this lease gets its own.
    template <class Prepare, class Work>
    void work(const Prepare& prepare, const Work& work) {
        bool again = false;
        while (true) {
            const InUse use(*this);
            try {
                if (lent_->reader && !lent_->reader->is_ours())
                    lent_->let_go();
                if (!lent_->reader)
                    start(again);
                if (!lent_->open.contains(number_)) {
                    prepare();
                    lent_->open.insert(number_);
                }
                return work();
            } catch (const ReaderEnded& ended) {
                const bool only_this = !lent_->reader || lent_->reader->files() <= 1;
                lent_->let_go();
                if (again || only_this || ended.how() == ReaderEnded::How::by_our_hand)
                    fail(ended.what());
                again = true;
            }
        }
    }

    /// The next reply, which must be of this kind. @throws Error with the reader's message if not, and
    /// as ReaderProcess::reply
    template <class Kind>
    Kind expect(const std::stop_token& stop = {}) {
        ReaderReply reply = reader().reply(stop);
        if (auto* kind = std::get_if<Kind>(&reply))
            return std::move(*kind);
        const auto* refused = std::get_if<Refused>(&reply);
        if (!refused)
            throw ReaderEnded("its reader sent another reply than was asked for",
                              ReaderEnded::How::by_our_hand);
        std::string line = refused->message;
        std::ranges::replace_if(
            line, [](unsigned char c) { return c < ' ' || c == 0x7f; }, ' ');
        throw Error(line);
    }

  private:
    /// Takes the reader, or another one if it is in use.
    class InUse {
      public:
        explicit InUse(ReaderLease& lease) {
            if (lease.lent_->in_use.exchange(true)) {
                lease.lent_ = std::make_shared<LentReader>(lease.pool_);
                lease.lent_->in_use = true;
            }
            lent_ = lease.lent_;
        }
        ~InUse() { lent_->in_use = false; }
        InUse(const InUse&) = delete;
        InUse& operator=(const InUse&) = delete;

      private:
        std::shared_ptr<LentReader> lent_;
    };

    [[noreturn]] void fail(const std::string& why) const {
        throw Error("{}: cannot be read: {}", path_.string(), why);
    }
    void start(bool again);

    ReaderPool& pool_;
    std::string program_;
    std::filesystem::path path_;
    std::uint64_t number_; ///< number of this lease
    std::shared_ptr<LentReader> lent_;
};

} // namespace isochron::index
