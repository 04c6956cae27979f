// Writes fields and rows of CSV.
#include "app/commands/csv_rows.h"

#include "app/csv_field.h"

#include <algorithm>

namespace isochron::app {
namespace {

using Json = nlohmann::ordered_json;

std::string field_of(const Json& value, bool keep_formulas) {
    if (value.is_null())
        return "";
    return value.is_string() ? csv_field(value.get<std::string>(), keep_formulas) : value.dump();
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
