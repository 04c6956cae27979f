// What a command tells, and where.
#include "app/telling.h"

#include <nlohmann/json.hpp>

namespace isochron::app {
namespace {

/// How this process tells, as stdout and stderr are the process's, too.
struct HowTold {
    Telling most = Telling::usual;
    bool json = false;
    nlohmann::ordered_json result;
};

HowTold& how_told() {
    static HowTold how;
    return how;
}

} // namespace

void set_telling(const std::vector<std::string>& words) {
    HowTold& how = how_told();
    for (const std::string& word : words) {
        if (word == "--")
            break;
        if (word == "--quiet")
            how.most = Telling::quiet;
        else if (word == "--verbose")
            how.most = Telling::verbose;
        else if (word == "--json")
            how.json = true;
    }
}

bool tells(Telling least) {
    return how_told().most >= least;
}

bool tells_json() {
    return how_told().json;
}

void tell_result(const nlohmann::ordered_json& members) {
    nlohmann::ordered_json& result = how_told().result;
    if (members.is_object() && result.is_object())
        result.update(members);
    else
        result = members;
}

void print_result(const std::string& error) {
    auto& [most, json, result] = how_told();
    if (!json || (result.is_null() && error.empty()))
        return;
    if (!error.empty())
        tell_result({{"failure", error}});
    print_safely(SafeText::json(result));
    json = false; // once
}

void print_answer(const SafeText& text) {
    if (!tells_json())
        print_safely(text);
}

void print_report(const SafeText& text) {
    if (!tells_json() && tells(Telling::usual))
        print_safely(text);
}

void print_told(Telling least, const SafeText& text) {
    if (tells(least))
        print_safely(stderr, "isochron: {}\n", text);
}

} // namespace isochron::app
