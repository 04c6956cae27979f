// What commands leave behind when they are killed, and the user's ledger of it, by which later
// commands remove it.
//
// A name proves nothing: whoever may write in a folder can give a user's own folder the name of a
// temporary one. So a temporary file or folder with a name stands in the ledger from before it can
// be left behind until its process has renamed or removed it, and only what stands there is removed
// later, if it is still the same. The ledger is a folder in the user's folder for state of programs
// that nobody else can open; each of its entries is a symbolic link, which is made and removed as a
// whole, so that any number of processes keep it without a lock and whenever they are killed.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace isochron::index {

/// A temporary name for that file, beside it, as `remove_remains_in` expects it.
std::filesystem::path temporary_name_of(const std::filesystem::path& file);

/// Removes the temporary file or folder at `path` unless another one lies there meanwhile. Of a
/// folder's contents only files go, and nothing goes that has another name.
/// @param file it is open as
/// @param contents how the names of all files begin that its process puts into the folder
void remove_temporary(const char* path, int file, std::string_view contents = {}) noexcept;

/// Has a temporary file or folder stand in the ledger while it lives. Where there is no ledger, or
/// it cannot be written, later commands leave alone what this process leaves behind.
class LedgerEntry {
  public:
    LedgerEntry() = default;
    /// @param path, file, contents as for `remove_temporary`
    LedgerEntry(const std::filesystem::path& path, int file,
                std::string_view contents = {}) noexcept;
    ~LedgerEntry() { strike(); }
    LedgerEntry(LedgerEntry&& other) noexcept : link_(std::move(other.link_)) {
        other.link_.clear();
    }
    LedgerEntry& operator=(LedgerEntry&& other) noexcept {
        link_.swap(other.link_);
        return *this;
    }

  private:
    void strike() noexcept;
    std::string link_; ///< path of its symbolic link; empty: there is none
};

/// Removes what killed processes have left in a folder: what stands in the ledger, is still the
/// same, is locked by nobody and older than a minute. Once for each folder and process.
void remove_remains_in(const std::filesystem::path& folder);

} // namespace isochron::index
