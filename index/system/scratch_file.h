// A file without a name: it goes with the process that made it, however that ends.
#pragma once

#include "index/system/byte_sink.h"

#include <filesystem>

namespace isochron::index {

class ScratchFile final : public ByteSink {
  public:
    /// @param beside a name in the folder on whose disk it lies, for messages
    /// @throws Error: there is no such folder, it cannot be written to
    explicit ScratchFile(std::filesystem::path beside);
    ~ScratchFile() override;
    ScratchFile(const ScratchFile&) = delete;
    ScratchFile& operator=(const ScratchFile&) = delete;

    void write_at(std::uint64_t offset, std::span<const std::byte> bytes) override;
    /// Reads what was written; all else is zero. @throws Error: the disk fails
    void read(std::uint64_t offset, std::span<std::byte> out) const;

  private:
    [[noreturn]] void fail(int error) const;
    std::filesystem::path beside_;
    int file_ = -1;
};

} // namespace isochron::index
