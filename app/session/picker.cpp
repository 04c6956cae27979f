// Picking by rays, and reading of data.
#include "app/session/picker.h"

#include "app/config/first_placement.h"
#include "index/extraction/value_in_index.h"
#include "interaction/tools/clip_box.h"

#include <glm/matrix.hpp>

#include <algorithm>
#include <limits>
#include <span>

namespace isochron::app {
namespace {

using namespace interaction;

const HapticPulse kFound{"wand", 0.04, 0.8f};

glm::dvec3 in_data(const ExplorerState& state, const glm::dvec4& in_room) {
    return glm::dvec3(glm::inverse(matrix(state.room_from_physical)) * in_room);
}

index::Ray ray_of(const Pose& pose, const ExplorerState& state) {
    const glm::dvec3 ahead(pose.orientation * glm::vec3(0.0f, 0.0f, -1.0f));
    return {in_data(state, glm::dvec4(pose.position, 1.0)), in_data(state, glm::dvec4(ahead, 0.0))};
}

constexpr double kOnPlane = 1e-9; ///< rounding error, relative to the distance from the origin

/// The ray from where it leaves the sides that are cut away; empty if it never does.
std::optional<index::Ray> uncut(index::Ray ray, std::span<const ClipPlane> cuts) {
    double along = 0;
    for (const ClipPlane& cut : cuts)
        if (const double start = cut.beyond(ray.origin); start > 0) {
            const double rate = glm::dot(ray.direction, cut.normal);
            if (!(rate < 0))
                return std::nullopt;
            along = std::max(along, start / -rate);
        }
    ray.origin += along * ray.direction;
    return ray;
}

} // namespace

Picker::Picker(std::shared_ptr<const index::IndexFile> file)
    : file_(std::move(file)), reading_(read, [](const Place&, const std::string& why, bool) {
          return Read{std::nullopt, why};
      }) {}

void Picker::set_slices(const std::vector<index::SliceValuesPtr>& slices,
                        const index::SeriesInfo& info) {
    slices_ = slices;
    const bool other = info.array != file_->info().array;
    sliced_ = other ? info.array : std::string();
    sliced_unit_ = other ? info.value_unit : std::string();
}

std::optional<Pointed> Picker::surface_hit(const index::Ray& ray, const ExplorerState& state,
                                           const index::ExtractionPtr& shown) const {
    if (state.slices.hides_surfaces())
        return std::nullopt;
    const auto cuts = interaction::cutting_planes(state, data_frame(file_->info()));
    const auto seen = uncut(ray, cuts);
    if (!seen)
        return std::nullopt;
    std::optional<Pointed> first;
    double nearest = std::numeric_limits<double>::infinity();
    const auto meet = [&](const auto& surfaces, const ShownValues& of = {}) {
        const auto hit = index::first_hit(surfaces, file_->info().grid, *seen,
                                          interaction::visible(state.isosurfaces));
        const auto is_beyond = [&](const ClipPlane& cut) {
            return cut.beyond(hit->at) > kOnPlane * glm::length(hit->at);
        };
        if (!hit || hit->along >= nearest || std::ranges::any_of(cuts, is_beyond))
            return;
        nearest = hit->along;
        first = Pointed{{hit->at, surfaces.query.instant, surfaces.query.isovalues[hit->surface],
                         of.array, of.unit},
                        hit->surface};
    };
    if (shown)
        meet(*shown);
    for (const index::InstantSurfacesPtr& ghost : ghosts_)
        meet(*ghost);
    for (const ShownFurther& further : further_)
        meet(*further.surfaces, further.values);
    return first;
}

std::optional<Pointed> Picker::slice_hit(const index::Ray& ray) const {
    std::optional<Pointed> first;
    double nearest = std::numeric_limits<double>::infinity();
    for (const index::SliceValuesPtr& slice : slices_) {
        const double rate = glm::dot(ray.direction, slice->query.normal);
        const double along = glm::dot(slice->query.point - ray.origin, slice->query.normal) / rate;
        if (rate == 0 || !(along > 0 && along < nearest))
            continue;
        const glm::dvec3 at = ray.origin + along * ray.direction;
        const auto value = index::value_on(*slice, file_->info().grid, at);
        if (!value)
            continue;
        nearest = along;
        first = Pointed{{at, slice->query.instant, *value, sliced_, sliced_unit_}, 0, true};
    }
    return first;
}

std::optional<Pointed> Picker::hit_by(const Pose& pose, const ExplorerState& state,
                                      const index::ExtractionPtr& shown) const {
    const index::Ray ray = ray_of(pose, state);
    const auto surface = surface_hit(ray, state, shown), slice = slice_hit(ray);
    if (!surface || !slice)
        return surface ? surface : slice;
    return glm::distance(surface->point.position, ray.origin) <
                   glm::distance(slice->point.position, ray.origin)
               ? surface
               : slice;
}

std::optional<Pointed> Picker::pointed(const InputState& input, bool aims,
                                       const ExplorerState& state,
                                       const index::ExtractionPtr& shown) const {
    const auto ray = Reading::hand(Reading(input).pointer);
    return ray && aims ? hit_by(*ray, state, shown) : std::nullopt;
}

/// The place whose data are read. For the cursor: where its ray meets the first surface, else where
/// it enters the data. For a wand: its tip.
std::optional<glm::dvec3> Picker::place_to_read(const InputState& input, const ExplorerState& state,
                                                const index::ExtractionPtr& shown) const {
    const Reading now(input);
    if (const auto eye = Reading::hand(now.pointer)) {
        const auto hit = hit_by(*eye, state, shown);
        return hit ? hit->point.position
                   : index::entry_into(file_->info().grid, ray_of(*eye, state));
    }
    const auto wand = Reading::hand(now.wand);
    return wand ? std::optional(in_data(state, glm::dvec4(wand->position, 1.0))) : std::nullopt;
}

Picker::Read Picker::read(const Place& place, const Asking&) {
    const auto value = index::value_in(*place.file, place.instant, place.at);
    if (!value)
        return {Mark{}, "no data there"};
    return {Mark{MarkedPoint{place.at, place.instant, *value}}, ""};
}

void Picker::update(const InputState& input, const ExplorerState& state,
                    const index::ExtractionPtr& shown) {
    const Reading now(input, before_);
    before_ = now.levels();
    if (now.pressed(Action::probe) || now.pressed(WandButton::probe)) {
        if (const auto place = place_to_read(input, state, shown))
            reading_.ask({file_, *place, state.shown_instant()});
        else
            messages_.emplace_back("no data there");
    }
    Commands read;
    for (Read& each : reading_.take()) {
        if (each.mark)
            read.mark = each.mark;
        if (!each.message.empty())
            messages_.push_back(std::move(each.message));
    }
    if (read.mark && read.mark->point)
        read.haptics.push_back(kFound);
    merge(found_, read);
}

} // namespace isochron::app
