// Scalars that are computed from the values of a series, step by step.
#pragma once

#include "index/volume/volume_series.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace isochron::index {

/// What `--component` names beside the components that an array has.
enum class Derived : std::uint8_t {
    gradient,    ///< the length of a scalar's gradient
    vorticity,   ///< the length of the curl of a vector
    q_criterion, ///< half of (|rotation|^2 - |strain|^2) of a vector's gradient
    magnitude    ///< the length of a vector whose components are arrays
};

/// By its name: `gradient`, `vorticity`, `q-criterion`; none for `magnitude`, which readers handle.
std::optional<Derived> derived_from_name(const std::optional<std::string>& component);

/// The inputs' components, as values of `--component`; an empty value: the input is a scalar.
std::vector<std::optional<std::string>> components_for(Derived derived);

/// Derivatives are differences along each axis, in physical space and units of length: between both
/// neighbors, weighted by their distances, and at borders to the one neighbor, as numpy.gradient
/// has them. Components of vectors are along x, y and z of physical space. Values are f32, or f64
/// where the inputs' values have more than 24 bits; NaN where one of the values around is NaN.
/// @param inputs one for each of `components_for`, of the same files; of a magnitude two or three
/// @param name of the vector; empty: the inputs' name
/// @param unit of the result; none: made of the unit of the values and the unit of length
std::unique_ptr<VolumeSeries> derived_series(std::vector<std::unique_ptr<VolumeSeries>> inputs,
                                             Derived derived, const std::string& name,
                                             const std::optional<std::string>& unit);

} // namespace isochron::index
