// Natural order of names.
#include "index/formats/series/natural_order.h"

#include <algorithm>
#include <charconv>
#include <utility>

namespace isochron::index {
namespace {

bool digit(char c) {
    return c >= '0' && c <= '9';
}

// Splits off the number at the front, without its leading zeros.
std::string_view take_number(std::string_view& text) {
    const auto end = std::find_if_not(text.begin(), text.end(), digit);
    std::string_view number = text.substr(0, static_cast<std::size_t>(end - text.begin()));
    text.remove_prefix(number.size());
    number.remove_prefix(std::min(number.find_first_not_of('0'), number.size()));
    return number;
}

} // namespace

bool natural_less(std::string_view a, std::string_view b) {
    const std::string_view whole_a = a, whole_b = b;
    while (!a.empty() && !b.empty()) {
        if (digit(a.front()) && digit(b.front())) {
            const std::string_view x = take_number(a), y = take_number(b);
            if (x.size() != y.size())
                return x.size() < y.size();
            if (x != y)
                return x < y;
        } else {
            if (a.front() != b.front())
                return static_cast<unsigned char>(a.front()) <
                       static_cast<unsigned char>(b.front());
            a.remove_prefix(1);
            b.remove_prefix(1);
        }
    }
    if (a.empty() != b.empty())
        return a.empty();
    return whole_a < whole_b; // equal, or different in leading zeros only
}

std::optional<double> last_number_in(std::string_view text) {
    const std::size_t last = text.find_last_of("0123456789");
    if (last == text.npos)
        return std::nullopt;
    std::size_t first = last;
    bool point = false;
    while (first > 0 &&
           (digit(text[first - 1]) || (text[first - 1] == '.' && first > 1 &&
                                       digit(text[first - 2]) && !std::exchange(point, true))))
        --first;
    double number = 0;
    std::from_chars(text.data() + first, text.data() + last + 1, number);
    return number;
}

} // namespace isochron::index
