// Finds classes in text: enough of C++ for sources that clang-format has laid out.
#include "tests/house/class_text.h"

#include <algorithm>
#include <cctype>
#include <regex>
#include <string_view>

namespace isochron::house {
namespace {

/// The place after the brace that closes the one at `open`, or the end of the text.
std::size_t after_brace(const std::string& text, std::size_t open) {
    int depth = 0;
    for (std::size_t i = open; i < text.size(); ++i) {
        depth += text[i] == '{' ? 1 : text[i] == '}' ? -1 : 0;
        if (depth == 0)
            return i + 1;
    }
    return text.size();
}

/// Without what stands between angle brackets, where types have commas and parentheses.
std::string without_templates(std::string text) {
    static const std::regex kInnermost("<[^<>]*>");
    for (std::string before; before != text;) {
        before = text;
        text = std::regex_replace(text, kInnermost, "");
    }
    return text;
}

/// Whether a declaration up to its first brace is of a function.
bool names_function(const std::string& head) {
    return without_templates(head.substr(0, head.find(" = "))).find('(') != std::string::npos;
}

/// The declarations of a class body, each with its braces emptied and without its access labels.
std::vector<std::string> declarations_in(const std::string& body) {
    static const std::regex kLabel(R"(\b(public|private|protected)\s*:(?!:))");
    std::vector<std::string> found;
    std::string current;
    const auto end = [&] {
        current = std::regex_replace(current, kLabel, "");
        const auto first = current.find_first_not_of(" \n");
        if (first != std::string::npos)
            found.push_back(current.substr(first));
        current.clear();
    };
    for (std::size_t i = 0; i < body.size();) {
        if (body[i] == '{') {
            // The body of a function ends its declaration; a nested class and an initializer go on
            // to a semicolon.
            const bool function = names_function(current);
            i = after_brace(body, i);
            current += "{}";
            const auto next = body.find_first_not_of(" \n", i);
            if (function && (next == std::string::npos ||
                             (body[next] != ';' && body[next] != ',' && body[next] != '{')))
                end();
        } else if (body[i] == ';') {
            end();
            ++i;
        } else {
            current += body[i++];
        }
    }
    return found;
}

ClassText counted(std::string name, const std::string& body) {
    static const std::regex kNeither(
        R"(^(using|friend|enum|class|struct|union|typedef|template|static_assert|#)\b)");
    static const std::regex kOfNoObject(R"(^(inline\s+)?static\b)");
    ClassText result{.name = std::move(name)};
    for (const std::string& declaration : declarations_in(body)) {
        const std::string head = declaration.substr(0, declaration.find('{'));
        if (std::regex_search(declaration, kNeither)) {
            result.methods += declaration.starts_with("template") && names_function(head);
            continue;
        }
        if (names_function(head)) {
            ++result.methods;
        } else if (!std::regex_search(declaration, kOfNoObject)) {
            static const std::regex kArguments(R"(\([^()]*\))");
            const std::string names =
                std::regex_replace(without_templates(declaration), kArguments, "");
            result.members += 1 + static_cast<int>(std::ranges::count(names, ','));
        }
    }
    return result;
}

} // namespace

std::string without_comments(const std::string& text) {
    std::string result = text;
    const auto blank = [&](std::size_t from, std::size_t to) {
        for (; from < to && from < result.size(); ++from)
            if (result[from] != '\n')
                result[from] = ' ';
    };
    const auto end_of = [&](std::string_view mark, std::size_t from) {
        const auto at = text.find(mark, from);
        return at == std::string::npos ? text.size() : at;
    };
    for (std::size_t i = 0; i < text.size();) {
        std::size_t end = i + 1;
        if (text.compare(i, 2, "//") == 0) {
            end = end_of("\n", i);
            blank(i, end);
        } else if (text.compare(i, 2, "/*") == 0) {
            end = end_of("*/", i) + 2;
            blank(i, end);
        } else if (text.compare(i, 2, "R\"") == 0) {
            const auto open = end_of("(", i);
            const std::string mark = ")" + text.substr(i + 2, open - i - 2) + "\"";
            end = end_of(mark, open) + mark.size();
            blank(i + 2, end - 1);
        } else if (text[i] == '"' ||
                   (text[i] == '\'' && (i == 0 || std::isxdigit(text[i - 1]) == 0))) {
            while (end < text.size() && text[end] != text[i] && text[end] != '\n')
                end += text[end] == '\\' ? 2 : 1;
            blank(i + 1, end);
            ++end;
        }
        i = end;
    }
    return result;
}

std::vector<ClassText> classes_in(const std::string& given) {
    static const std::regex kClass(
        R"((enum\s+)?\b(class|struct)\s+(\w+)(\s+final)?\s*(:[^{};()]*)?\{)");
    const std::string text = without_comments(given);
    std::vector<ClassText> found;
    for (std::sregex_iterator at(text.begin(), text.end(), kClass), end; at != end; ++at) {
        if ((*at)[1].matched)
            continue;
        const auto open = static_cast<std::size_t>(at->position() + at->length()) - 1;
        found.push_back(
            counted((*at)[3].str(), text.substr(open + 1, after_brace(text, open) - open - 2)));
    }
    return found;
}

std::set<std::string> classes_implemented_in(const std::string& given) {
    static const std::regex kFunction(R"((?:^|\n)[A-Za-z_][^=;"\n]*?\b([A-Z]\w*)::~?\w+\()");
    const std::string text = without_templates(without_comments(given));
    std::set<std::string> found;
    for (std::sregex_iterator at(text.begin(), text.end(), kFunction), end; at != end; ++at)
        found.insert((*at)[1].str());
    static const std::regex kConstructor(R"((?:^|\n)([A-Z]\w*)::~?\1\()");
    for (std::sregex_iterator at(text.begin(), text.end(), kConstructor), end; at != end; ++at)
        found.insert((*at)[1].str());
    return found;
}

} // namespace isochron::house
