// A file that is appended to in place, by one writer at a time.
#pragma once

#include "index/system/byte_sink.h"

#include <filesystem>

namespace isochron::index {

/// Opens an existing regular file for writing, by position.
class GrowingFile final : public GrowingSink {
  public:
    /// @param alone lock it, so that no other program appends until this is closed. In a team, only
    ///        rank 0 sets it
    /// @throws Error: missing, not a regular file, not writable, another program appends to it
    GrowingFile(std::filesystem::path path, bool alone);
    ~GrowingFile() override;
    GrowingFile(const GrowingFile&) = delete;
    GrowingFile& operator=(const GrowingFile&) = delete;

    void write_at(std::uint64_t offset, std::span<const std::byte> bytes) override;
    void begin_flush() override;
    void flush() override;
    void cut(std::uint64_t bytes) override;

  private:
    [[noreturn]] void fail(int error) const;
    std::filesystem::path path_;
    int file_ = -1;
};

} // namespace isochron::index
