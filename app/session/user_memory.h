// What the program remembers of its user between sessions, in their folder for such things.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

namespace isochron::app {

/// $XDG_STATE_HOME/isochron, else ~/.local/state/isochron. Nothing where there is no home.
std::optional<std::filesystem::path> user_state_folder();

/// Nothing that it cannot read or write is an error: it then remembers nothing.
class UserMemory {
  public:
    static constexpr std::size_t kMost = 10; ///< data that are remembered

    /// @param folder made where it is missing; nothing: remembers nothing
    explicit UserMemory(std::optional<std::filesystem::path> folder);

    /// Data that were open lately and are still there, the newest first.
    std::vector<std::filesystem::path> recent() const;
    void remember(const std::filesystem::path& data);

    /// Whether the user has seen the first lines. Where nothing can be remembered they have.
    bool introduced() const;
    void set_introduced();

  private:
    std::optional<std::filesystem::path> folder_;
};

} // namespace isochron::app
