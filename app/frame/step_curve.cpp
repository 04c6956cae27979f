// Numbers of a surface at each step of a series.
#include "app/frame/step_curve.h"

#include "app/csv_field.h"
#include "index/measure/measures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace isochron::app {
namespace {

/// The columns of the table, by number of the measure.
std::vector<std::size_t> columns_of(const CurveSubject& subject) {
    if (subject.place)
        return {0};
    std::vector<std::size_t> columns;
    for (std::size_t i = 0; i < index::measures().size(); ++i)
        if (is_measured(index::measures()[i], subject.on_surface.has_value(),
                        subject.from.has_value()))
            columns.push_back(i);
    return columns;
}

} // namespace

std::size_t numbers_of(const CurveSubject& subject) {
    return subject.place ? 1 : index::measures().size();
}

StepCurve::StepCurve(CurveSubject of, std::size_t numbers, std::size_t steps)
    : subject(std::move(of)),
      values(numbers, std::vector<double>(steps, std::numeric_limits<double>::quiet_NaN())),
      known(steps), left(steps) {}

void StepCurve::set(std::uint32_t step, const std::vector<double>& numbers) {
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i][step] = numbers[i];
    left -= known[step] == 0;
    known[step] = 1;
}

std::string csv_of(const std::vector<StepCurvePtr>& curves) {
    if (curves.empty())
        return {};
    const CurveSubject& first = curves.front()->subject;
    const std::vector<std::size_t> columns = columns_of(first);
    const std::vector<double>& times = first.array->info().times;
    const bool of_several = std::ranges::any_of(
        curves, [&](const StepCurvePtr& each) { return each->subject.array != first.array; });
    std::string text = of_several ? "array," : "";
    text += first.place ? "step,fraction,time" : "step,fraction,time,isovalue";
    const auto out = std::back_inserter(text);
    for (const std::size_t i : columns)
        fmt::format_to(out, ",{}", first.place ? "value" : index::measures()[i].name);
    text += '\n';
    for (std::size_t step = 0; step < curves.front()->steps(); ++step)
        for (const StepCurvePtr& curve : curves) {
            if (!curve->known[step])
                continue;
            if (of_several)
                text += csv_field(curve->subject.array->info().array) + ',';
            fmt::format_to(out, "{},0,{}", step, times[step]);
            if (!first.place)
                fmt::format_to(out, ",{}", curve->subject.isovalue);
            for (const std::size_t i : columns) {
                const double value = curve->values[i][step];
                text += std::isfinite(value) ? fmt::format(",{}", value) : ",";
            }
            text += '\n';
        }
    return text;
}

} // namespace isochron::app
