// How much memory and time a reader may take for a file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace isochron::index {

/// The memory and time that this process may take from now on, by the size of the file that it
/// works on. Beyond its memory allocations fail; beyond its time it is ended with SIGXCPU.
class ReaderBudget {
  public:
    /// @param most [bytes] of memory; 0: what was free at the first file
    ReaderBudget(const std::filesystem::path& file, std::uint64_t most);

    /// Makes room for values that take so much in the library, too.
    void expect(std::uint64_t decoded_bytes);
    /// Another request, another share of time.
    void renew_time() const;

    /// `at most 1.5 GB for it`
    std::string text() const;

  private:
    std::uint64_t file_bytes_ = 0, before_ = 0, most_ = 0;
    std::uint64_t memory_ = 0; ///< [bytes] beside what was taken before
};

} // namespace isochron::index
