// A driver with the smallest limits that GL 4.5 core allows; using more is a failure.
#pragma once

#include "render/gl/gl.h"

#include <functional>
#include <map>
#include <string_view>

namespace isochron::test_support {

/// The limits, by name, of a driver with no more than the OpenGL 4.5 core specification requires:
/// in its tables of implementation dependent values the smallest maximums, and for alignments the
/// largest minimums.
std::map<GLenum, GLint64> least_limits();

/// Replaces functions of the driver, which it presents as a GPU: answers with `limits`, and fails
/// the test if the program uses more. There can be only one at a time, because GL's functions take
/// no user data.
/// @param limits `least_limits()`, or less; limits that are not listed are the driver's
/// @return a function that replaces entry points, as stereo::ContextInBetween needs it
std::function<void*(std::string_view name, void* found)>
with_limits(std::map<GLenum, GLint64> limits);

} // namespace isochron::test_support
