// A driver with the least of everything that GL 4.5 core promises, and that does not bear more.
#pragma once

#include "render/gl/gl.h"

#include <functional>
#include <map>
#include <string_view>

namespace isochron::test_support {

/// What a driver answers, by name, that has no more than the OpenGL 4.5 core specification asks of
/// it: in its tables of implementation dependent values the smallest maximums, and for alignments
/// the largest minimums.
std::map<GLenum, GLint64> least_limits();

/// Stands between a program and the driver, which it calls a GPU: answers by `limits` and complains,
/// by a failure of the test, where more is asked for. There is one at a time, since GL's functions have no room for
/// state.
/// @param limits `least_limits()`, or less; those of the driver where they are not among them
/// @return what takes the place of an entry point, as stereo::ContextInBetween wants it
std::function<void*(std::string_view name, void* found)>
with_limits(std::map<GLenum, GLint64> limits);

} // namespace isochron::test_support
