// A team: processes that work together, to build an index or to show a room.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace isochron::index {

/// One process alone, or the ranks of an MPI job, which share a file system. All members must call
/// `gather` and the functions that use it in the same order.
class Team {
  public:
    virtual ~Team() = default;
    virtual unsigned rank() const = 0; ///< from 0; only rank 0 names files and reports
    virtual unsigned size() const = 0;

    /// The bytes of every member, in order of rank; each is aligned like memory from `new`.
    virtual std::vector<std::vector<std::byte>> gather(std::span<const std::byte> mine) = 0;

    /// A message from another member.
    struct Message {
        unsigned from;
        std::vector<std::byte> bytes;
    };
    /// Sends a message to another member without waiting. Any thread may call it, also while
    /// another thread polls.
    virtual void post(unsigned to, std::span<const std::byte> message) = 0;
    /// The next message that has arrived, if any; never waits. Messages of one member keep their
    /// order.
    virtual std::optional<Message> poll() = 0;
    /// Ends this process and all others at once, whatever they are doing.
    [[noreturn]] virtual void abandon(int status) = 0;

    /// Runs this member's part. If the part of any member throws, all members throw: each its own
    /// exception, or else an Error with the message of the lowest rank that failed.
    void together(const std::function<void()>& part);

    /// The items of all members in one vector, in order of rank. T must be plain data.
    template <class T>
    std::vector<T> gather_items(std::span<const T> mine) {
        std::vector<T> all;
        for (const std::vector<std::byte>& bytes : gather(std::as_bytes(mine))) {
            const T* items = reinterpret_cast<const T*>(bytes.data());
            all.insert(all.end(), items, items + bytes.size() / sizeof(T));
        }
        return all;
    }
    template <class T>
    std::vector<T> gather_items(const std::vector<T>& mine) {
        return gather_items(std::span<const T>(mine));
    }
    /// One value from each member, in order of rank.
    template <class T>
    std::vector<T> gather_values(const T& mine) {
        return gather_items(std::span<const T>(&mine, 1));
    }

    /// A member's share of `count` items, a contiguous range: [first, last).
    struct Share {
        std::size_t first, last;
    };
    Share share(std::size_t count) const;
};

/// This process alone.
std::unique_ptr<Team> alone();

/// The MPI job in which this process was started (mpirun), or else this process alone.
/// @throws Error when in a job, but built without MPI
std::unique_ptr<Team> join_team();

} // namespace isochron::index
