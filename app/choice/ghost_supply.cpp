// Makes ghosts beside the frames, and keeps those that may serve again.
#include "app/choice/ghost_supply.h"

#include "app/scene/caption.h"
#include "interaction/step_track.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace isochron::app {
namespace {

/// Ghosts that are kept, those shown included.
constexpr std::size_t kMostKept = 32;

std::uint64_t apart(index::Instant a, index::Instant b) {
    return std::max(a, b).number() - std::min(a, b).number();
}

/// Whether ghosts of one may stand in for those of the other.
bool same_surfaces(const index::SurfacesQuery& a, const index::SurfacesQuery& b) {
    return a.array == b.array && a.isovalues == b.isovalues;
}

} // namespace

std::vector<index::Instant> ghost_instants(const interaction::Ghosts& ghosts, index::Instant shown,
                                           const interaction::StepRange& range, std::size_t steps,
                                           const interaction::StepGaps& gaps) {
    const auto known = static_cast<std::uint32_t>(steps);
    const index::Instant first(first_of(range, known)), last(last_of(range, known));
    std::vector<index::Instant> instants;
    const auto add = [&](std::uint64_t step) {
        if (step >= steps)
            return;
        const auto number = static_cast<std::uint32_t>(step);
        const index::Instant at =
            gaps.behind(number) ? index::Instant(number) : index::Instant(number, shown.fraction);
        if (at >= first && at <= last && at != shown)
            instants.push_back(at);
    };
    for (std::uint32_t k = 1; ghosts.shown() && k <= interaction::kMostGhosts; ++k) {
        const std::uint64_t away = std::uint64_t{k} * ghosts.every;
        if (k <= ghosts.earlier && away <= shown.step)
            add(shown.step - away);
        if (k <= ghosts.later)
            add(shown.step + away);
    }
    return instants;
}

std::string ghost_words(std::span<const index::Instant> instants) {
    std::vector<std::string> numbers;
    for (const index::Instant at : instants)
        numbers.push_back(step_number(at));
    if (numbers.size() < 2)
        return numbers.empty() ? "" : "ghost of step " + numbers.front();
    const std::string last = numbers.back();
    numbers.pop_back();
    return fmt::format("ghosts of steps {} and {}", fmt::join(numbers, ", "), last);
}

GhostSupply::GhostSupply(std::shared_ptr<const index::IndexFile> file) : file_(std::move(file)) {}

void GhostSupply::take() {
    for (MadeSurfaces& made : making_.take()) {
        makes_ = false;
        if (made.surfaces) {
            ++made_;
            if (!kept_.empty() && !same_surfaces(kept_.front()->query, made.query))
                kept_.clear();
            std::erase_if(kept_, [&](const auto& kept) { return kept->query == made.query; });
            kept_.push_back(std::move(made.surfaces));
        } else if (!made.failure.empty()) {
            failed_.push_back(std::move(made.query));
            messages_.push_back(std::move(made.failure));
        }
    }
}

void GhostSupply::drop_all() {
    if (makes_)
        making_.cancel();
    kept_.clear();
    shown_.clear();
    failed_.clear();
    come_ = false;
}

index::InstantSurfacesPtr GhostSupply::at_hand(const index::SurfacesQuery& query) const {
    return surfaces_among(kept_, query, most_);
}

std::optional<index::SurfacesQuery>
GhostSupply::next(std::span<const index::SurfacesQuery> queries) const {
    for (const index::SurfacesQuery& query : queries)
        if (!at_hand(query) && std::ranges::find(failed_, query) == failed_.end())
            return query;
    return std::nullopt;
}

/// The kept ghost that is nearest in time to one that is not there, on the same side of `now`.
/// @param within steps
index::InstantSurfacesPtr GhostSupply::stand_in(index::Instant wished, index::Instant now,
                                                std::uint32_t within) const {
    index::InstantSurfacesPtr nearest;
    std::uint64_t most = std::uint64_t{within} * index::Instant::kFractions;
    for (const index::InstantSurfacesPtr& kept : kept_) {
        const index::Instant at = kept->query.instant;
        const bool there = std::ranges::find(shown_, at, [](const auto& shown) {
                               return shown->query.instant;
                           }) != shown_.end();
        if (there || at == now || (at < now) != (wished < now) || apart(at, wished) > most)
            continue;
        most = apart(at, wished);
        nearest = kept;
    }
    return nearest;
}

void GhostSupply::choose(std::span<const index::SurfacesQuery> queries, index::Instant now,
                         std::uint32_t every) {
    shown_.clear();
    for (const index::SurfacesQuery& query : queries)
        if (index::InstantSurfacesPtr there = at_hand(query))
            shown_.push_back(std::move(there));
    for (const index::SurfacesQuery& query : queries)
        if (come_ && !at_hand(query))
            if (index::InstantSurfacesPtr other = stand_in(query.instant, now, every))
                shown_.push_back(std::move(other));
    const auto time_of = [](const auto& ghost) { return ghost->query.instant; };
    std::ranges::sort(shown_, {}, time_of);
    const auto away = [&](const auto& ghost) { return apart(ghost->query.instant, now); };
    std::ranges::sort(kept_, {}, away);
    if (kept_.size() > kMostKept)
        kept_.resize(kMostKept);
}

void GhostSupply::update(const Frame& frame, const interaction::StepGaps& gaps) {
    take();
    wished_.clear();
    const interaction::Ghosts& ghosts = frame.state.ghosts;
    if (!ghosts.shown()) {
        drop_all();
        return;
    }
    const index::SurfacesQuery& asked = frame.report.asked;
    if (!kept_.empty() && (kept_.front()->query.array != asked.array ||
                           kept_.front()->query.isovalues.size() != asked.isovalues.size()))
        kept_.clear();
    most_ = kMostTriangles / (ghosts.earlier + ghosts.later);
    // While time plays between steps, whole ones serve longer than it takes to make them.
    const bool plays = frame.is_live() && frame.state.playback.playing;
    const index::Instant now =
        plays ? index::Instant(asked.instant.step) : asked.instant.within(frame.steps);
    std::vector<index::SurfacesQuery> queries;
    for (const index::Instant at :
         ghost_instants(ghosts, now, frame.state.play_range, frame.steps, gaps)) {
        queries.push_back({at, asked.isovalues});
        queries.back().array = asked.array;
        wished_.push_back(at);
    }
    std::ranges::sort(wished_);
    std::erase_if(failed_, [&](const auto& failed) {
        return std::ranges::find(queries, failed) == queries.end();
    });
    for (auto query = next(queries); query && (!makes_ || !frame.is_live());
         query = next(queries)) {
        if (!std::exchange(makes_, true))
            making_.ask({array_of(file_, query->array), *query, most_});
        if (frame.is_live())
            break;
        making_.finish();
        take();
    }
    come_ = next(queries).has_value();
    choose(queries, now, ghosts.every);
}

std::string GhostSupply::words() const {
    std::vector<index::Instant> instants;
    bool simplified = false;
    for (const index::InstantSurfacesPtr& ghost : shown_) {
        instants.push_back(ghost->query.instant);
        simplified |= !ghost->exact();
    }
    std::string words = ghost_words(instants);
    if (simplified)
        words += ", simplified";
    if (come_)
        words += words.empty() ? "ghosts are being made" : "; more come";
    return words;
}

std::vector<ShownGhost> shown_ghosts(const std::vector<index::InstantSurfacesPtr>& made,
                                     const ExplorerState& state, index::Instant now) {
    // By share of the way to the ghost that is farthest away in time.
    constexpr glm::vec3 kEarlier(0.13f, 0.36f, 0.86f), kLater(1.0f, 0.76f, 0.36f);
    constexpr float kLeastTint = 0.45f, kMostTint = 0.8f;
    std::vector<ShownGhost> ghosts;
    const interaction::Ghosts& asked = state.ghosts;
    for (const index::InstantSurfacesPtr& surfaces : made) {
        const index::Instant at = surfaces->query.instant;
        if (at == now || state.slices.hides_surfaces())
            continue;
        const std::uint32_t count = std::max(1u, at < now ? asked.earlier : asked.later);
        const auto farthest =
            static_cast<float>(std::uint64_t{count} * asked.every * index::Instant::kFractions);
        const float share = std::min(1.0f, static_cast<float>(apart(at, now)) / farthest);
        ShownGhost& ghost = ghosts.emplace_back();
        ghost.surfaces = surfaces;
        ghost.opacity = asked.opacity;
        ghost.earlier = at < now;
        for (const interaction::Isosurface& surface : state.isosurfaces)
            ghost.colors.push_back(glm::mix(surface.color, at < now ? kEarlier : kLater,
                                            glm::mix(kLeastTint, kMostTint, share)));
    }
    return ghosts;
}

} // namespace isochron::app
