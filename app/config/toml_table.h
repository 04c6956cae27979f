// A table of a TOML file while it is read: which keys it has, which are known, and where it stands.
#pragma once

// The parser asserts that a key begins with a valid character, right before it reports an error for
// keys that do not. Without its assertion, damaged files give that error in every build.
#define TOML_ASSERT(expression) static_assert(true)
#include <toml++/toml.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::app {

/// Keys may be paths to what lies in tables within: `rendering.near`. A key or word that was spelled
/// in another way up to version 0.1 is found under that spelling, too.
class TomlTable {
  public:
    /// @param where the table's name for messages: `windows.viewports`; empty: the file
    TomlTable(const toml::table& table, std::string file, std::string where);
    /// The table within, whether it is there or not. It shares the list of known keys.
    TomlTable within(std::string_view key) const;
    /// A table of a list in this one.
    TomlTable item(std::string_view key, const toml::node& table) const;

    bool has(std::string_view key) const { return find(key) != nullptr; }
    /// The value of a key, which is known from now on; null: absent.
    const toml::node* take(std::string_view key);
    /// Whether a key was taken.
    bool knows(std::string_view key) const;
    bool is_there() const { return !!here(); }
    int line() const; ///< line of the table; 0: it is not there

    /// @throws ConfigError with the place of `key`, or of the table around it if that is absent
    [[noreturn]] void fail(std::string_view key, const std::string& message) const;
    /// @throws ConfigError for a key that is not known, with the nearest known one
    void finish() const;

  private:
    const toml::table* here() const;
    const toml::node* find(std::string_view key) const;
    void finish(const toml::table& table, const std::string& prefix) const;

    const toml::table* table_;
    std::string file_, where_;
    std::string prefix_; ///< prefix of this table in `table_`, with a dot at its end
    std::shared_ptr<std::vector<std::string>> known_; ///< paths in `table_`
};

/// A word as it is spelled now.
std::string_view new_spelling(std::string_view word);

/// `an integer`, `an array`, ...
std::string type_name(const toml::node& node);

} // namespace isochron::app
