// Limits the memory and time of a reader.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace isochron::index {

/// Opens what tells about memory, which the fence hides. To be called before it.
void hold_sources_of_limits();

/// Limits the memory and time of this process by the size of the file that it reads. Beyond the
/// limit of memory allocations fail; beyond the limit of time the process is ended with SIGXCPU.
class ReaderBudget {
  public:
    /// @param most [bytes] of memory; 0: what was free at the first file
    ReaderBudget(const std::filesystem::path& file, std::uint64_t most);

    /// Raises the limit of memory for values that take this much in the library.
    void expect(std::uint64_t decoded_bytes);
    /// Starts a new share of time, for another request.
    void renew_time() const;

    /// `at most 1.5 GB for it`
    std::string text() const;

  private:
    std::uint64_t file_bytes_ = 0, before_ = 0, most_ = 0;
    std::uint64_t memory_ = 0; ///< [bytes] limit, on top of what was in use before
};

} // namespace isochron::index
