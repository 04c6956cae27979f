// Checked reading of a TOML table: every key is known, typed and in range, else an error says
// where.
#pragma once

#include "app/config/table_schema.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

// The parser asserts that a key begins with a valid character, right before it reports an error for
// keys that do not. Without its assertion, damaged files give that error in every build.
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

/// Reads one table. Each call names a key; if the key is absent, its target stays as it is.
/// `finish` then refuses every key that no call named.
///
/// A reader can also describe a table instead of reading one: then no key is present, nothing
/// fails, the reader of every inner table runs once, and the schema notes all keys.
class TomlReader {
  public:
    /// Reads `table`. @param where the table's name for messages: `windows.viewports`
    TomlReader(const toml::table& table, std::string file, std::string where);
    /// Describes a table. @param schema outlives this
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

    /// One of `words`; `take` gets it. Any other word is refused.
    void word(std::string_view key, const std::vector<std::string>& words,
              const std::function<void(const std::string&)>& take);

    /// One of the words that the file itself defines, such as the names of its viewers.
    void given_word(std::string_view key, const std::vector<std::string>& words,
                    const std::function<void(const std::string&)>& take);

    int line() const { return static_cast<int>(table_.source().begin.line); } ///< line of the table
    bool has(std::string_view key) const { return find(key) != nullptr; }

    /// A sub-table, or an array of tables. `read` reads each of them; `finish` follows.
    /// @return false when absent
    bool table(std::string_view key, const std::function<void(TomlReader&)>& read);
    bool tables(std::string_view key, const std::function<void(TomlReader&)>& read);
    /// Reads a sub-table, or each table of an array.
    bool table_or_tables(std::string_view key, const std::function<void(TomlReader&)>& read);

    void finish() const;

    /// Throws ConfigError with the place of `key`, or of the table if the key is absent. Returns
    /// only while describing a table.
    void fail(std::string_view key, const std::string& message) const;

  private:
    [[noreturn]] void refuse(std::string_view key, const std::string& message) const;
    void describe(std::string_view key, const std::function<void(TomlReader&)>& read,
                  TableSchema::Times times);
    /// The value of a key under its name, or under its spelling in older files.
    const toml::node* find(std::string_view key) const;
    const toml::node* get(std::string_view key);
    double finite_number(std::string_view key, const toml::node& node, double low,
                         double high) const;
    std::vector<double> numbers(std::string_view key, const toml::node& node,
                                std::size_t count) const;

    TableSchema* schema_ = nullptr; ///< where the keys are noted; null: reads
    const toml::table& table_;
    std::string file_;
    std::string where_;
    std::vector<std::string> known_;
};

} // namespace isochron::app
