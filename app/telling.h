// What a command tells, and where: answers on stdout, notes and progress on stderr.
#pragma once

#include "app/safe_text.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace isochron::app {

/// How much a command tells beside its answer and its errors.
enum class Telling : std::uint8_t {
    quiet,   ///< nothing: no notes, no progress, no report of the files that it wrote
    usual,   ///< all of these
    verbose, ///< also what it opens, and the time and memory of its work
};

/// Obeys `--quiet`, `--verbose` and `--json` among the words of a command line, up to `--`. Called once,
/// before the command runs.
void set_telling(const std::vector<std::string>& words);
/// Whether the command tells what is told from `least` on.
bool tells(Telling least);
/// Whether stdout gets one JSON object in place of text.
bool tells_json();

/// Adds the members of an object to the one that `--json` prints when the command ends; any other value
/// takes its place.
void tell_result(const nlohmann::ordered_json& members);
/// Prints that object if `--json` was given. @param error the line that ended the command, if one did
void print_result(const std::string& error = {});

/// Prints what the command was asked for, on stdout, as text.
void print_answer(const SafeText& text);
/// Prints what the command has done, such as the files that it wrote, on stdout.
void print_report(const SafeText& text);
/// Prints a line of `isochron: ` and the text on stderr, where the command `tells(least)`.
void print_told(Telling least, const SafeText& text);

template <class... T>
void print_answer(SafeWords<T...> words, const T&... values) {
    print_answer(SafeText(words, values...));
}
template <class... T>
void print_report(SafeWords<T...> words, const T&... values) {
    print_report(SafeText(words, values...));
}
/// What the user may want to know: a fallback, a doubt about the data, where something was saved.
template <class... T>
void print_note(SafeWords<T...> words, const T&... values) {
    print_told(Telling::usual, SafeText(words, values...));
}
/// What is opened on the way, and what the work took.
template <class... T>
void print_detail(SafeWords<T...> words, const T&... values) {
    print_told(Telling::verbose, SafeText(words, values...));
}

} // namespace isochron::app
