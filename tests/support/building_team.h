// A team whose members build an index together, as threads of one test.
#pragma once

#include "index/system/team.h"

#include <barrier>
#include <cstdlib>
#include <functional>
#include <optional>
#include <span>
#include <stdexcept>
#include <thread>
#include <vector>

namespace isochron::test_support {

class BuildingTeam final : public index::Team {
  public:
    /// What all members share.
    struct Table {
        explicit Table(unsigned members)
            : said(members), met(static_cast<std::ptrdiff_t>(members)) {}
        std::vector<std::vector<std::byte>> said; ///< by member
        std::barrier<> met;
    };

    BuildingTeam(Table& table, unsigned rank) : table_(table), rank_(rank) {}
    unsigned rank() const override { return rank_; }
    unsigned size() const override { return static_cast<unsigned>(table_.said.size()); }
    std::vector<std::vector<std::byte>> gather(std::span<const std::byte> mine) override {
        table_.said[rank_].assign(mine.begin(), mine.end());
        table_.met.arrive_and_wait();
        auto all = table_.said;
        table_.met.arrive_and_wait();
        return all;
    }
    void post(unsigned, std::span<const std::byte>) override {
        throw std::logic_error("a build posts nothing");
    }
    std::optional<Message> poll() override { return std::nullopt; }
    [[noreturn]] void abandon(int) override { std::abort(); }

    /// Runs the part of each member on a thread of its own.
    static void run(unsigned members, const std::function<void(index::Team& team)>& part) {
        Table table(members);
        std::vector<std::jthread> threads;
        for (unsigned rank = 0; rank < members; ++rank)
            threads.emplace_back([&, rank] {
                BuildingTeam team(table, rank);
                part(team);
            });
    }

  private:
    Table& table_;
    unsigned rank_;
};

} // namespace isochron::test_support
