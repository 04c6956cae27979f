// Numbers of a surface at each step of a series, which a plot shows as curves.
#pragma once

#include "index/file/index_file.h"
#include "index/surface/mesh_crop.h"
#include "index/volume/query.h"
#include "interaction/setting_values.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

/// What the numbers are of: a surface, or a place.
struct CurveSubject {
    std::shared_ptr<const index::IndexFile> array;
    double isovalue = 0;
    std::optional<interaction::ClipPlane> clip = {}; ///< cuts the surface
    std::optional<index::VertexBox> box = {};        ///< only the cells in it are measured
    index::PieceFilter kept = {};                    ///< see index::MeasureWishes
    /// Number of the array on the surface whose mean and extremes are measured (index::ColorSource).
    std::optional<std::size_t> on_surface = {};
    std::optional<glm::dvec3> from = {}; ///< distances are measured from here, in physical space
    /// The only number is the value here, in physical space; all but `array` is not used then.
    std::optional<glm::dvec3> place = {};
    bool operator==(const CurveSubject&) const = default;
};

/// Immutable once it is shared.
struct StepCurve {
    CurveSubject subject;
    /// By number of the measure (index::measures()), or the value at the place alone; by step. NaN
    /// where it is not defined, and where it is not known yet.
    std::vector<std::vector<double>> values;
    std::vector<std::uint8_t> known; ///< by step: whether it is measured
    std::size_t left = 0;            ///< steps that are not

    StepCurve(CurveSubject of, std::size_t numbers, std::size_t steps);
    std::size_t steps() const { return known.size(); }
    /// @param numbers as many as the curve has
    void set(std::uint32_t step, const std::vector<double>& numbers);
};
using StepCurvePtr = std::shared_ptr<const StepCurve>;

/// The numbers that are measured at each step of a subject.
std::size_t numbers_of(const CurveSubject& subject);

/// A table as `isochron measure --csv` prints it, or of a place `step,fraction,time,value`; a row for
/// each step that is known. Where the arrays differ, the first column names them.
/// @param curves all of surfaces or all of places
std::string csv_of(const std::vector<StepCurvePtr>& curves);

} // namespace isochron::app
