// Merging and comparison of commands, by the list of their fields.
#include "interaction/command_fields.h"

#include <utility>

namespace isochron::interaction {
namespace {

// `combine` merges a later value of a field into an earlier one.

template <class T>
void combine(std::optional<T>& into, const std::optional<T>& later) {
    if (later)
        into = later;
}
void combine(bool& into, bool later) {
    into = into || later;
}
template <class T>
void combine(std::vector<T>& into, const std::vector<T>& later) {
    into.insert(into.end(), later.begin(), later.end());
}

} // namespace

void merge(Commands& into, const Commands& later) {
    // A later list has its own isovalues, and an isovalue belonged to the surface picked before.
    if (later.isosurfaces || later.picked)
        into.isovalue.reset();
    each_field([](const Field&, auto& a, const auto& b) { combine(a, b); }, into, later);
    if (later.instant)
        into.fraction.reset();
    else if (into.instant && into.fraction)
        into.instant->fraction = *std::exchange(into.fraction, std::nullopt);
}

std::vector<std::string> differences(const Commands& a, const Commands& b) {
    std::vector<std::string> keys;
    each_field(
        [&](const Field& field, const auto& left, const auto& right) {
            if (!(left == right))
                keys.emplace_back(field.key);
        },
        a, b);
    return keys;
}

} // namespace isochron::interaction
