// Checks how deep a CBOR message nests, by counting instead of recursion.
#include "app/cluster/cbor_nesting.h"

#include "interaction/error.h"

#include <array>
#include <cstdint>
#include <optional>

namespace isochron::app {
namespace {

/// The major types of RFC 8949, section 3.1.
enum class CborType : std::uint8_t { natural, negative, bytes, text, array, map, tag, simple };

struct CborHead {
    CborType type;
    std::uint64_t count; ///< bytes, items or pairs
};

/// Takes a head from the front; empty if the message ends inside it.
std::optional<CborHead> take_head(std::span<const std::byte>& left) {
    if (left.empty())
        return {};
    const auto first = std::to_integer<std::uint8_t>(left[0]);
    const auto type = static_cast<CborType>(first >> 5);
    const unsigned more = first & 31;
    left = left.subspan(1);
    if (more > 27 || type == CborType::tag)
        throw interaction::Error("message: expected CBOR with lengths and without tags");
    if (more < 24)
        return CborHead{type, more};
    const std::size_t size = std::size_t{1} << (more - 24);
    if (left.size() < size)
        return {};
    std::uint64_t count = 0;
    for (const std::byte byte : left.first(size))
        count = count << 8 | std::to_integer<std::uint64_t>(byte);
    left = left.subspan(size);
    return CborHead{type, count};
}

} // namespace

void expect_shallow_cbor(std::span<const std::byte> message) {
    std::array<std::uint64_t, kDeepestMessage> items; // left to read, by level
    int depth = 0;
    do {
        const auto head = take_head(message);
        if (!head)
            return;
        if (depth > 0)
            --items[depth - 1];
        const bool pairs = head->type == CborType::map;
        if (head->type == CborType::bytes || head->type == CborType::text) {
            if (head->count > message.size())
                return;
            message = message.subspan(head->count);
        } else if (pairs || head->type == CborType::array) {
            if (depth == kDeepestMessage)
                throw interaction::Error("message: nested deeper than {} levels", kDeepestMessage);
            if (head->count > message.size()) // each item takes a byte
                throw interaction::Error("message: {} items in {} bytes", head->count,
                                         message.size());
            items[depth++] = head->count * (pairs ? 2 : 1);
        }
        while (depth > 0 && items[depth - 1] == 0)
            --depth;
    } while (depth > 0);
}

} // namespace isochron::app
