// What an eye remembers of something that it has hidden by an opacity of 0.
#pragma once

#include <imgui.h>

#include <cstddef>
#include <string_view>

namespace isochron::app {

/// The opacity that it had when it was seen last; 1 at first. The same wherever a window has an eye
/// for it. @param kind, i as in item_table.h
float& opacity_before(ImGuiStorage& of_window, std::string_view kind, std::size_t i);

} // namespace isochron::app
