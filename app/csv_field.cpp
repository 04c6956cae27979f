// Guards and quotes fields of CSV.
#include "app/csv_field.h"

#include "app/safe_text.h"

namespace isochron::app {

std::string csv_field(std::string_view text, bool keep_formulas) {
    std::string field = one_line(text);
    const bool is_formula =
        !field.empty() && std::string_view("=+-@").find(field[0]) != std::string_view::npos;
    if (is_formula && !keep_formulas)
        field.insert(0, 1, '\'');
    if (field.find_first_of(",;\"") ==
        std::string::npos) // spreadsheets of some languages part at `;`
        return field;
    std::string quoted = "\"";
    for (const char c : field)
        quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + '"';
}

} // namespace isochron::app
