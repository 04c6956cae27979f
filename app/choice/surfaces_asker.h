// Makes surfaces at instants beside the frames, as triangles.
#pragma once

#include "app/frame/asker.h"
#include "index/extraction/instant_surfaces.h"
#include "index/file/index_file.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace isochron::app {

struct WantedSurfaces {
    std::shared_ptr<const index::IndexFile> array; ///< that of the query
    index::SurfacesQuery query;
    std::uint64_t most = 0; ///< triangles
    /// Crossings from one question to the next, which the asker's thread alone uses; may be null.
    std::shared_ptr<index::KnownCrossings> known = {};
};
struct MadeSurfaces {
    index::SurfacesQuery query;
    index::InstantSurfacesPtr surfaces; ///< null: not made
    std::string failure;                ///< empty: none
};

class SurfacesAsker : public Asker<WantedSurfaces, MadeSurfaces> {
  public:
    SurfacesAsker();
};

/// Those of a query with all their triangles, or made with as many as may be. @return null: not there
index::InstantSurfacesPtr surfaces_among(std::span<const index::InstantSurfacesPtr> kept,
                                         const index::SurfacesQuery& query, std::uint64_t most);

} // namespace isochron::app
