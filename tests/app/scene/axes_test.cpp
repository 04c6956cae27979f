// Numbers along the box: on edges at its outline, of physical coordinates.
#include "app/scene/axes.h"

#include "tests/support/test_seed.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <random>

namespace isochron::app {
namespace {

index::SeriesInfo info_of_box() {
    index::SeriesInfo info;
    info.length_unit = "mm";
    info.grid.vertices = {11, 21, 6};
    info.grid.spacing = {2.0, 1.0, 4.0};
    info.grid.origin = {-10.0, 100.0, 0.0};
    return info;
}

render::Placement in_front(const index::SeriesInfo& info) {
    glm::dmat4 room(1.0);
    room = glm::translate(room, glm::dvec3(0, 1.6, -2));
    room = glm::scale(room, glm::dvec3(0.05));
    room = glm::translate(room, -glm::dvec3(0, 110, 10));
    return render::Placement::of(info.grid, room);
}

interaction::Pose head_at(const glm::vec3& position) {
    const glm::mat4 eye = glm::lookAt(position, glm::vec3(0, 1.6f, -2), glm::vec3(0, 1, 0));
    return {position, glm::conjugate(glm::quat_cast(glm::mat3(eye)))};
}

TEST(Axes, RunInPhysicalCoordinatesAlongPhysicalAxes) {
    index::SeriesInfo info = info_of_box();
    AxisScale scale = axis_scale(info, 0);
    EXPECT_EQ(scale.title, "x [mm]");
    EXPECT_EQ(scale.low, -10);
    EXPECT_EQ(scale.high, 10);
    // Stored backwards, and y and z exchanged: the numbers still are coordinates.
    info.grid.direction =
        glm::dmat3(glm::dvec3(-1, 0, 0), glm::dvec3(0, 0, 1), glm::dvec3(0, 1, 0));
    EXPECT_EQ(axis_scale(info, 0).high, -30);
    EXPECT_EQ(axis_scale(info, 1).title, "z [mm]");
    EXPECT_EQ(axis_scale(info, 1).high, 20);
}

TEST(Axes, AreCalledAsTheFileCallsThem) {
    index::SeriesInfo info = info_of_box();
    info.axis_names = {"depth", "grid_longitude (degrees)", ""};
    EXPECT_EQ(axis_scale(info, 0).title, "depth [mm]");
    EXPECT_EQ(axis_scale(info, 1).title, "grid_longitude (degrees)") << "a unit of its own";
    EXPECT_EQ(axis_scale(info, 2).title, "z [mm]");
    // The names are of axes of space, whatever the order in which values are stored.
    info.grid.direction =
        glm::dmat3(glm::dvec3(0, 1, 0), glm::dvec3(1, 0, 0), glm::dvec3(0, 0, -1));
    EXPECT_EQ(axis_scale(info, 1).title, "depth [mm]");
}

TEST(Axes, SayHowFarHeightsAreExaggerated) {
    const index::SeriesInfo info = info_of_box();
    const auto titles = [&](double higher) {
        const auto placement = render::Placement::of(
            info.grid, glm::scale(glm::translate(glm::dmat4(1.0), glm::dvec3(0, -4, -2)),
                                  0.05 * glm::dvec3(1, 1, higher)));
        std::string all;
        for (const AxisLabels& labels : axes_for(info, placement, head_at({2, 3.5f, 1})).labels)
            all += labels.title.text + "; ";
        return all;
    };
    EXPECT_EQ(titles(1), "x [mm]; y [mm]; z [mm]; ");
    EXPECT_EQ(titles(2.5), "x [mm]; y [mm]; z [mm], 2.5x; ");
}

TEST(Axes, ThatAreObliqueRunFromTheirFirstVertex) {
    index::SeriesInfo info = info_of_box();
    const double s = std::sqrt(0.5);
    info.grid.direction =
        glm::dmat3(glm::dvec3(s, s, 0), glm::dvec3(-s, s, 0), glm::dvec3(0, 0, 1));
    const AxisScale scale = axis_scale(info, 1);
    EXPECT_EQ(scale.title, "j [mm]");
    EXPECT_EQ(scale.low, 0);
    EXPECT_EQ(scale.high, 20);
}

TEST(Axes, AreLabeledAtTheOutlineOnlyLowAndLeftFirst) {
    const index::SeriesInfo info = info_of_box();
    const render::Placement placement = in_front(info);
    const interaction::Pose head = head_at({0.8f, 2.4f, 0.0f}); // right of the box, above it
    const auto x = labeled_edge(0, placement, head);            // sides of y and z
    const auto y = labeled_edge(1, placement, head);            // sides of z and x
    ASSERT_TRUE(x && y);
    EXPECT_EQ(*x, (EdgeSides{false, true})); // below, in front
    EXPECT_EQ(*y, (EdgeSides{true, false})); // in front, at the left
}

TEST(Axes, AreLabeledWhereOneFaceIsSeenAndTheNextIsNot) {
    const index::SeriesInfo info = info_of_box();
    const render::Placement placement = in_front(info);
    std::mt19937 random(test_seed());
    std::uniform_real_distribution<float> place(-4, 4);
    int inside = 0;
    for (int i = 0; i < 500; ++i) {
        const glm::vec3 position(place(random), place(random), place(random));
        const interaction::Pose head = head_at(position);
        const glm::vec3 eye(glm::inverse(placement.room_from_index) * glm::vec4(position, 1));
        for (int axis = 0; axis < 3; ++axis) {
            const auto sides = labeled_edge(axis, placement, head);
            int seen_sides = 0; // pairs of faces along the axis with one face in view
            for (int k = 1; k <= 2; ++k)
                seen_sides += eye[(axis + k) % 3] < 0 ||
                              eye[(axis + k) % 3] > placement.extent[(axis + k) % 3];
            EXPECT_EQ(sides.has_value(), seen_sides > 0);
            inside += seen_sides == 0;
            if (!sides)
                continue;
            int seen = 0;
            for (int k = 0; k < 2; ++k) {
                const int other = (axis + 1 + k) % 3;
                seen += (*sides)[k] ? eye[other] > placement.extent[other] : eye[other] < 0;
            }
            EXPECT_EQ(seen, 1);
        }
    }
    EXPECT_GT(inside, 0);
}

TEST(Axes, HaveTheirTicksWhereTheNumbersAre) {
    const index::SeriesInfo info = info_of_box();
    const render::Placement placement = in_front(info);
    const Axes axes = axes_for(info, placement, head_at({0.8f, 2.4f, 0.0f}));
    ASSERT_EQ(axes.labels.size(), 3u);
    std::size_t numbers = 0;
    bool found = false;
    for (const AxisLabels& axis : axes.labels)
        for (const auto& [label, multiple] : axis.numbers) {
            ++numbers;
            if (label.text == "-5") { // x alone has negative ones
                found = true;
                EXPECT_NEAR(label.at.x, 2.5, 1e-4);
                EXPECT_EQ(multiple, -1);
            }
        }
    EXPECT_TRUE(found);
    EXPECT_EQ(numbers, axes.ticks.size());
    for (const render::Line& tick : axes.ticks) {
        const glm::vec3 middle = 0.5f * placement.extent;
        EXPECT_GT(glm::length(tick.to - middle), glm::length(tick.from - middle)); // outwards
    }
}

} // namespace
} // namespace isochron::app
