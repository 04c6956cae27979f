// The team of an MPI job, as a module that is loaded only inside such a job.
#include "index/error.h"
#include "index/system/team.h"

#include <mpi.h>

#include <cstdio>
#include <cstdlib>
#include <deque>
#include <limits>
#include <mutex>

namespace isochron::index {
namespace {

class MpiTeam final : public Team {
  public:
    MpiTeam() {
        int given = 0;
        MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &given);
        if (given < MPI_THREAD_SERIALIZED)
            throw Error("MPI: expected a library that several threads may call, one at a time");
        MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
        MPI_Comm_size(MPI_COMM_WORLD, &size_);
    }
    ~MpiTeam() override {
        for (Sending& sending : under_way_)
            MPI_Wait(&sending.request, MPI_STATUS_IGNORE);
        MPI_Finalize();
    }

    unsigned rank() const override { return static_cast<unsigned>(rank_); }
    unsigned size() const override { return static_cast<unsigned>(size_); }

    std::vector<std::vector<std::byte>> gather(std::span<const std::byte> mine) override {
        std::vector<std::uint64_t> sizes(size());
        const std::uint64_t own = mine.size();
        MPI_Allgather(&own, 1, MPI_UINT64_T, sizes.data(), 1, MPI_UINT64_T, MPI_COMM_WORLD);
        std::vector<int> counts, starts;
        std::uint64_t total = 0;
        for (const std::uint64_t bytes : sizes) {
            starts.push_back(static_cast<int>(total));
            counts.push_back(static_cast<int>(bytes));
            total += bytes;
            // All members see the same sizes, so all of them throw.
            if (total > static_cast<std::uint64_t>(std::numeric_limits<int>::max()))
                throw Error("MPI: {} bytes to exchange, expected less than 2^31", total);
        }
        std::vector<std::byte> all(total);
        MPI_Allgatherv(mine.data(), static_cast<int>(own), MPI_BYTE, all.data(), counts.data(),
                       starts.data(), MPI_BYTE, MPI_COMM_WORLD);
        std::vector<std::vector<std::byte>> parts;
        std::size_t at = 0;
        for (const std::uint64_t bytes : sizes) {
            const auto first = all.begin() + static_cast<std::ptrdiff_t>(at);
            parts.emplace_back(first, first + static_cast<std::ptrdiff_t>(bytes));
            at += bytes;
        }
        return parts;
    }

    void post(unsigned to, std::span<const std::byte> message) override {
        const std::scoped_lock lock(calls_);
        std::erase_if(under_way_, [](Sending& sending) {
            int done = 0;
            MPI_Test(&sending.request, &done, MPI_STATUS_IGNORE);
            return done != 0;
        });
        Sending& sending = under_way_.emplace_back();
        sending.bytes.assign(message.begin(), message.end());
        MPI_Isend(sending.bytes.data(), static_cast<int>(sending.bytes.size()), MPI_BYTE,
                  static_cast<int>(to), kPosted, MPI_COMM_WORLD, &sending.request);
    }

    std::optional<Message> poll() override {
        const std::scoped_lock lock(calls_);
        int there = 0, size = 0;
        MPI_Message found;
        MPI_Status status;
        MPI_Improbe(MPI_ANY_SOURCE, kPosted, MPI_COMM_WORLD, &there, &found, &status);
        if (!there)
            return std::nullopt;
        MPI_Get_count(&status, MPI_BYTE, &size);
        Message message{static_cast<unsigned>(status.MPI_SOURCE),
                        std::vector<std::byte>(static_cast<std::size_t>(size))};
        MPI_Mrecv(message.bytes.data(), size, MPI_BYTE, &found, MPI_STATUS_IGNORE);
        return message;
    }

    [[noreturn]] void abandon(int status) override {
        std::fflush(nullptr);
        MPI_Abort(MPI_COMM_WORLD, status);
        std::_Exit(status); // MPI_Abort is not declared noreturn
    }

  private:
    static constexpr int kPosted = 1; ///< tag
    struct Sending {
        std::vector<std::byte> bytes; ///< MPI reads them until the request is done
        MPI_Request request = MPI_REQUEST_NULL;
    };

    int rank_ = 0, size_ = 1;
    std::mutex calls_; ///< for calls of MPI, since several threads post messages
    std::deque<Sending> under_way_;
};

} // namespace
} // namespace isochron::index

extern "C" __attribute__((visibility("default"))) isochron::index::Team* isochron_join_team() {
    return new isochron::index::MpiTeam();
}
