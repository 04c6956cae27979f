// A temporary file without a name, which vanishes when its process ends in any way.
#pragma once

#include "index/system/byte_sink.h"

#include <filesystem>

namespace isochron::index {

class ScratchFile final : public ByteSink {
  public:
    /// @param beside a path in the folder on whose disk the file lies; also its name in messages
    /// @throws Error: there is no such folder, it cannot be written to
    explicit ScratchFile(std::filesystem::path beside);
    ~ScratchFile() override;
    ScratchFile(const ScratchFile&) = delete;
    ScratchFile& operator=(const ScratchFile&) = delete;

    void write_at(std::uint64_t offset, std::span<const std::byte> bytes) override;
    /// Reads bytes; those that were not written are zero. @throws Error: the disk fails
    void read(std::uint64_t offset, std::span<std::byte> out) const;

  private:
    [[noreturn]] void fail(int error) const;
    std::filesystem::path beside_;
    int file_ = -1;
};

} // namespace isochron::index
