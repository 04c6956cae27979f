// Checks how deep a CBOR message nests, before the recursive parser reads it.
#pragma once

#include <cstddef>
#include <span>

namespace isochron::app {

constexpr int kDeepestMessage = 16; ///< most levels of arrays and maps inside each other

/// Walks over a CBOR item (RFC 8949) without recursion. Truncated or meaningless messages pass: the
/// parser that reads them next reports those.
/// @throws interaction::Error when the message nests deeper than `kDeepestMessage`, claims more
/// items than it has bytes, or holds tags, or strings, arrays or maps without a length: our
/// messages have none of these
void expect_shallow_cbor(std::span<const std::byte> message);

} // namespace isochron::app
