// Limits the memory and time of a reader from outside: its fence lets it change no limit.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>

#include <sys/types.h>

namespace isochron::index {

/// [bytes] of memory that the machine has free. Asking takes as long as opening a small file.
std::uint64_t free_memory();

/// What a reader may take for a file, by the file's size. Beyond the limit of memory its allocations
/// fail; beyond the limit of processor time the system ends it with SIGXCPU.
class ReaderBudget {
  public:
    /// @param most [bytes] of memory
    /// @throws Error where the system lets no limit be set, as all functions here
    ReaderBudget(pid_t reader, const std::filesystem::path& file, std::uint64_t most);

    /// Raises the limit of memory for values that take this much in the library.
    void expect(std::uint64_t decoded_bytes);
    /// Starts a new share of processor time, for another request.
    void renew_time() const;

    /// What the file adds to any limit of time: a second for each megabyte.
    std::chrono::seconds time_of_bytes() const {
        return std::chrono::seconds(file_bytes_ / 1'000'000);
    }

  private:
    pid_t reader_;
    std::uint64_t file_bytes_ = 0, before_ = 0, most_ = 0; ///< `before_`: in use before the file
};

} // namespace isochron::index
