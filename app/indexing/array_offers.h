// The arrays that a user can choose from, where the arrays of the files cannot all be shown
// together.
#pragma once

#include "app/indexing/build_sources.h"

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

/// One of several arrays, in words for a user who chooses.
struct ArrayOffer {
    std::string name;      ///< as `--array` takes it
    std::string shape;     ///< `64 x 64 x 64, 10 steps`
    std::string unit;      ///< unit of its values; may be empty
    std::size_t group = 0; ///< arrays of one shape, with the same times, have the same number
    std::optional<std::array<double, 2>> range{}; ///< range of its first step; empty: not read
    std::string fault{};                          ///< why it cannot be shown; empty: it can
    bool operator==(const ArrayOffer&) const = default;
};
/// Waits for the user's choice. @return number of an offer without a fault
using ChooseArray = std::function<std::size_t(const std::vector<ArrayOffer>&)>;

/// The arrays of files in which some have another shape or other times than the rest; empty where
/// all that can be read go together.
std::vector<ArrayOffer> offered_arrays(const std::vector<std::filesystem::path>& files,
                                       const BuildArguments& arguments);

/// The least and the greatest value of an array's first step; empty if it has none, or cannot be
/// read, or the wait is over.
/// @param goes_on asked for each piece that is read: false ends the wait
std::optional<std::array<double, 2>> first_range(const std::vector<std::filesystem::path>& files,
                                                 const BuildArguments& arguments,
                                                 const std::string& array,
                                                 const std::function<bool()>& goes_on);

/// As `open_one_or_all`; where files have arrays of several shapes, it opens the chosen one with all
/// that can be shown with it. @param choose empty: as `open_one_or_all`
BuildSources open_chosen(const std::vector<std::filesystem::path>& files, BuildArguments& arguments,
                         const ChooseArray& choose);

/// The arguments for a chosen array first, and behind it all that can be shown with it.
BuildArguments with_array(BuildArguments arguments, const std::vector<ArrayOffer>& offers,
                          std::size_t chosen);

} // namespace isochron::app
