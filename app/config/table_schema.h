// The JSON schema of a configuration, made while the readers of its tables run.
//
//     TableSchema schema;
//     TomlReader reader(schema);
//     read_placement(reader, placement);      // notes keys, kinds and ranges, reads nothing
//     write(schema.text());
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::app {

/// One table: its keys, and the type and range of each. Checks that involve several keys, such as
/// two keys that exclude each other, are not part of it.
class TableSchema {
  public:
    TableSchema();
    ~TableSchema();
    TableSchema(TableSchema&&) noexcept;
    TableSchema& operator=(TableSchema&&) noexcept;

    /// Each adds a key. A key that is added again keeps its place and takes the new meaning.
    /// Limits that no double reaches are left out.
    void number(std::string_view key, double low, double high);
    void integer(std::string_view key, int low, int high);
    void flag(std::string_view key);
    void text(std::string_view key);
    void word(std::string_view key, const std::vector<std::string>& words);
    /// An array of `least` to `most` numbers.
    void numbers(std::string_view key, std::size_t least, std::size_t most, double low,
                 double high);
    void integers(std::string_view key, std::size_t count, int low, int high);

    enum class Times { once, array, either };
    void table(std::string_view key, const TableSchema& inner, Times times);

    /// The whole schema (JSON Schema, draft 7) of a file with this table as its top level; ends in
    /// a new line.
    std::string text() const;

  private:
    struct Properties;
    std::unique_ptr<Properties> properties_;
};

} // namespace isochron::app
