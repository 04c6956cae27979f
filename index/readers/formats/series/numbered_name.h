// Names with numbers that give files, folders, groups and slices an order: one reading for all.
#pragma once

#include "index/volume/calendar.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::index {

/// How the characters of names make numbers.
struct NameStyle {
    /// `0.25`, `0,25` and `2.5e-01` are one number each; else every row of digits is one.
    bool decimals = true;
    /// In `t-1` the number is below zero; else only in `t_-1` and `t=-1`, as in `run-1` it is not.
    bool signs_behind_letters = false;
    /// `jan` and `January` are 1.
    bool months = false;
};

/// A number in a name.
struct NameNumber {
    std::string text;         ///< as it stands in the name
    double value = 0;         ///< infinite beyond the range of f64
    std::string whole;        ///< digits without leading zeros, unless it has a sign or a fraction
    std::size_t begin = 0;    ///< in the name
    std::size_t fraction = 0; ///< digits behind the point

    std::size_t end() const { return begin + text.size(); }
    /// As close as its digits tell: 0 of whole numbers.
    double rounding() const;
    /// Whole numbers of any length are exact.
    bool operator==(const NameNumber& other) const;
    bool operator<(const NameNumber& other) const;
};

/// A name taken apart: the texts between its numbers, and these.
struct NumberedName {
    std::string name;
    std::vector<std::string> texts; ///< one more than there are numbers
    std::vector<NameNumber> numbers;

    /// The name with `*` for every number.
    std::string pattern() const;
};

/// A row of more than one point, such as the version `1.2.3`, is no decimal.
NumberedName taken_apart(const std::string& name, NameStyle style = {});

/// Whether a name comes before another in natural order, `t2` before `t10`.
bool natural_less(const NumberedName& a, const NumberedName& b);

/// Names read together.
struct ReadNames {
    std::vector<NumberedName> names; ///< in the order given
    std::vector<std::size_t> order;  ///< order of the names by their numbers
    /// One sentence for the user, where the other reading would give another order.
    std::optional<std::string> note;
};

/// Numbers with a point are decimals, unless that cannot be: beside `1.9`, `1.10` counts. Names that
/// differ in the words for months are in the order of the year, and dates with the year behind the month
/// in their order, where both are told from the names (see `order_of_dates`).
/// @param dates order of day and month, where a user says it
ReadNames read_names(const std::vector<std::string>& names, std::optional<DayMonth> dates = {});

/// Which numbers differ among names with the same texts; empty if texts differ.
std::vector<std::size_t> varying_numbers(std::span<const NumberedName> names);

/// Where the number at the end of a text begins; none: it does not end in one.
std::optional<std::size_t> number_at_end(std::string_view text);

/// The numbers in the names of files that count as times: the number that differs among the names,
/// the last where several do; if none differs, the last number of each name. Empty for a file whose
/// name has no number.
std::vector<std::optional<double>> times_in_names(std::span<const std::filesystem::path> files);

} // namespace isochron::index
