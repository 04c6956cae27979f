// How deep a message nests, found out before anything that recurses reads it.
#pragma once

#include <cstddef>
#include <span>

namespace isochron::app {

constexpr int kDeepestMessage = 16; ///< arrays and maps in each other

/// Walks over a CBOR item (RFC 8949) without recursion. What is cut off or has no meaning is left to
/// the reader of the message to say.
/// @throws interaction::Error when it nests deeper than `kDeepestMessage`, says that it holds more
/// items than there are bytes, or has strings, arrays or maps without a length, or tags, none of
/// which our messages have
void expect_shallow_cbor(std::span<const std::byte> message);

} // namespace isochron::app
