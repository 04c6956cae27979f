// The one way to put bytes into a file by position.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace isochron::index {

/// A file that is written to by position. Every function throws Error with the file's name and
/// what the system said (disk full, ...).
class ByteSink {
  public:
    virtual ~ByteSink() = default;
    virtual void write_at(std::uint64_t offset, std::span<const std::byte> bytes) = 0;
    /// Lets the disk begin with what has been written, without waiting for it: so that a flush at
    /// the end of long work is short.
    virtual void begin_flush() {}
};

/// A file that grows while others read it: bytes behind its end are written first, and flushed
/// before a last write makes them count.
class GrowingSink : public ByteSink {
  public:
    /// Makes what was written before survive a power failure before anything that is written
    /// later.
    virtual void flush() = 0;
    /// Removes what lies behind `bytes`, if anything.
    virtual void cut(std::uint64_t bytes) = 0;
};

} // namespace isochron::index
