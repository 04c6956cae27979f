// Finds the classes of C++ sources, their members and where their functions are, by reading text.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace isochron::house {

/// A class or struct as its definition says it.
struct ClassText {
    std::string name;
    int members = 0; ///< data members that every object has; static ones do not count
    int methods = 0; ///< functions declared in it, constructors and operators included
};

/// Comments and the insides of literals become blanks, so that braces and names in them do not count.
std::string without_comments(const std::string& text);

/// The classes that a source or header defines, nested ones included.
std::vector<ClassText> classes_in(const std::string& text);

/// The classes of which a source defines functions outside their bodies, as `Session::frame(...) {`.
std::set<std::string> classes_implemented_in(const std::string& text);

} // namespace isochron::house
