// A team whose members are threads of one test.
#pragma once

#include "index/system/team.h"

#include <atomic>
#include <deque>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <vector>

namespace isochron::test_support {

/// The inboxes of all members.
struct ThreadPost {
    explicit ThreadPost(unsigned members) : boxes(members), posted(members) {}
    std::mutex mutex;
    std::vector<std::deque<index::Team::Message>> boxes; ///< by receiver
    std::vector<std::atomic<int>> posted;                ///< by sender
};

class ThreadTeam final : public index::Team {
  public:
    ThreadTeam(ThreadPost& post, unsigned rank) : post_(post), rank_(rank) {}
    unsigned rank() const override { return rank_; }
    unsigned size() const override { return static_cast<unsigned>(post_.boxes.size()); }
    std::vector<std::vector<std::byte>> gather(std::span<const std::byte>) override {
        throw std::logic_error("a cluster gathers by itself");
    }
    void post(unsigned to, std::span<const std::byte> message) override {
        {
            const std::scoped_lock lock(post_.mutex);
            post_.boxes[to].push_back({rank_, {message.begin(), message.end()}});
        }
        ++post_.posted[rank_];
        post_.posted[rank_].notify_all();
    }
    std::optional<Message> poll() override {
        const std::scoped_lock lock(post_.mutex);
        auto& box = post_.boxes[rank_];
        if (box.empty())
            return std::nullopt;
        Message first = std::move(box.front());
        box.pop_front();
        return first;
    }
    [[noreturn]] void abandon(int) override { throw std::logic_error("nobody is to be ended"); }

  private:
    ThreadPost& post_;
    unsigned rank_;
};

} // namespace isochron::test_support
