// A file that is appended to in place, by one writer at a time.
#pragma once

#include "index/system/byte_sink.h"

#include <filesystem>

namespace isochron::index {

/// Opens an existing regular file for writing, by position.
class GrowingFile final : public GrowingSink {
  public:
    /// @param alone whether nobody else may write to it until this is closed; members of a team
    ///        that write beside the one who does leave it false
    /// @throws Error: missing, not a regular file, not writable, somebody else appends to it
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
