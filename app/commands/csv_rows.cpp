// Writes fields and rows of CSV.
#include "app/commands/csv_rows.h"

#include "app/safe_text.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace isochron::app {
namespace {

using Json = nlohmann::ordered_json;

/// A field; of a text one line, that spreadsheets of no language part.
std::string field_of(const Json& value, bool keep_formulas) {
    if (value.is_null())
        return "";
    if (!value.is_string())
        return value.dump();
    std::string text = one_line(value.get<std::string>());
    const bool is_formula =
        !text.empty() && std::string_view("=+-@").find(text[0]) != std::string_view::npos;
    if (is_formula && !keep_formulas)
        text.insert(0, 1, '\'');
    if (text.find_first_of(",;\"") == std::string::npos)
        return text;
    std::string quoted = "\"";
    for (const char c : text)
        quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + '"';
}

} // namespace

std::string csv_of(const Json& rows, std::vector<std::string> columns, bool keep_formulas) {
    // The others come in the order in which rows have them first.
    for (const Json& row : rows)
        for (const auto& [key, value] : row.items())
            if (std::ranges::find(columns, key) == columns.end())
                columns.push_back(key);
    std::string text;
    const auto add = [&](const Json& field) { text += field_of(field, keep_formulas) + ","; };
    const auto end_line = [&] { text.back() = '\n'; };
    for (const std::string& each : columns)
        add(each);
    if (!columns.empty())
        end_line();
    for (const Json& row : rows) {
        for (const std::string& each : columns)
            add(row.value(each, Json()));
        end_line();
    }
    return text;
}

} // namespace isochron::app
