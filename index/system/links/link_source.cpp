// Asks a web server for blocks of a file, many of them in one request, ahead of those who read them.
#include "index/system/links/link_source.h"

#include "index/error.h"
#include "index/system/links/block_store.h"
#include "index/system/links/link.h"
#include "index/system/links/range_answer.h"
#include "index/system/module.h"
#include "index/system/user_folders.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <condition_variable>
#include <cstring>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

#include <unistd.h>

namespace isochron::index {
namespace {

constexpr std::uint64_t kBlock = 8 << 10;    ///< [byte]; the first holds the headers of an index
constexpr std::uint64_t kOpening = 64 << 10; ///< bytes that are asked for at the opening
constexpr std::uint64_t kPiece = 1 << 20;    ///< most bytes of a read at a time
constexpr std::uint64_t kTogether = 1 << 20; ///< most bytes of a request
constexpr std::uint64_t kNear =
    16 << 10; ///< single ranges with less between them are asked for together
constexpr std::size_t kMostRanges = 100;     ///< ranges in a request
constexpr std::size_t kMostBlocks = 8 << 10; ///< that are held, and that wait: 64 MiB each
constexpr unsigned kAtOnce = 6;              ///< requests
constexpr unsigned kBusy = 2;                ///< so many are under way: small ones wait for more
constexpr int kTries = 4;
constexpr std::uint64_t kMostList = 1 << 20;    ///< bytes of site.json
constexpr std::chrono::milliseconds kLook{100}; ///< between two looks at who waits

/// A block that somebody waits for.
struct Awaited {
    bool ended = false;
    std::string failure;  ///< empty: it has come
    bool changed = false; ///< the failure is that the file is another one
};
using AwaitedPtr = std::shared_ptr<Awaited>;

/// Calls what ends waits of this process. @throws what it throws
void look_at_who_waits() {
    if (const WhileWaitingForLink waiting = while_waiting_for_links())
        waiting();
}

/// What one content of the file is, and what has come of it. Requests that are under way keep it alive.
class Content : public std::enable_shared_from_this<Content> {
  public:
    Content(std::string address, std::shared_ptr<HttpTransport> transport, bool keep)
        : address_(std::move(address)), transport_(std::move(transport)), keep_(keep),
          authorization_(authorization_for(address_)) {}

    /// Asks for the beginning. @throws Error
    void open() {
        const HttpAnswer answer = asked({{0, kOpening}}, 206, kOpening);
        if (!answer.failure.empty())
            fail(answer.failure);
        if (answer.status == 416)
            fail("it is empty: expected an index");
        if (answer.status != 206)
            fail(words_of_status(answer));
        const auto where = content_range(answer.field("content-range"));
        if (!where || where->range.begin != 0 || answer.body.size() != where->range.bytes() ||
            where->range.end != std::min(kOpening, where->total))
            fail("it does not send the bytes that it was asked for");
        size_ = where->total;
        tag_ = strong_tag(answer.field("etag"));
        first_ = answer.body.substr(0, kBlock);
        if (keep_ && !tag_.empty()) {
            const auto folder = user_cache_folder();
            store_.emplace(folder ? std::optional(*folder / "links") : std::nullopt,
                           fmt::format("{}\n{}\n{}", address_, tag_, size_), kBlock,
                           link_cache_budget());
        }
        const std::lock_guard lock(mutex_);
        for (std::uint64_t block = 0; block * kBlock < answer.body.size(); ++block)
            hold(block, answer.body.substr(block * kBlock, kBlock));
    }

    const std::string& address() const { return address_; }
    std::uint64_t size() const { return size_; }

    void expect(std::uint64_t offset, std::uint64_t bytes) {
        if (offset >= size_ || bytes == 0 || is_forked())
            return;
        const std::uint64_t end = (std::min(size_ - offset, bytes) + offset - 1) / kBlock + 1;
        std::unique_lock lock(mutex_);
        for (std::uint64_t block = offset / kBlock; block < end && wanted_.size() < kMostBlocks;
             ++block)
            if (!held_.contains(block) && !asked_.contains(block) && !wanted_.contains(block) &&
                !(store_ && store_->has(block)))
                wanted_.emplace(block, std::make_shared<Awaited>());
        pump();
    }

    /// @return false: the file is another one now @throws Error, and what ends the wait
    bool read(std::uint64_t offset, std::span<std::byte> out) {
        expect_own_process();
        constexpr int kMostTimes = 100; // others may crowd out what came before it is taken
        std::vector<std::uint64_t> missing;
        const std::uint64_t end = offset + out.size();
        for (std::uint64_t block = offset / kBlock; block * kBlock < end; ++block)
            missing.push_back(block);
        for (int time = 0; time < kMostTimes; ++time) {
            std::erase_if(missing, [&](std::uint64_t block) { return take(block, offset, out); });
            if (missing.empty())
                return true;
            std::vector<AwaitedPtr> awaited;
            std::unique_lock lock(mutex_);
            for (const std::uint64_t block : missing) {
                if (held_.contains(block))
                    continue;
                if (const auto flying = asked_.find(block); flying != asked_.end()) {
                    awaited.push_back(flying->second);
                    continue;
                }
                AwaitedPtr& one = wanted_[block];
                if (!one)
                    one = std::make_shared<Awaited>();
                awaited.push_back(one);
                urgent_.insert(block);
            }
            pump();
            const auto all_ended = [&] { return std::ranges::all_of(awaited, &Awaited::ended); };
            while (!came_.wait_for(lock, kLook, all_ended)) {
                lock.unlock();
                look_at_who_waits();
                lock.lock();
            }
            for (const AwaitedPtr& one : awaited) {
                if (one->changed)
                    return false;
                if (!one->failure.empty())
                    fail(one->failure);
            }
        }
        fail("too many reads at a time");
    }

    /// Whether another content lies there, or may. @throws Error
    bool may_have_changed() {
        expect_own_process();
        if (tag_.empty())
            return true;
        HttpRequest request = request_of({{0, 1}}, 206, 1, 1);
        std::erase_if(request.headers,
                      [](const std::string& header) { return header.starts_with("If-"); });
        request.headers.push_back("If-None-Match: " + tag_);
        const HttpAnswer answer = answered(std::move(request));
        return answer.failure.empty() && answer.status != 304 &&
               strong_tag(answer.field("etag")) != tag_;
    }

    /// Asks for nothing more.
    void close() {
        const std::lock_guard lock(mutex_);
        closed_ = true;
        for (const auto& [block, awaited] : wanted_)
            awaited->ended = awaited->changed = true;
        wanted_.clear();
        urgent_.clear();
        came_.notify_all();
    }

    /// One answer, for which the caller waits. @param ranges none: all of it
    HttpAnswer asked(const std::vector<LinkRange>& ranges, int wanted, std::uint64_t most) {
        for (int time = 1;; ++time) {
            HttpAnswer answer = answered(request_of(ranges, wanted, most, time));
            if (time == kTries || !may_pass(answer))
                return answer;
        }
    }
    HttpAnswer answered(HttpRequest request) {
        struct Box {
            std::mutex mutex;
            std::condition_variable came;
            std::optional<HttpAnswer> answer;
        };
        const auto box = std::make_shared<Box>();
        transport_->send(std::move(request), [box](HttpAnswer answer) {
            const std::lock_guard lock(box->mutex);
            box->answer = std::move(answer);
            box->came.notify_all();
        });
        std::unique_lock lock(box->mutex);
        while (!box->came.wait_for(lock, kLook, [&] { return box->answer.has_value(); })) {
            lock.unlock();
            look_at_who_waits();
            lock.lock();
        }
        return std::move(*box->answer);
    }

    [[noreturn]] void fail(const std::string& what) const { throw Error("{}: {}", address_, what); }

    static std::string words_of_status(const HttpAnswer& answer) {
        switch (answer.status) {
        case 200:
            return "the server sends the whole file where a range of it is asked for: expected one "
                   "that answers ranges "
                   "(Accept-Ranges: bytes), or download the file";
        case 401:
            return "the server wants to know who asks (401): expected the link with its token";
        case 403: return "the server refuses (403)";
        case 404:
        case 410: return fmt::format("there is no such file ({})", answer.status);
        default:
            return fmt::format("the server answers with status {}, expected 206", answer.status);
        }
    }

  private:
    /// A request for some ranges.
    struct Sent {
        std::vector<LinkRange> ranges;
        int time = 1;
    };

    /// A forked process has neither the thread that asks nor the answers that are under way.
    bool is_forked() const { return ::getpid() != owner_; }
    void expect_own_process() const {
        if (is_forked())
            fail("it was opened before this process was forked: open it again");
    }

    static bool may_pass(const HttpAnswer& answer) {
        return answer.failure.empty()
                   ? answer.status == 429 || (answer.status >= 500 && answer.status != 501)
                   : answer.may_pass;
    }

    HttpRequest request_of(const std::vector<LinkRange>& ranges, int wanted, std::uint64_t most,
                           int time) const {
        HttpRequest request{.address = address_,
                            .headers = {"Accept-Encoding: identity"},
                            .wanted = wanted,
                            .most = most,
                            .after =
                                std::chrono::milliseconds(time == 1 ? 0 : 100 << (2 * (time - 2))),
                            .patience = link_patience()};
        if (!ranges.empty())
            request.headers.push_back(range_header(ranges));
        if (!tag_.empty()) {
            request.headers.push_back("If-Match: " + tag_);
            request.headers.push_back("If-Range: " + tag_);
        }
        if (!authorization_.empty())
            request.headers.push_back("Authorization: " + authorization_);
        return request;
    }

    std::uint64_t bytes_of(std::uint64_t block) const {
        return std::min(kBlock, size_ - block * kBlock);
    }

    /// Copies what is at hand of a block. @return false: it is not at hand
    bool take(std::uint64_t block, std::uint64_t offset, std::span<std::byte> out) {
        const std::uint64_t begin = std::max(block * kBlock, offset);
        const std::uint64_t end = std::min(block * kBlock + bytes_of(block), offset + out.size());
        const auto copy = [&](const char* bytes) {
            std::memcpy(out.data() + (begin - offset), bytes + (begin - block * kBlock),
                        end - begin);
            return true;
        };
        {
            const std::lock_guard lock(mutex_);
            if (const auto found = held_.find(block); found != held_.end())
                return copy(found->second.data());
        }
        std::array<char, kBlock> kept;
        return store_ && store_->get(block, std::span(kept).first(bytes_of(block))) &&
               copy(kept.data());
    }

    /// Keeps a block in memory. The mutex is locked.
    void hold(std::uint64_t block, std::string bytes) {
        if (held_.emplace(block, std::move(bytes)).second)
            order_.push_back(block);
        for (; order_.size() > kMostBlocks; order_.pop_front())
            held_.erase(order_.front());
    }

    /// Sends requests while there are few. The mutex is locked.
    void pump() {
        while (!closed_ && under_way_ < kAtOnce && !wanted_.empty()) {
            const bool few = wanted_.size() * kBlock < kTogether / 8;
            if (urgent_.empty() && under_way_ >= kBusy && few)
                return;
            Sent next = take_wanted();
            if (next.ranges.size() > 1 && !several_)
                trying_ = true;
            send(std::move(next));
        }
    }

    /// The blocks to ask for next, the first of those that somebody waits for before others.
    Sent take_wanted() {
        const bool together = several_.value_or(!trying_);
        auto at = urgent_.empty() ? wanted_.end() : wanted_.find(*urgent_.begin());
        if (at == wanted_.end()) {
            urgent_.clear();
            at = wanted_.begin();
        }
        Sent sent;
        std::uint64_t bytes = 0;
        while (at != wanted_.end() && bytes < kTogether) {
            const LinkRange block{at->first * kBlock, at->first * kBlock + bytes_of(at->first)};
            LinkRange* const last = sent.ranges.empty() ? nullptr : &sent.ranges.back();
            if (last && block.begin - last->end < (together ? 1 : kNear))
                last->end = block.end; // what lies between comes, too
            else if (last && (!together || sent.ranges.size() == kMostRanges))
                break;
            else
                sent.ranges.push_back(block);
            bytes += block.bytes();
            asked_.insert_or_assign(at->first, at->second);
            urgent_.erase(at->first);
            at = wanted_.erase(at);
        }
        return sent;
    }

    void send(Sent sent) {
        ++under_way_;
        std::uint64_t most = 0;
        for (const LinkRange& range : sent.ranges)
            most +=
                range.bytes() + (sent.ranges.size() > 1 ? 1024 : 0); // with the head of its part
        HttpRequest request = request_of(sent.ranges, 206, most + 1024, sent.time);
        transport_->send(std::move(request), [self = shared_from_this(), sent = std::move(sent)](
                                                 HttpAnswer answer) { self->came(sent, answer); });
    }

    /// Takes an answer, on the thread of the transport.
    void came(const Sent& sent, const HttpAnswer& answer) {
        if (may_pass(answer) && sent.time < kTries) {
            const std::lock_guard lock(mutex_);
            --under_way_;
            return send({sent.ranges, sent.time + 1});
        }
        const bool other =
            answer.failure.empty() &&
            (answer.status == 412 || ((answer.status == 200 || answer.status == 206) &&
                                      strong_tag(answer.field("etag")) != tag_));
        if (other)
            return end_all(sent, changed_words(), true);
        if (!answer.failure.empty())
            return end_all(sent, answer.failure, false);
        if (sent.ranges.size() > 1 && (answer.status == 200 || answer.status == 416))
            return ask_singly(sent);
        if (answer.status != 206)
            return end_all(sent, words_of_status(answer), false);
        std::vector<AnswerPart> parts;
        if (const std::string boundary = boundary_of(answer.field("content-type"));
            !boundary.empty())
            parts = parts_of(answer.body, boundary);
        else if (const auto where = content_range(answer.field("content-range"));
                 where && where->range.bytes() == answer.body.size())
            parts.push_back({*where, answer.body});
        if (std::ranges::any_of(parts,
                                [&](const AnswerPart& part) { return part.where.total != size_; }))
            return end_all(sent, changed_words(), true);
        const auto has = [&](const LinkRange& range) {
            return std::ranges::find_if(parts, [&](const AnswerPart& part) {
                return part.where.range.begin <= range.begin && range.end <= part.where.range.end;
            });
        };
        const bool whole = std::ranges::all_of(
            sent.ranges, [&](const LinkRange& range) { return has(range) != parts.end(); });
        if (!whole && sent.ranges.size() > 1)
            return ask_singly(sent);
        if (!whole)
            return end_all(sent, "the server does not send the bytes that it was asked for", false);
        std::vector<std::pair<std::uint64_t, std::string>> blocks;
        for (const LinkRange& range : sent.ranges)
            for (std::uint64_t at = range.begin; at < range.end; at += kBlock)
                blocks.emplace_back(at / kBlock,
                                    has(range)->bytes.substr(at - has(range)->where.range.begin,
                                                             bytes_of(at / kBlock)));
        if (tag_.empty())
            confirm(sent, std::move(blocks));
        else
            put(sent, std::move(blocks));
    }

    /// Without a tag, the first block says whether the file is still the same: it is read once more.
    void confirm(const Sent& sent, std::vector<std::pair<std::uint64_t, std::string>> blocks) {
        const LinkRange first{0, first_.size()};
        transport_->send(request_of({first}, 206, first.bytes(), 1),
                         [self = shared_from_this(), sent,
                          blocks = std::move(blocks)](const HttpAnswer& answer) mutable {
                             if (!answer.failure.empty() || answer.status != 206)
                                 return self->end_all(sent,
                                                      answer.failure.empty()
                                                          ? words_of_status(answer)
                                                          : answer.failure,
                                                      false);
                             if (answer.body != self->first_)
                                 return self->end_all(sent, self->changed_words(), true);
                             self->put(sent, std::move(blocks));
                         });
    }

    void put(const Sent& sent, std::vector<std::pair<std::uint64_t, std::string>> blocks) {
        if (store_)
            for (const auto& [block, bytes] : blocks)
                store_->put(block, bytes);
        const std::lock_guard lock(mutex_);
        for (auto& [block, bytes] : blocks)
            hold(block, std::move(bytes));
        if (sent.ranges.size() > 1)
            several_ = true;
        end(sent, {}, false);
    }

    /// The server does not answer several ranges at once: they are asked for one by one.
    void ask_singly(const Sent& sent) {
        const std::lock_guard lock(mutex_);
        several_ = false;
        for (const std::uint64_t block : blocks_of(sent))
            if (auto found = asked_.extract(block)) {
                wanted_.emplace(block, found.mapped());
                urgent_.insert(block);
            }
        --under_way_;
        pump();
    }

    static std::vector<std::uint64_t> blocks_of(const Sent& sent) {
        std::vector<std::uint64_t> blocks;
        for (const LinkRange& range : sent.ranges)
            for (std::uint64_t block = range.begin / kBlock; block * kBlock < range.end; ++block)
                blocks.push_back(block);
        return blocks;
    }

    void end_all(const Sent& sent, const std::string& failure, bool changed) {
        const std::lock_guard lock(mutex_);
        end(sent, failure, changed);
    }

    /// Ends the wait for what was asked. The mutex is locked.
    void end(const Sent& sent, const std::string& failure, bool changed) {
        for (const std::uint64_t block : blocks_of(sent))
            if (auto found = asked_.extract(block)) {
                found.mapped()->ended = true;
                found.mapped()->failure = failure;
                found.mapped()->changed = changed;
            }
        --under_way_;
        trying_ = false;
        pump();
        came_.notify_all();
    }

    static std::string changed_words() { return "the file is another one than when it was opened"; }

    const std::string address_;
    const std::shared_ptr<HttpTransport> transport_;
    const bool keep_;
    const std::string authorization_;
    const pid_t owner_ = ::getpid();
    std::uint64_t size_ = 0;
    std::string tag_;   ///< a strong one; empty: the server names none
    std::string first_; ///< the first block, as it was at the opening
    std::optional<BlockStore> store_;

    std::mutex mutex_; ///< for the members below
    std::condition_variable came_;
    std::map<std::uint64_t, AwaitedPtr> wanted_;          ///< blocks that wait to be asked for
    std::set<std::uint64_t> urgent_;                      ///< those of them that are waited for
    std::unordered_map<std::uint64_t, AwaitedPtr> asked_; ///< blocks of requests under way
    std::unordered_map<std::uint64_t, std::string> held_; ///< what came last
    std::deque<std::uint64_t> order_;                     ///< blocks that are held
    std::optional<bool>
        several_;         ///< whether the server answers several ranges at once; empty: unknown
    bool trying_ = false; ///< a request finds that out
    unsigned under_way_ = 0;
    bool closed_ = false;
};

class LinkSource final : public RemoteSource {
  public:
    /// @param last nobody else reads the content
    LinkSource(std::shared_ptr<Content> content, std::shared_ptr<HttpTransport> transport,
               bool keep, bool last)
        : name_(content->address()), size_(content->size()), transport_(std::move(transport)),
          keep_(keep), last_(last), content_(std::move(content)) {}
    ~LinkSource() override {
        if (last_)
            content_->close();
    }

    const std::string& name() const override { return name_; }
    std::uint64_t size() const override { return size_; }
    void expect(std::uint64_t offset, std::uint64_t bytes) const override {
        content()->expect(offset, bytes);
    }
    bool may_have_changed() const override { return content()->may_have_changed(); }
    void accept_where(Same same) const override {
        const std::lock_guard lock(mutex_);
        same_ = std::move(same);
    }

  protected:
    std::size_t read_some(std::uint64_t offset, std::span<std::byte> out) const override {
        if (offset >= size_)
            return 0;
        out = out.first(std::min<std::uint64_t>(out.size(), size_ - offset));
        const std::span some = out.first(std::min<std::uint64_t>(out.size(), kPiece));
        const std::shared_ptr<Content> now = content();
        now->expect(offset, std::min<std::uint64_t>(out.size(), 4 * kPiece));
        if (!now->read(offset, some) && !(renew(now) && content()->read(offset, some)))
            now->fail("the file is another one than when it was opened: open it again");
        return some.size();
    }

  private:
    std::shared_ptr<Content> content() const {
        const std::lock_guard lock(mutex_);
        return content_;
    }

    /// Opens the file that lies there now, and goes on with it where it holds what the old one held.
    bool renew(const std::shared_ptr<Content>& old) const {
        const std::lock_guard renewing(renewing_);
        if (content() != old)
            return true;
        const Same same = [&] {
            const std::lock_guard lock(mutex_);
            return same_;
        }();
        if (!same)
            return false;
        auto now = std::make_shared<Content>(name_, transport_, keep_);
        try {
            now->open();
            if (now->size() < size_ ||
                !same(std::make_unique<LinkSource>(now, transport_, keep_, false)))
                return false;
        } catch (const Error&) { // what lies there now is no such file
            return false;
        }
        {
            const std::lock_guard lock(mutex_);
            content_ = std::move(now);
        }
        old->close();
        return true;
    }

    const std::string name_;
    const std::uint64_t size_;
    const std::shared_ptr<HttpTransport> transport_;
    const bool keep_, last_;
    mutable std::mutex renewing_, mutex_;
    mutable std::shared_ptr<Content> content_;
    mutable Same same_;
};

/// The address of the first index that a page names in its list.
std::string first_of_site(const std::string& page,
                          const std::shared_ptr<HttpTransport>& transport) {
    const std::string list = beside(page, "site.json");
    const auto content = std::make_shared<Content>(list, transport, false);
    const HttpAnswer answer = content->asked({}, 200, kMostList);
    if (!answer.failure.empty())
        content->fail(answer.failure);
    if (answer.status != 200)
        throw Error("{}: no page of indices: {} (status {}); expected the link of a page of "
                    "isochron serve, or of an index",
                    page, list, answer.status);
    const auto json = nlohmann::json::parse(answer.body, nullptr, false);
    const auto files = json.is_object() ? json.find("files") : json.end();
    if (!json.is_object() || files == json.end() || !files->is_array() || files->empty() ||
        !files->front().is_string() || !is_plain_name(files->front().get_ref<const std::string&>()))
        content->fail("expected the list of a page of isochron serve");
    return beside(page, files->front().get<std::string>());
}

bool is_page(const std::string& address) {
    const std::string path = address.substr(0, address.find_first_of("?#"));
    return path.ends_with('/') || path.ends_with("/index.html") ||
           path.find('/', path.find("://") + 3) == path.npos;
}

} // namespace

std::shared_ptr<HttpTransport> http_transport() {
    return static_cast<const LinksModule*>(module_symbol("isochron_links", "isochron_links_module"))
        ->transport();
}

const RemoteSource* remote_of(const ByteSource& source) {
    return dynamic_cast<const RemoteSource*>(&source);
}

std::unique_ptr<ByteSource> open_link(const std::string& address,
                                      std::shared_ptr<HttpTransport> transport, bool keep) {
    auto content = std::make_shared<Content>(
        is_page(address) ? first_of_site(address, transport) : address, transport, keep);
    content->open();
    return std::make_unique<LinkSource>(std::move(content), std::move(transport), keep, true);
}

std::unique_ptr<ByteSource> open_link(const std::string& address) {
    return open_link(address_of(address), http_transport(), true);
}

std::unique_ptr<ByteSource> open_bytes(const std::filesystem::path& path) {
    return is_link(path.native()) ? open_link(path.native()) : open_local_bytes(path, path);
}

} // namespace isochron::index
