// A session file that belongs to one running program.
#pragma once

#include <filesystem>

namespace isochron::app {

/// Most windows that have a session each.
inline constexpr int kMostWindows = 99;

/// The lock beside a session file, which is there as long as a program has the file.
std::filesystem::path claim_of(const std::filesystem::path& session);

/// Two windows that show the same data would write the same file. The first of them has NAME, the
/// second NAME-2, and so on, until each ends.
class SessionClaim {
  public:
    /// @param wanted the file; its folder is made if it is missing. Where nothing can be written,
    /// it is taken as it is
    explicit SessionClaim(const std::filesystem::path& wanted);
    ~SessionClaim();
    SessionClaim(const SessionClaim&) = delete;
    SessionClaim& operator=(const SessionClaim&) = delete;

    const std::filesystem::path& path() const { return path_; }

  private:
    bool take(const std::filesystem::path& path);

    std::filesystem::path path_, lock_;
    int file_ = -1;
};

} // namespace isochron::app
