// Numbers as text that VTK 9.1 does not read in legacy files: infinities and NaN.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

class vtkDataSetAttributes;

namespace isochron::index {

/// The text of a legacy file of numbers as text, where `nan`, `inf` and the like are replaced by
/// numbers that stand for them; none where there are no such words.
/// @throws Error naming the file, when it has these numbers already
std::optional<std::string> with_stand_ins(std::string_view text, const std::string& file);

/// The text of a file with stand-ins. None also where the file's numbers are binary.
std::optional<std::string> text_with_stand_ins(const std::filesystem::path& file);

/// Puts NaN and infinities back into all arrays of f32 and f64.
void replace_stand_ins(vtkDataSetAttributes& arrays);

} // namespace isochron::index
