// Numbers as text that VTK 9.1 does not read in legacy files: infinities and NaN.
#pragma once

#include <optional>
#include <string>
#include <string_view>

class vtkDataArray;
class vtkDataSetAttributes;

namespace isochron::index {

/// The text of a legacy file of numbers as text, where `nan`, `inf` and the like are replaced by
/// numbers that stand for them; none where there are no such words.
/// @throws Error naming the file, when it has these numbers already
std::optional<std::string> with_stand_ins(std::string_view text, const std::string& file);

/// Puts NaN and infinities back into all arrays of f32 and f64.
void replace_stand_ins(vtkDataSetAttributes& arrays);

} // namespace isochron::index
