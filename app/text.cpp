// Formats numbers and text for people.
#include "app/text.h"

#include "index/lower_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>
#include <utility>

namespace isochron::app {

std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t substitute = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1, substitute});
        }
    }
    return row.back();
}

std::string grid_words(const index::SeriesInfo& info) {
    const auto& vertices = info.grid.vertices;
    return fmt::format("{} x {} x {}, {} step{}", vertices[0], vertices[1], vertices[2],
                       info.steps(), info.steps() == 1 ? "" : "s");
}

std::string human_bytes(double bytes) {
    constexpr std::array kUnits{"B", "KiB", "MiB", "GiB", "TiB", "PiB"};
    std::size_t unit = 0;
    for (; bytes >= 999.5 && unit + 1 < kUnits.size(); ++unit)
        bytes /= 1024;
    const int decimals = unit == 0 || bytes >= 99.95 ? 0 : bytes >= 9.995 ? 1 : 2;
    return fmt::format("{:.{}f} {}", bytes, decimals, kUnits[unit]);
}

std::string human_time(std::chrono::duration<double> time) {
    const auto seconds = std::llround(time.count());
    if (seconds >= 3600)
        return fmt::format("{}:{:02}:{:02}", seconds / 3600, seconds / 60 % 60, seconds % 60);
    return fmt::format("{}:{:02}", seconds / 60, seconds % 60);
}

std::string grouped(std::uint64_t number) {
    const std::string digits = std::to_string(number);
    std::string text;
    for (std::size_t i = 0; i < digits.size(); ++i) {
        if (i > 0 && (digits.size() - i) % 3 == 0)
            text += ',';
        text += digits[i];
    }
    return text;
}

std::string human_number(double number) {
    return fmt::format("{:.10g}", number);
}

std::string whole_path(const std::filesystem::path& path) {
    std::error_code error; // a working folder that is gone
    const std::filesystem::path whole = std::filesystem::absolute(path, error);
    return (error ? path : whole).lexically_normal().string();
}

std::string with_space(const std::string& unit) {
    return unit.empty() ? unit : " " + unit;
}

std::string with_unit(double value, const std::string& unit, int digits) {
    return fmt::format("{:.{}g}{}", value, digits, with_space(unit));
}

std::string range_text(double low, double high, const std::string& unit) {
    const int digits = index::telling_digits(low, high);
    return fmt::format("{:.{}g} to {:.{}g}{}", low, digits, high, digits, with_space(unit));
}

std::string exact_range_text(double low, double high, const index::SeriesInfo& info) {
    const std::string unit = with_space(info.value_unit);
    return info.type == index::ValueType::f32 && info.scaling == index::Scaling{}
               ? fmt::format("{} to {}{}", static_cast<float>(low), static_cast<float>(high), unit)
               : fmt::format("{} to {}{}", low, high, unit);
}

std::string lengths_text(const std::array<double, 3>& lengths, const std::string& unit) {
    const auto [least, most] = std::ranges::minmax(lengths);
    const auto exponent = [](double length) {
        return length > 0 ? static_cast<int>(std::floor(std::log10(length))) : 0;
    };
    constexpr int kMostDecimals = 5, kMostDigits = 6; // else powers of ten
    const int high = exponent(most), low = exponent(least);
    int decimals = std::max({0, 2 - high, least > 0 ? 1 - low : 0});
    if (decimals > kMostDecimals || high >= kMostDigits)
        return fmt::format("{:.3g}{}", fmt::join(lengths, " x "), with_space(unit));
    const auto whole = [&](double length) { // in the decimals but the last
        const double step = std::pow(10, 1 - decimals);
        return std::abs(std::round(length / step) * step - length) < 0.05 * step;
    };
    while (decimals > 0 && std::ranges::all_of(lengths, whole))
        --decimals;
    return fmt::format("{:.{}f} x {:.{}f} x {:.{}f}{}", lengths[0], decimals, lengths[1], decimals,
                       lengths[2], decimals, with_space(unit));
}

std::string missing_text(std::uint64_t missing, const index::SeriesInfo& info) {
    if (missing == 0)
        return "";
    const std::uint64_t all = info.grid.vertex_count() * info.steps();
    const double percent = 100.0 * static_cast<double>(missing) / static_cast<double>(all);
    return percent < 0.1   ? "< 0.1 %"
           : missing < all ? fmt::format("{:.1f} %", std::min(percent, 99.9))
                           : "100 %";
}

std::string upper_text(double bound, const std::string& unit) {
    if (!(bound > 0))
        return with_unit(bound, unit);
    const double step = std::pow(10, std::floor(std::log10(bound)) - 3);
    return fmt::format("{:.4g}{}", std::ceil(bound / step) * step, with_space(unit));
}

std::string nearest_word(std::string_view word, const std::vector<std::string>& words) {
    std::string nearest;
    std::size_t best = std::numeric_limits<std::size_t>::max();
    for (const std::string& candidate : words) {
        const std::size_t distance = edit_distance(word, candidate);
        if (distance < best) {
            best = distance;
            nearest = candidate;
        }
    }
    // A distance above half of the word's length means a different word, not a typing error.
    return best <= std::max<std::size_t>(2, word.size() / 2) ? nearest : std::string();
}

namespace {

bool goes_on_character(char byte) {
    return (static_cast<unsigned char>(byte) & 0xc0) == 0x80;
}

/// Without its last character.
std::string shortened(std::string text) {
    while (!text.empty() && goes_on_character(text.back()))
        text.pop_back();
    if (!text.empty())
        text.pop_back();
    return text;
}

} // namespace

std::size_t characters_of(std::string_view text) {
    return text.size() - static_cast<std::size_t>(std::ranges::count_if(text, goes_on_character));
}

std::vector<std::string> wrapped(std::string_view text,
                                 const std::function<bool(const std::string&)>& fits,
                                 std::size_t most) {
    std::vector<std::string> lines;
    std::istringstream paragraphs{std::string(text)};
    for (std::string paragraph; lines.size() <= most && std::getline(paragraphs, paragraph);) {
        std::string line, word;
        std::istringstream words(paragraph);
        while (lines.size() <= most && words >> word) {
            if (const std::string longer = line.empty() ? word : line + ' ' + word; fits(longer)) {
                line = longer;
                continue;
            }
            if (!line.empty())
                lines.push_back(std::exchange(line, {}));
            for (; lines.size() <= most && !fits(word); word.erase(0, lines.back().size())) {
                std::string part;
                for (std::size_t end = 0; end < word.size() && (part.empty() || fits(part));) {
                    do
                        ++end;
                    while (end < word.size() && goes_on_character(word[end]));
                    part = word.substr(0, end);
                }
                if (characters_of(part) > 1)
                    part = shortened(part);
                lines.push_back(part);
            }
            line = word;
        }
        lines.push_back(line);
    }
    while (!lines.empty() && lines.back().empty())
        lines.pop_back();
    if (lines.size() <= most)
        return lines;
    constexpr const char* kDots = "\u2026";
    lines.resize(most);
    while (!lines.back().empty() && !fits(lines.back() + kDots))
        lines.back() = shortened(lines.back());
    lines.back() += kDots;
    return lines;
}

bool has_words(const std::string& name, std::string_view words) {
    const std::string in = index::lower_case(name);
    std::istringstream each(index::lower_case(std::string(words)));
    std::string word;
    while (each >> word)
        if (in.find(word) == std::string::npos)
            return false;
    return true;
}

} // namespace isochron::app
