// The frames of a process that does not share them.
#include "app/cluster/frames_alone.h"

#include <limits>

namespace isochron::app {

Latch FramesAlone::begin(const interaction::InputState&, const interaction::Commands&, Waiting,
                         const Latch& latch, const stereo::Installation&) {
    return latch;
}

index::SurfacesQuery FramesAlone::ask(index::SurfacesQuery wanted, Waiting) {
    return wanted;
}

CellsInFrame FramesAlone::cells(const index::Extractor& extractor, const index::ExtractionPtr&,
                                Waiting) {
    return {extractor.newest(), nullptr};
}

std::string FramesAlone::failure(const index::Extractor& extractor) const {
    return extractor.failure().value_or("");
}

bool FramesAlone::has_no_answer(const index::Extractor& extractor) const {
    return extractor.failure() && !extractor.busy();
}

std::uint64_t FramesAlone::surface_limit() const {
    return std::numeric_limits<std::uint64_t>::max();
}

} // namespace isochron::app
