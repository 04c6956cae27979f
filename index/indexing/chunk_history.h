// The steps since which chunks have stayed, for a build that begins in the middle of a series:
// after the steps of an index that grows, or after those of earlier members of a team.
#pragma once

#include "index/file/index_file.h"
#include "index/indexing/part_writer.h"
#include "index/indexing/step_writer.h"
#include "index/system/team.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace isochron::index {

/// The steps that a member takes.
struct MemberSteps {
    std::size_t fresh = 0; ///< the first step that is not held
    std::size_t begin = 0, end = 0;
};

/// History of the last step that an index holds, as StepWriter::since has it.
/// @param colors of the array to color by, else of the volume
std::vector<std::uint32_t> held_since(const IndexFile& held, bool colors);

/// A member that has only looked at the step before its first one does not know since when the chunks
/// of that step have stayed. The members tell each other, and each corrects its tables. All members
/// call it together, before their parts are placed.
/// @param entries of this member's steps, step after step
void settle_since(const StepWriter& writer, std::span<const StepEntry> entries,
                  const MemberSteps& steps, PartWriter& parts, Team& team);

} // namespace isochron::index
