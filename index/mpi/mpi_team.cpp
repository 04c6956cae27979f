// The ranks of an MPI job: a module, loaded only inside one.
#include "index/error.h"
#include "index/team.h"

#include <fmt/format.h>

#include <mpi.h>

#include <limits>

namespace isochron::index {
namespace {

class MpiTeam final : public Team {
  public:
    MpiTeam() {
        MPI_Init(nullptr, nullptr);
        MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
        MPI_Comm_size(MPI_COMM_WORLD, &size_);
    }
    ~MpiTeam() override { MPI_Finalize(); }

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
            // All see the same sizes, so all throw.
            if (total > static_cast<std::uint64_t>(std::numeric_limits<int>::max()))
                throw Error(fmt::format("MPI: {} bytes to exchange, expected less than 2^31",
                                        total));
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

  private:
    int rank_ = 0, size_ = 1;
};

} // namespace
} // namespace isochron::index

extern "C" __attribute__((visibility("default"))) isochron::index::Team* isochron_join_team() {
    return new isochron::index::MpiTeam();
}
