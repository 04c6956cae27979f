// Files in memory: one that is read, and one that keeps a log of what is done to it.
#pragma once

#include "index/system/byte_sink.h"
#include "index/system/byte_source.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace isochron::index {

/// What was done to a file, in its order.
struct Write {
    enum Kind { write, flush, cut } kind;
    std::uint64_t offset = 0; ///< or what is left of it
    std::string bytes = {};
};

/// A file in memory that keeps a log.
class LoggedFile final : public GrowingSink {
  public:
    explicit LoggedFile(std::string bytes) : bytes_(std::move(bytes)) {}

    void write_at(std::uint64_t offset, std::span<const std::byte> bytes) override {
        log.push_back(
            {Write::write, offset, {reinterpret_cast<const char*>(bytes.data()), bytes.size()}});
        written += bytes.size();
        apply(bytes_, log.back());
    }
    void flush() override { log.push_back({Write::flush}); }
    void cut(std::uint64_t bytes) override {
        log.push_back({Write::cut, bytes});
        apply(bytes_, log.back());
    }

    static void apply(std::string& file, const Write& write) {
        if (write.kind == Write::cut && file.size() > write.offset)
            file.resize(write.offset);
        if (write.kind != Write::write)
            return;
        if (file.size() < write.offset + write.bytes.size())
            file.resize(write.offset + write.bytes.size());
        file.replace(write.offset, write.bytes.size(), write.bytes);
    }

    const std::string& bytes() const { return bytes_; }
    std::vector<Write> log;
    std::uint64_t written = 0;

  private:
    std::string bytes_;
};

/// A file in memory that is read.
class BytesInMemory final : public ByteSource {
  public:
    explicit BytesInMemory(std::string bytes) : bytes_(std::move(bytes)) {}
    const std::string& name() const override { return name_; }
    std::uint64_t size() const override { return bytes_.size(); }

  protected:
    std::size_t read_some(std::uint64_t offset, std::span<std::byte> out) const override {
        const std::size_t count = std::min<std::size_t>(out.size(), bytes_.size() - offset);
        std::memcpy(out.data(), bytes_.data() + offset, count);
        return count;
    }

  private:
    std::string name_ = "memory", bytes_;
};

} // namespace isochron::index
