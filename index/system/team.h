// The processes that work on one thing together: building an index, showing a room.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace isochron::index {

/// One process alone, or the ranks of an MPI job, which share a file system. Every function but the
/// first two is called by all members, in the same order.
class Team {
  public:
    virtual ~Team() = default;
    virtual unsigned rank() const = 0; ///< from 0, who alone names files and reports
    virtual unsigned size() const = 0;

    /// What every member gives, in order of rank; each aligned as memory from `new` is.
    virtual std::vector<std::vector<std::byte>> gather(std::span<const std::byte> mine) = 0;

    /// What another member has posted.
    struct Message {
        unsigned from;
        std::vector<std::byte> bytes;
    };
    /// Sends to another member, waiting for nothing. Any thread may call it, beside one that polls.
    virtual void post(unsigned to, std::span<const std::byte> message) = 0;
    /// What has come and has not been taken, those of one member in their order; waits for nothing.
    virtual std::optional<Message> poll() = 0;
    /// Ends this process and all others at once, whatever they are doing.
    [[noreturn]] virtual void abandon(int status) = 0;

    /// Does a member's part. When it throws, or that of another member does, everybody throws: its
    /// own exception, or an Error with what the first of the others said.
    void together(const std::function<void()>& part);

    /// The items of all members in one row, in order of rank; plain data.
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
    /// One of each.
    template <class T>
    std::vector<T> gather_values(const T& mine) {
        return gather_items(std::span<const T>(&mine, 1));
    }

    /// A member's share of `count` items, as a stretch: [first, last).
    struct Share {
        std::size_t first, last;
    };
    Share share(std::size_t count) const;
};

/// This process alone.
std::unique_ptr<Team> alone();

/// The MPI job that this process was started in (mpirun), otherwise this process alone.
/// @throws Error when in a job, but built without MPI
std::unique_ptr<Team> join_team();

} // namespace isochron::index
