// Numbers and dates that are missing in the names of a series' files.
#pragma once

#include "index/volume/calendar.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace isochron::index {

/// A note for the user, one sentence, if files without times have dates in their names, or differ in
/// one number of their names and some numbers are missing: `t_1.vti t_2.vti t_4.vti`. Else empty.
/// @param files in the order of their steps, one each
std::optional<std::string> note_on_names(std::span<const std::filesystem::path> files,
                                         std::optional<DayMonth> dates = {});

/// The steps behind which numbers or dates are missing, ascending: those in whose names the next one
/// is more than one and a half times as far away as most are (the lower median). None of fewer than
/// three files, and none where the numbers do not ascend.
/// @param files in the order of their steps, one each
std::vector<std::uint32_t> missing_after(std::span<const std::filesystem::path> files,
                                         std::optional<DayMonth> dates = {});

} // namespace isochron::index
