// Ranks the lines of the search.
#include "app/panel/search_rank.h"

#include "app/text.h"
#include "index/lower_case.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

namespace isochron::app {
namespace {

constexpr double kStartOfWord = 0.85, kLongerWord = 0.75, kTypo = 0.75, kSameMeaning = 0.8;

/// Words that tell little: they find no line alone. The last ones are of controls themselves, such as
/// other programs have them, and of what is done with any of them.
constexpr std::array<std::string_view, 58> kLittle{
    "the",  "a",      "an",     "of",      "to",    "in",     "on",        "at",       "by",
    "for",  "and",    "or",     "with",    "as",    "is",     "it",        "its",      "my",
    "me",   "i",      "how",    "do",      "can",   "want",   "set",       "change",   "choose",
    "make", "get",    "use",    "see",     "show",  "all",    "this",      "that",     "over",
    "into", "from",   "be",     "off",     "go",    "goto",   "jump",      "apply",    "enable",
    "edit", "switch", "toggle", "disable", "place", "slider", "attribute", "property", "filter",
    "mode", "widget", "effect", "operator"};
bool tells_little(std::string_view word) {
    return std::ranges::find(kLittle, word) != kLittle.end();
}

/// Words that mean one thing in some program or other, in the form that `plain` gives them: whoever
/// types one of them finds lines that have another.
constexpr std::array<std::string_view, 16> kMeanings{
    "mark marker fiducial landmark markup pin",
    "remove delete erase clear discard unload",
    "picture image screenshot snapshot photo capture",
    "movie video animation film",
    "viewpoint view camera",
    "last end endpoint final",
    "first start begin beginning",
    "piece island component segment blob region",
    "annotation overlay gizmo",
    "slice plane section",
    "turn rotate spin orbit",
    "opacity alpha transparency transparent translucent",
    "array variable field channel scalar quantity",
    "surface isosurface contour layer",
    "key keyframe keying",
    "save export write"};
/// The words of the meanings that a word has, itself included; empty: it has none.
std::vector<std::string_view> same_meaning(std::string_view word) {
    std::vector<std::string_view> same;
    for (std::string_view rest : kMeanings) {
        std::vector<std::string_view> group;
        while (!rest.empty()) {
            const std::size_t end = std::min(rest.find(' '), rest.size());
            group.push_back(rest.substr(0, end));
            rest.remove_prefix(std::min(end + 1, rest.size()));
        }
        if (std::ranges::find(group, word) != group.end())
            same.insert(same.end(), group.begin(), group.end());
    }
    return same;
}

/// American spelling, singular.
std::string plain(std::string word) {
    static const std::array<std::pair<std::string_view, std::string_view>, 6> kSpellings{
        {{"colour", "color"},
         {"grey", "gray"},
         {"centre", "center"},
         {"metre", "meter"},
         {"labell", "label"},
         {"neighbour", "neighbor"}}};
    for (const auto& [british, american] : kSpellings)
        if (const std::size_t at = word.find(british); at != std::string::npos)
            word.replace(at, british.size(), american);
    const auto end = [&](std::string_view letters) { return word.ends_with(letters); };
    if (word.size() > 4 && (end("ise") || end("yse")))
        word[word.size() - 2] = 'z';
    if (word.size() > 6 && end("ies")) // `properties`, but `series` and `movies`
        return word.substr(0, word.size() - 3) + "y";
    if (word.size() > 3 && end("s") && !end("ss") && !end("us") && !end("is"))
        word.pop_back();
    return word;
}

/// The words of a text. A sign before a letter belongs to it (`+x`), other signs separate words.
std::vector<std::string> words_of(std::string_view text) {
    std::vector<std::string> words;
    std::string word;
    const auto take = [&] {
        if (!word.empty())
            words.push_back(plain(std::move(word)));
        word.clear();
    };
    const std::string lower = index::lower_case(text);
    for (std::size_t i = 0; i < lower.size(); ++i) {
        const auto letter = static_cast<unsigned char>(lower[i]);
        const bool sign = (letter == '+' || letter == '-') && word.empty() &&
                          i + 1 < lower.size() &&
                          std::isalnum(static_cast<unsigned char>(lower[i + 1]));
        const bool point = letter == '.' && i + 1 < lower.size() &&
                           std::isdigit(static_cast<unsigned char>(lower[i + 1]));
        if (std::isalnum(letter) || letter >= 0x80 || sign || point)
            word += lower[i];
        else
            take();
    }
    take();
    return words;
}

/// A whole word that is a number.
std::optional<double> number_of(const std::string& word) {
    char* end = nullptr;
    const double number = std::strtod(word.c_str(), &end);
    const bool digits = std::ranges::any_of(word, [](unsigned char c) { return std::isdigit(c); });
    const bool whole = end == word.c_str() + word.size();
    return digits && whole && std::isfinite(number) ? std::optional(number) : std::nullopt;
}

/// Whether one letter is wrong, missing, added, or exchanged with its neighbor.
bool one_apart(std::string_view a, std::string_view b) {
    if (a.size() > b.size())
        std::swap(a, b);
    if (b.size() - a.size() > 1)
        return false;
    const auto at = static_cast<std::size_t>(std::ranges::mismatch(a, b).in1 - a.begin());
    if (a.size() < b.size())
        return a.substr(at) == b.substr(at + 1);
    if (at == a.size() || a.substr(at + 1) == b.substr(at + 1))
        return true;
    return at + 1 < a.size() && a[at] == b[at + 1] && a[at + 1] == b[at] &&
           a.substr(at + 2) == b.substr(at + 2);
}

/// How well a typed word stands for a line's word, 0 to 1.
double match(std::string_view typed, std::string_view word) {
    constexpr std::size_t kLongTyped = 4;
    if (typed == word)
        return 1.0;
    if (typed.size() >= 2 && word.starts_with(typed))
        return kStartOfWord;
    if (word.size() >= kLongTyped && typed.starts_with(word))
        return kLongerWord;
    if (typed.size() > kLongTyped && one_apart(typed, word))
        return kTypo;
    // A beginning with one fault, and endings: `clipping`, `clipped`.
    const auto same =
        static_cast<std::size_t>(std::ranges::mismatch(typed, word).in1 - typed.begin());
    const std::size_t shorter = std::min(typed.size(), word.size());
    if (same >= 5 && shorter - same <= 3)
        return 0.6;
    return 0.0;
}

/// The words of a line: its phrases are its words, its key, its name, and each of its other names.
struct LineWords {
    std::vector<std::vector<std::string>> phrases;
    std::size_t own = 0; ///< the first ones, which are not its other names
};
LineWords words_of(const SearchLine& line) {
    LineWords all;
    const auto add = [&](std::string_view phrase) {
        if (auto words = words_of(phrase); !words.empty())
            all.phrases.push_back(std::move(words));
    };
    add(line.words);
    add(line.key);
    add(line.name);
    all.own = all.phrases.size();
    std::string_view rest = line.others;
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find(','), rest.size());
        add(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return all;
}

/// A word that was typed, and those that mean the same.
struct TypedWord {
    std::string text;
    std::vector<std::string_view> same = same_meaning(text);
};

double best_of(const TypedWord& typed, const std::vector<std::string>& phrase) {
    double best = 0;
    for (const std::string& word : phrase) {
        best = std::max(best, match(typed.text, word));
        if (best < kSameMeaning && std::ranges::find(typed.same, word) != typed.same.end())
            best = kSameMeaning;
    }
    return best;
}

/// Typed words and what each of them weighs.
struct Typed {
    std::vector<TypedWord> words;
    std::vector<double> weights;
    double whole = 0; ///< sum of the weights
    bool number = false;
};

/// How well a line answers.
struct Score {
    double found = 0; ///< share of what was typed, 0 to 1
    double total = 0; ///< orders the lines
};
Score score_of(const Typed& typed, const SearchLine& line, const LineWords& words) {
    constexpr double kPhrase = 0.7, kNumber = 0.25, kOtherName = 0.9;
    std::vector<double> anywhere(typed.words.size());
    double best_phrase = 0;
    for (std::size_t n = 0; n < words.phrases.size(); ++n) {
        const std::vector<std::string>& phrase = words.phrases[n];
        double here = 0;
        for (std::size_t i = 0; i < typed.words.size(); ++i) {
            const double fits = best_of(typed.words[i], phrase);
            anywhere[i] = std::max(anywhere[i], fits);
            here += fits * typed.weights[i];
        }
        // A phrase with nothing else in it is nearer than one with more words.
        const auto telling = static_cast<double>(
            std::ranges::count_if(phrase, [](const auto& word) { return !tells_little(word); }));
        const double mean = typed.whole / static_cast<double>(typed.words.size());
        const double share = 2 * here / (typed.whole + mean * std::max(1.0, telling));
        best_phrase = std::max(best_phrase, n < words.own ? share : kOtherName * share);
    }
    Score score;
    for (std::size_t i = 0; i < typed.words.size(); ++i)
        score.found += anywhere[i] * typed.weights[i] / typed.whole;
    score.total = score.found + kPhrase * std::min(1.0, best_phrase);
    if (typed.number && line.with_number && score.found > 0)
        score.total += kNumber;
    return score;
}

/// How alike two words are by their letters, 0 to 1: a common beginning counts as much as few
/// changes.
double likeness(std::string_view typed, std::string_view word) {
    const auto longer = static_cast<double>(std::max(typed.size(), word.size()));
    const auto same = static_cast<double>(std::ranges::mismatch(typed, word).in1 - typed.begin());
    const double changed = static_cast<double>(edit_distance(typed, word));
    return std::max(same, longer - changed) / longer;
}

/// How alike the typed words and those of a line are, 0 to 1.
double likeness(const Typed& typed, const LineWords& line) {
    double all = 0;
    for (std::size_t i = 0; i < typed.words.size(); ++i) {
        double best = 0;
        for (const auto& phrase : line.phrases)
            for (const std::string& word : phrase)
                best = std::max(best, likeness(typed.words[i].text, word));
        all += best * typed.weights[i] / typed.whole;
    }
    return all;
}

} // namespace

Ranking ranked(std::span<const SearchLine> lines, std::string_view text) {
    constexpr double kFound = 0.7; // with one small fault in one word
    constexpr double kMuchWorse = 0.6;
    constexpr std::size_t kNearest = 3;
    Ranking ranking;
    Typed typed;
    for (std::string& word : words_of(text)) {
        if (const auto number = number_of(word))
            ranking.number = number;
        else
            typed.words.push_back({std::move(word)});
    }
    typed.number = ranking.number.has_value();
    if (typed.words.empty()) {
        for (const SearchLine& line : lines)
            if (!typed.number || line.with_number)
                ranking.lines.push_back(&line);
        return ranking;
    }
    std::vector<LineWords> words;
    for (const SearchLine& line : lines)
        words.push_back(words_of(line));
    std::vector<bool> known;
    for (const TypedWord& word : typed.words) {
        double best = 0;
        const auto with = std::ranges::count_if(words, [&](const LineWords& line) {
            return std::ranges::any_of(line.phrases, [&](const auto& phrase) {
                const double fits = best_of(word, phrase);
                best = std::max(best, fits);
                return fits >= kTypo;
            });
        });
        known.push_back(with > 0);
        constexpr double kLittleWeight = 0.15, kOnlyTypo = 0.6;
        const double rare = std::log(1.0 + static_cast<double>(lines.size()) /
                                               static_cast<double>(std::max<long>(with, 1)));
        typed.weights.push_back(rare * (tells_little(word.text) ? kLittleWeight : 1) *
                                (best <= kTypo ? kOnlyTypo : 1));
    }
    // A word that no line has, such as a command of another program, decides less than those that some
    // have.
    double lightest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < known.size(); ++i)
        if (known[i])
            lightest = std::min(lightest, typed.weights[i]);
    for (std::size_t i = 0; i < known.size(); ++i)
        if (!known[i])
            typed.weights[i] = std::min(typed.weights[i], lightest);
    typed.whole = std::accumulate(typed.weights.begin(), typed.weights.end(), 0.0);
    std::vector<std::pair<Score, const SearchLine*>> scored;
    for (std::size_t i = 0; i < lines.size(); ++i)
        scored.emplace_back(score_of(typed, lines[i], words[i]), &lines[i]);
    const auto sort = [&] {
        std::ranges::stable_sort(
            scored, [](const auto& a, const auto& b) { return a.first.total > b.first.total; });
    };
    sort();
    if (scored.empty())
        return ranking;
    const double best = scored.front().first.total;
    ranking.only_near = scored.front().first.found < kFound;
    if (ranking.only_near) { // letters tell what words do not
        for (auto& [score, line] : scored)
            score.total += likeness(typed, words[static_cast<std::size_t>(line - lines.data())]);
        sort();
    }
    for (const auto& [score, line] : scored) {
        const bool near = ranking.lines.size() < kNearest;
        if (ranking.only_near ? near : score.found > 0 && score.total >= kMuchWorse * best)
            ranking.lines.push_back(line);
    }
    if (ranking.only_near) {
        const auto help = std::ranges::find(lines, "help", &SearchLine::name);
        if (help != lines.end() && std::ranges::find(ranking.lines, &*help) == ranking.lines.end())
            ranking.lines.push_back(&*help);
    }
    return ranking;
}

} // namespace isochron::app
