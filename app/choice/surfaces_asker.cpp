// Asks for surfaces at instants, and finds those that are kept.
#include "app/choice/surfaces_asker.h"

#include <algorithm>

namespace isochron::app {

SurfacesAsker::SurfacesAsker()
    : Asker(
          [](const WantedSurfaces& wanted, const Asking& asking) {
              return MadeSurfaces{wanted.query,
                                  index::instant_surfaces(wanted.array, wanted.query, wanted.most,
                                                          asking.stop, wanted.known.get()),
                                  {}};
          },
          [](const WantedSurfaces& wanted, const std::string& why, bool canceled) {
              return MadeSurfaces{wanted.query, nullptr, canceled ? std::string() : why};
          }) {}

index::InstantSurfacesPtr surfaces_among(std::span<const index::InstantSurfacesPtr> kept,
                                         const index::SurfacesQuery& query, std::uint64_t most) {
    const auto found = std::ranges::find_if(kept, [&](const index::InstantSurfacesPtr& each) {
        return each->query == query &&
               (each->most == most || (each->exact() && each->triangles() <= most));
    });
    return found == kept.end() ? nullptr : *found;
}

} // namespace isochron::app
