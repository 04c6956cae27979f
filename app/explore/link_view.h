// The view that a link asks for, as the page of `isochron serve` writes it, and the link to a view.
#pragma once

#include "app/frame/explorer_state.h"
#include "interaction/pose.h"
#include "stereo/screen.h"

#include <glm/glm.hpp>

#include <map>
#include <string>

namespace isochron::app {

/// What a picture of the page is compared with: a screen, and who looks at it.
struct LinkScreen {
    stereo::Screen screen;
    interaction::Pose head; ///< room space
    glm::ivec2 pixels{1};
};

/// Settings of a link in a state; what is not in it, or is none, stays.
/// @param state of the array that the link names @param settings as `index::settings_of_link` gives them
ExplorerState as_linked(ExplorerState state, const std::map<std::string, std::string>& settings,
                        const index::IndexFile& file, const LinkScreen& screen);
/// The array that a link names by its number; 0: the first, or it names none.
std::size_t array_of_link(const std::map<std::string, std::string>& settings,
                          const index::IndexFile& file);

/// A link that shows what a state shows, in the page too; without any token.
/// @param address of the index
std::string link_to(const std::string& address, const ExplorerState& state,
                    const index::IndexFile& file, const LinkScreen& screen);

} // namespace isochron::app
