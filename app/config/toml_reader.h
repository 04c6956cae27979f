// Checked reading of a TOML table: every key is known, typed and in range, or the error says where.
#pragma once

#include "app/config/table_schema.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

// The parser asserts that a key begins with a character of a key, and right behind that has a clean
// error for keys that do not: damaged files get the error in every build.
#define TOML_ASSERT(expression) static_assert(true)
#include <toml++/toml.h>

#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::app {

/// `configs/desktop.toml:12: unknown key 'eye_seperation' in [viewer]; did you mean
/// 'eye_separation'?`
class ConfigError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// One table while it is read. Each call names a key that may be present and leaves the target
/// alone when it is absent; `finish` then refuses every key that no call named.
///
/// The same calls describe a table instead of reading one: then nothing is present, nothing fails,
/// the reader of every inner table runs once, and the schema takes note of all keys.
class TomlReader {
  public:
    /// @param where the table's name for messages: `windows.viewports`
    TomlReader(const toml::table& table, std::string file, std::string where);
    /// Describes. @param schema outlives this
    explicit TomlReader(TableSchema& schema);

    /// Numbers must be finite and in [low, high].
    void number(std::string_view key, double low, double high, float& into);
    void number(std::string_view key, double low, double high, double& into);
    void integer(std::string_view key, int low, int high, int& into);
    void flag(std::string_view key, bool& into);
    void text(std::string_view key, std::string& into);
    void vector(std::string_view key, glm::vec2& into);
    void vector(std::string_view key, glm::dvec2& into);
    void vector(std::string_view key, glm::vec3& into);
    void color(std::string_view key, glm::vec3& into); ///< sRGB, 0 to 1
    /// An array of at most `longest` numbers in [low, high].
    void list(std::string_view key, double low, double high, std::size_t longest,
              std::vector<double>& into);
    void integers(std::string_view key, int low, int high, glm::ivec2& into);

    /// A word out of a closed set; `parse` returns false for a word it does not know.
    void word(std::string_view key, const std::vector<std::string>& words,
              const std::function<void(const std::string&)>& take);

    /// A word out of those that the file itself has given, such as the names of its viewers.
    void given_word(std::string_view key, const std::vector<std::string>& words,
                    const std::function<void(const std::string&)>& take);

    int line() const { return static_cast<int>(table_.source().begin.line); } ///< of the table
    bool has(std::string_view key) const { return find(key) != nullptr; }

    /// A sub-table, or an array of tables, each read by `read` and finished after it.
    /// @return false when absent
    bool table(std::string_view key, const std::function<void(TomlReader&)>& read);
    bool tables(std::string_view key, const std::function<void(TomlReader&)>& read);
    /// Either of them.
    bool table_or_tables(std::string_view key, const std::function<void(TomlReader&)>& read);

    void finish() const;

    /// Throws with the place of `key`, or of the table when the key is absent; returns only where
    /// a table is described, of which nothing is known.
    void fail(std::string_view key, const std::string& message) const;

  private:
    [[noreturn]] void refuse(std::string_view key, const std::string& message) const;
    void describe(std::string_view key, const std::function<void(TomlReader&)>& read,
                  TableSchema::Times times);
    /// Under its name, or under the one that older files have for it.
    const toml::node* find(std::string_view key) const;
    const toml::node* get(std::string_view key);
    double finite_number(std::string_view key, const toml::node& node, double low,
                         double high) const;
    std::vector<double> numbers(std::string_view key, const toml::node& node,
                                std::size_t count) const;

    TableSchema* schema_ = nullptr; ///< where it describes
    const toml::table& table_;
    std::string file_;
    std::string where_;
    std::vector<std::string> known_;
};

/// The word of `words` that is nearest to `word` by edit distance; empty when none is near.
std::string nearest_word(std::string_view word, const std::vector<std::string>& words);

} // namespace isochron::app
