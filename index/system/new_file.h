// A file that appears under its name only when it is complete.
#pragma once

#include "index/system/byte_sink.h"
#include "index/system/descriptor.h"
#include "index/system/temporary/remains.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

namespace isochron::index {

/// Writes all bytes to an open file. @return 0, or the system's error number
int write_all(int file, std::uint64_t offset, std::span<const std::byte> bytes);

/// Makes a folder, and its parents, if they are missing.
/// @throws Error naming it, with the system's message
void make_folder(const std::filesystem::path& folder);

/// The name at the end of symbolic links, whether or not there is a file: what is written under
/// `path` belongs there, and the links stay.
/// @throws Error when they lead in a circle
std::filesystem::path end_of_links(std::filesystem::path path);

/// Gives a file that another program has written its name, once its bytes are on the disk.
/// @param target leads through links; a file that is there is replaced
/// @throws Error naming the target
void name_whole_file(const std::filesystem::path& written, const std::filesystem::path& target);

/// As ByteSink::begin_flush, for an open file.
void begin_flush_of(int file);

/// Writes to a file without a name, which vanishes with its process, in the folder of NAME, which is
/// the end of the links that the target leads through; `commit` gives it its name. Where several
/// processes write, or the file system knows no files without a name, it writes to a temporary name,
/// which `commit` renames. If it is destroyed before that, it removes the
/// temporary file, and an older file of that name stays as it was. Every function throws Error with
/// the final name and the system's message (disk full, folder not writable, ...).
class NewFile final : public ByteSink {
  public:
    enum class Writers : std::uint8_t { one, several };
    /// @throws Error also when `target` exists and is not a regular file
    explicit NewFile(std::filesystem::path target, Writers writers = Writers::one);
    /// Writes to the temporary file of another process, which owns it: `commit` only flushes then.
    NewFile(std::filesystem::path target, std::filesystem::path temporary);
    ~NewFile() override;
    NewFile(const NewFile&) = delete;
    NewFile& operator=(const NewFile&) = delete;

    /// Claims disk space from the start of the file, so that a full disk is found before the work.
    void reserve(std::uint64_t bytes);
    void write_at(std::uint64_t offset, std::span<const std::byte> bytes) override;
    void begin_flush() override;
    /// Flushes to disk, then renames the file to its final name.
    void commit();

    /// Its name until then; a file without a name gets it for a moment where another file has NAME.
    const std::filesystem::path& temporary() const { return temporary_; }
    /// Under which this process can open it.
    std::filesystem::path path_to_open() const;

  private:
    [[noreturn]] void fail(int error) const;
    void open_unnamed(const std::filesystem::path& folder);
    void create_named();
    void take_temporary_name();
    template <class Use>
    void with_new_name(const Use& use);
    bool link_to(const std::filesystem::path& name) const;
    void take_name();
    std::filesystem::path target_, temporary_;
    Descriptor file_;
    bool owner_ = true, named_ = false;
    LedgerEntry entry_; ///< while it has its temporary name
};

/// Writes a file that holds these bytes. @throws as NewFile does
void write_file(const std::filesystem::path& target, std::span<const std::byte> bytes);
inline void write_file(const std::filesystem::path& target, std::string_view text) {
    write_file(target, std::as_bytes(std::span(text)));
}

} // namespace isochron::index
