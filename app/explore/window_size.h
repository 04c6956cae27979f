// The size of a desktop's window, kept from one session to the next.
#pragma once

#include "app/config/config.h"
#include "app/explore/explore_options.h"

#include <glm/vec2.hpp>

namespace isochron::app {

/// Whether the user alone decides how large the window is: neither options nor a configuration do.
bool may_keep_window_size(const ExploreOptions& options, const Config& config);

/// Gives the window the size that it had last, or that suits the desktop's scale.
void recall_window_size(Config& config);

/// Remembers a size in the user's folder for state of programs; where it cannot be written, it is
/// forgotten. @param size [pixel]
void remember_window_size(const glm::ivec2& size);

} // namespace isochron::app
