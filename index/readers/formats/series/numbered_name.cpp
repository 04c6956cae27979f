// Takes names with numbers apart.
#include "index/readers/formats/series/numbered_name.h"

#include "index/readers/formats/series/dated_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace isochron::index {
namespace {

bool is_numeral(char c) {
    return c >= '0' && c <= '9';
}

bool is_letter_of_name(char c) {
    return (c | 32) >= 'a' && (c | 32) <= 'z';
}

/// Finds the numbers of a name, from its front.
class NumberScan {
  public:
    NumberScan(std::string_view name, NameStyle style) : name_(name), style_(style) {}

    /// The number whose first digit is at `at`.
    NameNumber number_at(std::size_t at) const {
        const std::size_t digits_end = end_of_digits(at);
        std::size_t end = digits_end, fraction = 0;
        if (style_.decimals && has_fraction(at, digits_end)) {
            end = end_of_digits(digits_end + 1);
            fraction = end - digits_end - 1;
        }
        // Behind a version or a part number nothing is an exponent.
        if (style_.decimals && !in_row(at, digits_end, fraction))
            end = end_of_exponent(at, end, fraction > 0);
        const std::size_t begin = has_sign(at) ? at - 1 : at;
        NameNumber number{.text = std::string(name_.substr(begin, end - begin)),
                          .value = 0,
                          .whole = {},
                          .begin = begin,
                          .fraction = fraction};
        number.value = value_of(number.text);
        if (begin == at && end == digits_end) {
            number.whole = name_.substr(at, end - at);
            number.whole.erase(0,
                               std::min(number.whole.find_first_not_of('0'), number.whole.size()));
        }
        return number;
    }

  private:
    char at(std::size_t i) const { return i < name_.size() ? name_[i] : '\0'; }
    bool numeral(std::size_t i) const { return is_numeral(at(i)); }
    bool point(std::size_t i) const { return at(i) == '.' || at(i) == ','; }

    std::size_t end_of_digits(std::size_t i) const {
        while (numeral(i))
            ++i;
        return i;
    }

    /// Whether digits are behind or before a point and further digits beside those of the number.
    bool in_row(std::size_t begin, std::size_t end, std::size_t fraction) const {
        const std::size_t behind = fraction > 0 ? end + 1 + fraction : end;
        return (begin > 1 && point(begin - 1) && numeral(begin - 2)) ||
               (point(behind) && numeral(behind + 1));
    }

    bool has_fraction(std::size_t begin, std::size_t end) const {
        return point(end) && numeral(end + 1) &&
               !in_row(begin, end, end_of_digits(end + 1) - end - 1);
    }

    /// `1e-05`, `2.5E+3`, Fortran's `1.0D-02`; `1e3` only where it is not part of a word.
    std::size_t end_of_exponent(std::size_t begin, std::size_t end, bool fraction) const {
        const char letter = static_cast<char>(at(end) | 32);
        const bool sign = at(end + 1) == '-' || at(end + 1) == '+';
        if (letter != 'e' && !(letter == 'd' && sign && fraction))
            return end;
        const std::size_t digits = end + (sign ? 2 : 1), behind = end_of_digits(digits);
        const bool apart = begin == 0 || !is_letter_of_name(name_[begin - 1]);
        const bool unit = sign && fraction; // `1.5e-3s`
        if (behind == digits || behind - digits > 3 || (is_letter_of_name(at(behind)) && !unit) ||
            !(sign || fraction || apart))
            return end;
        return behind;
    }

    /// A minus between words or numbers joins them.
    bool has_sign(std::size_t digits) const {
        if (digits == 0 || (name_[digits - 1] != '-' && name_[digits - 1] != '+'))
            return false;
        if (digits == 1)
            return true;
        const char before = name_[digits - 2];
        constexpr std::string_view kApart = "/_= ([{-+,;:";
        return kApart.find(before) != kApart.npos ||
               (style_.signs_behind_letters && is_letter_of_name(before));
    }

    static double value_of(std::string text) {
        std::ranges::replace(text, ',', '.');
        std::ranges::replace_if(
            text, [](char c) { return c == 'd' || c == 'D'; }, 'e');
        if (text.front() == '+')
            text.erase(0, 1);
        double value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool tiny = text.find("e-") != text.npos || text.find("E-") != text.npos;
        if (error == std::errc::result_out_of_range && !tiny)
            return text.front() == '-' ? -std::numeric_limits<double>::infinity()
                                       : std::numeric_limits<double>::infinity();
        return value;
    }

    std::string_view name_;
    NameStyle style_;
};

/// Whether decimals cannot be meant: `1.9` beside `1.10`. Programs write the last zeros of all
/// decimals or of none, but for `1.0`.
bool fractions_count(const std::set<std::string>& fractions) {
    const auto alike = [&](const std::string& each) {
        return each.size() == fractions.begin()->size();
    };
    const auto zeros = [](const std::string& each) {
        return each.find_first_not_of('0') == each.npos;
    };
    if (fractions.empty() || std::ranges::all_of(fractions, alike))
        return false;
    const auto leading = [&](const std::string& each) {
        return each.size() > 1 && each.front() == '0' && !zeros(each);
    };
    const auto trailing = [&](const std::string& each) {
        return each.size() > 1 && each.back() == '0' && !zeros(each);
    };
    return std::ranges::none_of(fractions, leading) && std::ranges::any_of(fractions, trailing);
}

std::vector<NumberedName> all_apart(const std::vector<std::string>& names, NameStyle style) {
    std::vector<NumberedName> apart;
    apart.reserve(names.size());
    for (const std::string& name : names)
        apart.push_back(taken_apart(name, style));
    return apart;
}

std::size_t patterns_among(std::span<const NumberedName> names) {
    std::set<std::string> patterns;
    for (const NumberedName& name : names)
        patterns.insert(name.pattern());
    return patterns.size();
}

bool any_fraction_counts(std::span<const NumberedName> names) {
    std::map<std::pair<std::string, std::size_t>, std::set<std::string>> fractions;
    for (const NumberedName& name : names)
        for (std::size_t i = 0; i < name.numbers.size(); ++i)
            if (const NameNumber& number = name.numbers[i]; number.fraction > 0) {
                const std::size_t point = number.text.find_first_of(".,");
                fractions[{name.pattern(), i}].insert(
                    number.text.substr(point + 1, number.fraction));
            }
    return std::ranges::any_of(fractions,
                               [](const auto& each) { return fractions_count(each.second); });
}

std::vector<std::size_t> order_of(std::span<const NumberedName> names) {
    std::vector<std::size_t> order(names.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(
        order, [&](std::size_t a, std::size_t b) { return natural_less(names[a], names[b]); });
    return order;
}

std::string last_part(const std::string& path) {
    const std::size_t slash = path.rfind('/');
    return slash == path.npos ? path : path.substr(slash + 1);
}

/// What a user sees of two names: the file's, or the folder's where that differs.
std::pair<std::string, std::string> shown(const std::string& a, const std::string& b) {
    std::size_t same = 0;
    while (same < std::min(a.size(), b.size()) && a[same] == b[same])
        ++same;
    const std::size_t slash = a.rfind('/', same);
    const std::size_t begin = same == 0 || slash == a.npos ? 0 : slash + 1;
    return {a.substr(begin), b.substr(begin)};
}

} // namespace

double NameNumber::rounding() const {
    if (fraction == 0)
        return 0;
    const std::size_t exponent = text.find_first_of("eEdD");
    double power = -static_cast<double>(fraction);
    if (exponent != text.npos) {
        int more = 0;
        const std::size_t sign = text[exponent + 1] == '+' ? 2 : 1;
        std::from_chars(text.data() + exponent + sign, text.data() + text.size(), more);
        power += more;
    }
    return std::pow(10.0, power);
}

bool NameNumber::operator==(const NameNumber& other) const {
    const bool exact = text.find_first_not_of("0123456789") == text.npos &&
                       other.text.find_first_not_of("0123456789") == text.npos;
    return exact ? whole == other.whole : value == other.value;
}

bool NameNumber::operator<(const NameNumber& other) const {
    const bool exact = text.find_first_not_of("0123456789") == text.npos &&
                       other.text.find_first_not_of("0123456789") == text.npos;
    if (!exact)
        return value < other.value;
    return std::pair(whole.size(), whole) < std::pair(other.whole.size(), other.whole);
}

std::string NumberedName::pattern() const {
    std::string pattern = texts.front();
    for (std::size_t i = 1; i < texts.size(); ++i)
        pattern += "*" + texts[i];
    return pattern;
}

NumberedName taken_apart(const std::string& name, NameStyle style) {
    NumberedName parts{.name = name, .texts = {}, .numbers = {}};
    const NumberScan scan(name, style);
    std::string text;
    for (std::size_t i = 0; i < name.size();) {
        const auto month = style.months ? month_word_at(name, i) : std::nullopt;
        if (!is_numeral(name[i]) && !month) {
            text += name[i++];
            continue;
        }
        NameNumber number = month ? NameNumber{.text = name.substr(i, month->length),
                                               .value = static_cast<double>(month->month),
                                               .whole = {},
                                               .begin = i}
                                  : scan.number_at(i);
        text.resize(text.size() - (i - number.begin)); // the sign belongs to the number
        i = number.end();
        parts.texts.push_back(std::move(text));
        text.clear();
        parts.numbers.push_back(std::move(number));
    }
    parts.texts.push_back(std::move(text));
    return parts;
}

bool natural_less(const NumberedName& a, const NumberedName& b) {
    std::size_t at_a = 0, at_b = 0, number_a = 0, number_b = 0;
    while (at_a < a.name.size() && at_b < b.name.size()) {
        const NameNumber* x = number_a < a.numbers.size() ? &a.numbers[number_a] : nullptr;
        const NameNumber* y = number_b < b.numbers.size() ? &b.numbers[number_b] : nullptr;
        if (x && y && x->begin == at_a && y->begin == at_b) {
            if (!(*x == *y))
                return *x < *y;
            at_a = x->end();
            at_b = y->end();
            ++number_a;
            ++number_b;
            continue;
        }
        if (a.name[at_a] != b.name[at_b])
            return static_cast<unsigned char>(a.name[at_a]) <
                   static_cast<unsigned char>(b.name[at_b]);
        number_a += x && x->begin == at_a;
        number_b += y && y->begin == at_b;
        ++at_a;
        ++at_b;
    }
    const bool ends_a = at_a == a.name.size(), ends_b = at_b == b.name.size();
    if (ends_a != ends_b)
        return ends_a;
    return a.name < b.name; // equal, or different in the writing of numbers only
}

ReadNames read_names(const std::vector<std::string>& names, std::optional<DayMonth> said) {
    NameStyle style;
    std::vector<NumberedName> apart = all_apart(names, style);
    for (const auto more : {&NameStyle::signs_behind_letters, &NameStyle::months}) {
        NameStyle with_more = style;
        with_more.*more = true;
        std::vector<NumberedName> other = all_apart(names, with_more);
        if (patterns_among(other) >= patterns_among(apart))
            continue;
        style = with_more;
        apart = std::move(other);
    }
    NameStyle other_style = style;
    other_style.decimals = false;
    std::vector<NumberedName> other = all_apart(names, other_style);
    const bool counts = any_fraction_counts(apart);
    if (counts)
        std::swap(apart, other);
    ReadNames read{.names = std::move(apart), .order = {}, .note = {}};
    read.order = order_of(read.names);
    for (std::size_t i = 1; i < read.order.size(); ++i) {
        const std::size_t first = read.order[i - 1], second = read.order[i];
        if (!natural_less(other[second], other[first]))
            continue;
        const auto [a, b] = shown(names[first], names[second]);
        read.note = counts ? fmt::format("the numbers in the names are read as whole numbers with "
                                         "points between them, not as decimals: {} before {}",
                                         a, b)
                           : fmt::format("the numbers in the names are read as decimals: {} before "
                                         "{}",
                                         a, b);
        break;
    }
    if (style.months)
        read.note = fmt::format("words in the names are read as months: {} before {}",
                                last_part(names[read.order[0]]), last_part(names[read.order[1]]));
    if (DateOrder dates = order_of_dates(names, said);
        !dates.order.empty() && dates.order != read.order) {
        read.order = std::move(dates.order);
        read.note = std::move(dates.note);
    } else if (dates.order.empty() && !dates.note.empty()) {
        read.note = std::move(dates.note);
    }
    return read;
}

std::vector<std::size_t> varying_numbers(std::span<const NumberedName> names) {
    std::vector<std::size_t> varying;
    if (std::ranges::any_of(
            names, [&](const NumberedName& name) { return name.texts != names.front().texts; }))
        return varying;
    for (std::size_t i = 0; i < names.front().numbers.size(); ++i)
        if (std::ranges::any_of(names, [&](const NumberedName& name) {
                return !(name.numbers[i] == names.front().numbers[i]);
            }))
            varying.push_back(i);
    return varying;
}

std::optional<std::size_t> number_at_end(std::string_view text) {
    const NumberedName apart = taken_apart(std::string(text));
    if (apart.numbers.empty() || !apart.texts.back().empty())
        return std::nullopt;
    return apart.numbers.back().begin;
}

std::vector<std::optional<double>> times_in_names(std::span<const std::filesystem::path> files) {
    std::vector<std::string> names;
    for (const std::filesystem::path& file : files)
        names.push_back(file.string());
    const ReadNames read = read_names(names);
    const auto varying = varying_numbers(read.names);
    std::vector<std::optional<double>> times;
    for (std::size_t i = 0; i < files.size(); ++i) {
        std::optional<double>& time = times.emplace_back();
        if (!varying.empty()) {
            time = read.names[i].numbers[varying.back()].value;
            continue;
        }
        // An end such as .h5 is no time, but that of t_0.25 is.
        std::string name = last_part(names[i]);
        if (const std::size_t point = name.rfind('.');
            point != name.npos && point + 1 < name.size() && is_letter_of_name(name[point + 1]))
            name.resize(point);
        if (const NumberedName apart = taken_apart(name); !apart.numbers.empty())
            time = apart.numbers.back().value;
    }
    return times;
}

} // namespace isochron::index
