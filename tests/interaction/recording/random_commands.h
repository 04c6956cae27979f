// Random commands, whose fields have any valid values.
#pragma once

#include "interaction/command_fields.h"
#include "tests/interaction/input_builders.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <optional>
#include <string>
#include <vector>

namespace isochron::interaction {

inline Similarity random_similarity(Random& random) {
    return {{uniform(random, -9, 9), uniform(random, -9, 9), uniform(random, -9, 9)},
            glm::normalize(glm::dquat(random_rotation(random))),
            std::exp(uniform(random, -9, 9)),
            random() % 2 ? 1 : std::exp(uniform(random, -4, 6))};
}

/// Any value that a field may have.
struct RandomValue {
    Random& random;

    bool sometimes() { return random() % 4 == 0; }
    void operator()(const Field&, bool& into) { into = random() % 2 == 0; }
    void operator()(const Field& field, std::uint32_t& into) {
        into = field.high < kAnyNumber
                   ? static_cast<std::uint32_t>(random() % (static_cast<unsigned>(field.high) + 1))
                   : random();
    }
    void operator()(const Field&, Instant& into) {
        into = {static_cast<std::uint32_t>(random()),
                static_cast<std::uint32_t>(random() % Instant::kFractions)};
    }
    template <std::floating_point T>
    void operator()(const Field& field, T& into) {
        into = static_cast<T>(field.high < kAnyNumber ? uniform(random, field.low, field.high)
                                                      : std::exp(uniform(random, -300, 300)));
        into = std::clamp(into, static_cast<T>(std::max(field.low, -1e30)),
                          static_cast<T>(std::min(field.high, 1e300)));
    }
    void operator()(const Field&, std::string& into) {
        into = std::array{"side_by_side", "zwölf\n", "stamp \"1\"", ""}[random() % 4];
    }
    template <Named Enum>
    void operator()(const Field&, Enum& into) {
        into = static_cast<Enum>(random() % kNames<Enum>.size());
    }
    template <class T>
    void operator()(const Field& field, glm::vec<3, T>& into) {
        for (int i = 0; i < 3; ++i)
            (*this)(field, into[i]);
    }
    void operator()(const Field& field, std::array<double, 2>& into) {
        into[0] = uniform(random, -9, 9);
        into[1] = into[0] + uniform(random, 1e-3, 9);
        if (field.any_order && sometimes())
            std::swap(into[0], into[1]);
    }
    void operator()(const Field&, Pose& into) { into = {{1e-30f, 2, -3}, random_rotation(random)}; }
    void operator()(const Field&, Similarity& into) { into = random_similarity(random); }
    void operator()(const Field&, ClipPlane& into) {
        into = {random() % 2 == 0,
                {uniform(random, -9, 9), uniform(random, -9, 9), uniform(random, -9, 9)},
                glm::dvec3(random_rotation(random) * glm::vec3(0, 0, 1))};
        into.normal = glm::normalize(into.normal);
    }
    void operator()(const Field&, Plane& into) {
        ClipPlane plane;
        (*this)(Field{""}, plane);
        into = {plane.point, plane.normal, plane.shown};
    }
    void operator()(const Field&, ClipBox& into) {
        into = {random() % 2 == 0, glm::dvec3(uniform(random, -9, 0)), glm::dvec3(1, 2, 3)};
    }
    void operator()(const Field& field, Mark& into) {
        into = {};
        if (!sometimes())
            (*this)(field, into.point.emplace());
    }
    template <class T>
    void operator()(const Field& field, std::optional<T>& into) {
        into.reset();
        if (sometimes())
            (*this)(field, into.emplace());
    }
    template <class T>
    void operator()(const Field& field, std::vector<T>& into) {
        into.clear();
        const std::size_t most = std::min<std::size_t>(field.most, 3);
        for (std::size_t n = field.least + random() % (most + 1 - field.least); n > 0; --n)
            (*this)(field, into.emplace_back());
    }
    template <class T>
    void operator()(const Field&, T& part) requires requires {
        each_field(*this, part);
    }
    { each_field(*this, part); }
};

inline Commands random_commands(Random& random) {
    Commands commands;
    each_field(RandomValue{random}, commands);
    if (commands.instant)
        commands.fraction.reset();
    return commands;
}

} // namespace isochron::interaction
