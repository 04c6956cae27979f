// What the program remembers between sessions, in the user's folder for state of programs.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

/// Files that it cannot read or write are no error: then it remembers nothing.
class UserMemory {
  public:
    static constexpr std::size_t kMost = 10; ///< most data that are remembered

    /// @param folder is made if it is missing; empty: remembers nothing
    explicit UserMemory(std::optional<std::filesystem::path> folder);

    /// Recently opened data that still exist, newest first: files, folders, and patterns of files
    /// in folders that exist.
    std::vector<std::filesystem::path> recent() const;
    void remember(const std::filesystem::path& data);

    /// The array of these data that the user has chosen last; empty if none.
    std::string array_of(const std::filesystem::path& data) const;
    void remember_array(const std::filesystem::path& data, const std::string& array);

    /// Whether the user has seen the introduction; also true if nothing can be remembered.
    bool introduced() const { return has("introduced"); }
    void set_introduced() { keep("introduced"); }
    /// Whether the user has read what an emulated room is; also true if nothing can be remembered.
    bool knows_room() const { return has("room-explained"); }
    void set_knows_room() { keep("room-explained"); }

  private:
    std::vector<std::string> lines_of(const char* file) const;
    bool has(const char* file) const;
    void keep(const char* file) const;

    std::optional<std::filesystem::path> folder_;
};

} // namespace isochron::app
