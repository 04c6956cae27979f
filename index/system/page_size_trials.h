// Whether new memory is faster in small or in huge pages, found by trials.
#pragma once

#include <array>
#include <chrono>
#include <mutex>
#include <optional>

namespace isochron::index {

enum class Pages : unsigned char { small, huge };

/// Chooses by the time that blocks of memory took before, from being asked for until all their pages
/// had been touched. On a physical machine huge pages take a fraction of the time. In a virtual
/// machine they may take as much as small ones, or many times as much: its host may have taken back
/// the free ones. Only a trial tells: each kind once, then the faster kind, and the slower kind
/// from time to time, the less often the more often it lost. Thread-safe.
class PageSizeTrials {
  public:
    /// Blocks between two trials of the slower kind, at first.
    static constexpr unsigned kBetweenTrials = 32;

    /// The trials for all blocks of this process.
    static PageSizeTrials& of_process();

    /// The pages that the next block shall have.
    Pages next();
    /// Tells how long a block of the usual size took.
    void took(Pages pages, std::chrono::nanoseconds time);

  private:
    std::mutex mutex_;
    /// How long blocks took of late, by the kind of their pages.
    std::array<std::optional<std::chrono::nanoseconds>, 2> times_;
    Pages better_ = Pages::small;
    unsigned between_ = kBetweenTrials, until_trial_ = kBetweenTrials;
};

} // namespace isochron::index
