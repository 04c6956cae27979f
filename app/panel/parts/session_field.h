// Sessions to go on with, as a list with small pictures.
#pragma once

#include "app/panel/panel_model.h"

#include <imgui.h>

#include <cstddef>
#include <future>
#include <optional>
#include <span>
#include <string>

namespace isochron::app {

/// The place of a small picture [panel pixel].
inline ImVec2 small_picture_size() {
    return {80.0f, 50.0f};
}
/// A small picture in its place, as large as it fits. The place is dim as long as there is none.
void small_picture(const std::shared_future<render::Image>& picture);

/// A choice among sessions, each with its picture and its words. It takes the width of the next item.
/// @param current what the closed field says @return number of the session that the user chose
std::optional<std::size_t> session_field(const char* id, const std::string& current,
                                         std::span<const OfferedSession> sessions);

} // namespace isochron::app
