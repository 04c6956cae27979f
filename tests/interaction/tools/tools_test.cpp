// Tools: what hands do with the tool that they hold.
#include "interaction/tools/clip_tool.h"
#include "interaction/tools/ruler_tool.h"
#include "interaction/tools/slice_tool.h"
#include "interaction/tools/tool_table.h"

#include "tests/interaction/controls/control_desk.h"
#include "tests/support/test_seed.h"

#include <glm/gtx/norm.hpp>

#include <algorithm>
#include <cmath>

namespace isochron::interaction {
namespace {

constexpr std::uint64_t kHold = bit(WandButton::grab);

/// A desk whose data have a surface: the plane z = 30 of their physical space.
class ToolDesk : public Desk {
  public:
    ToolDesk() {
        context.find_surface = [this](const Pose& ray) -> std::optional<Pointed> {
            const glm::dvec3 from = physical(volume(), ray.position);
            const glm::dvec3 ahead = glm::dvec3(ray.orientation * glm::vec3(0, 0, -1));
            const glm::dvec3 to = physical(volume(), glm::dvec3(ray.position) + ahead);
            const double along = (30 - from.z) / (to.z - from.z);
            const glm::dvec3 at = from + along * (to - from);
            if (!(along > 0) || at.x < 0 || at.x > 60 || at.y < 0 || at.y > 50)
                return std::nullopt;
            return Pointed{{at, {}, settings.isovalue()}, 0};
        };
    }
    /// A click of the mouse, whose ray goes through a place in the room.
    Commands click(const glm::vec3& at) {
        Commands commands = mouse(at, bit(MouseBit::left));
        merge(commands, mouse(at, 0));
        return commands;
    }
    Commands mouse(const glm::vec3& at, std::uint64_t buttons, float dragged = 0) {
        const glm::quat turn =
            glm::quatLookAt(glm::normalize(at - kStanding.position), glm::vec3(0, 1, 0));
        return frame({head_at(kStanding),
                      {"pointer", Pose{kStanding.position, turn}, true, 0, {}},
                      {"mouse", std::nullopt, true, buttons, {dragged, 0, 0, 0, 0, 0, 0}}});
    }
    glm::vec3 in_room(const glm::dvec3& p) const { return glm::vec3(transform(volume(), p)); }
};

TEST(Tools, TheTableHoldsEachKindOnceInItsOrder) {
    for (std::size_t i = 0; i < tool_table().size(); ++i) {
        EXPECT_EQ(static_cast<std::size_t>(tool_table()[i].kind), i);
        EXPECT_TRUE(tool_table()[i].make());
    }
}

TEST(Tools, KeysChooseThemAndEscapeLeavesThemFirst) {
    ToolDesk desk;
    desk.tap(choice_of(ToolKind::clip));
    EXPECT_EQ(desk.settings.tools.mouse, ToolKind::clip);
    EXPECT_EQ(desk.settings.tools.wand, ToolKind::clip);
    EXPECT_EQ(desk.settings.tools.other, ToolKind::grab);
    const Commands left = desk.tap(bit(Action::quit));
    EXPECT_FALSE(left.leaving);
    EXPECT_EQ(desk.settings.tools, Tools{});
    EXPECT_TRUE(desk.tap(bit(Action::quit)).empty()) << "no question";
}

TEST(Tools, AClickPicksAndADragDoesNot) {
    ToolDesk desk;
    const glm::dvec3 place(20, 10, 30);
    const Commands picked = desk.click(desk.in_room(place));
    ASSERT_TRUE(picked.mark && picked.mark->point);
    expect_near(picked.mark->point->position, place, 1e-3);
    desk.mouse(desk.in_room({40, 40, 30}), bit(MouseBit::left));
    desk.mouse(desk.in_room({40, 40, 30}), bit(MouseBit::left), 0.05f);
    EXPECT_FALSE(desk.mouse(desk.in_room({40, 40, 30}), 0).mark);
    EXPECT_EQ(desk.click({50, 50, -1}).mark, Mark{}) << "a miss takes the mark away";
    EXPECT_FALSE(desk.click({50, 50, -1}).mark) << "where there is none it does nothing";
}

TEST(Tools, AHandThatHoldsAnotherToolDoesNotMoveTheVolume) {
    ToolDesk desk;
    desk.settings.tools.wand = ToolKind::ruler;
    Pose hand{{0, 1.3f, 0}, {1, 0, 0, 0}};
    desk.frame({wand_at(hand, kHold)});
    hand.position.x += 0.1f;
    EXPECT_FALSE(desk.frame({wand_at(hand, kHold)}).room_from_physical);
    desk.frame({wand_at(hand)});
    desk.settings.tools.wand = ToolKind::grab;
    desk.frame({wand_at(hand, kHold)});
    hand.position.x += 0.1f;
    EXPECT_TRUE(desk.frame({wand_at(hand, kHold)}).room_from_physical);
}

TEST(Tools, ADoubleClickBringsThePlaceToTheMiddleOfTheView) {
    ToolDesk desk;
    const glm::dvec3 at(10, 40, 30);
    const double away = glm::distance(transform(desk.volume(), at), glm::dvec3(kStanding.position));
    const Similarity before = desk.volume();
    desk.click(desk.in_room(at));
    EXPECT_EQ(desk.volume(), before) << "one click does not";
    desk.click(desk.in_room(at));
    expect_near(transform(desk.volume(), at),
                glm::dvec3(kStanding.position) + away * glm::dvec3(0, 0, -1), 1e-4);
    EXPECT_EQ(desk.volume().scale, before.scale);
    const Similarity focused = desk.volume();
    for (int frame = 0; frame < 60; ++frame)
        desk.frame({head_at(kStanding)});
    desk.click(desk.in_room({20, 20, 30}));
    for (int frame = 0; frame < 60; ++frame)
        desk.frame({head_at(kStanding)});
    desk.click(desk.in_room({20, 20, 30}));
    EXPECT_EQ(desk.volume(), focused) << "nor do two that are far apart";
}

TEST(Tools, RulersMeasureInTheDataUnitsAndStayBesideTheNextOnes) {
    ToolDesk desk;
    desk.tap(choice_of(ToolKind::ruler));
    EXPECT_EQ(ruler_line(desk.settings), "click two places");
    const glm::dvec3 a(10, 10, 30), b(40, 50, 30), c(40, 10, 30);
    const Rulers& rulers = desk.settings.rulers;
    desk.click(desk.in_room(a));
    EXPECT_EQ(ruler_line(desk.settings), "click the other place");
    ASSERT_EQ(rulers.list.size(), 1u);
    EXPECT_FALSE(rulers.list[0].complete());
    desk.click(desk.in_room(b));
    ASSERT_EQ(rulers.list.size(), 1u);
    ASSERT_TRUE(rulers.list[0].complete());
    const auto labels = [&] {
        std::vector<std::string> words;
        for (const ToolLabel& label : drawing_of(desk.settings, desk.context.data).labels)
            words.push_back(label.text);
        return words;
    };
    EXPECT_EQ(labels(), std::vector<std::string>{"50 mm"});
    desk.tap(bit(Action::ruler_angle));
    for (const glm::dvec3& place : {a, c, b})
        desk.click(desk.in_room(place));
    EXPECT_EQ(labels(), (std::vector<std::string>{"1: 50 mm", "2: 90\u00b0"}));
    desk.tap(bit(Action::ruler_angle));
    desk.click(desk.in_room(a));
    ASSERT_EQ(rulers.list.size(), 3u);
    EXPECT_FALSE(rulers.list[2].angle);
    EXPECT_EQ(rulers.picked, 2u);
    desk.tap(bit(Action::remove_made));
    EXPECT_EQ(rulers.list.size(), 2u);
    EXPECT_EQ(rulers.picked, 1u);
    desk.settings.rulers.list[0].shown = false;
    EXPECT_EQ(labels(), std::vector<std::string>{"2: 90\u00b0"});
    desk.tap(bit(Action::annotations));
    EXPECT_FALSE(rulers.list[1].shown) << "one was seen: all are hidden";
    desk.tap(bit(Action::annotations));
    EXPECT_TRUE(rulers.list[0].shown && rulers.list[1].shown);
}

TEST(Tools, OneRulerTooManyIsNotLaid) {
    ToolDesk desk;
    desk.tap(choice_of(ToolKind::ruler));
    Rulers& rulers = desk.settings.rulers;
    rulers.list.assign(kMostRulers, {.places = {{0, 0, 0}, {1, 0, 0}}});
    desk.click(desk.in_room({10, 10, 30}));
    EXPECT_EQ(rulers.list.size(), kMostRulers);
    rulers.list.back().places.pop_back();
    desk.click(desk.in_room({10, 10, 30}));
    EXPECT_TRUE(rulers.list.back().complete());
}

TEST(Tools, AnAngleIsThatOfItsCosineAndExactWhereThatIsNot) {
    Random random(test_seed());
    const auto place = [&] {
        return glm::dvec3(uniform(random, -9, 9), uniform(random, -9, 9), uniform(random, -9, 9));
    };
    for (int round = 0; round < 100; ++round) {
        const glm::dvec3 a = place(), b = place(), c = place();
        const double cosine = glm::dot(glm::normalize(a - b), glm::normalize(c - b));
        EXPECT_NEAR(measured({.places = {a, b, c}, .angle = true}).value(),
                    glm::degrees(std::acos(cosine)), 1e-5);
    }
    const double tiny = glm::degrees(1e-9);
    EXPECT_NEAR(measured({.places = {{1, 0, 0}, {}, {1, 1e-9, 0}}, .angle = true}).value(), tiny,
                1e-9 * tiny);
    EXPECT_FALSE(measured({.places = {{}, {}, {1, 0, 0}}, .angle = true}));
}

TEST(Tools, AHiddenSliceIsNeitherDrawnNorHeld) {
    ToolDesk desk;
    desk.tap(choice_of(ToolKind::slice));
    desk.settings.slices.planes = {{{30, 25, 30}, {0, 0, 1}, false}};
    const Slices before = desk.settings.slices;
    EXPECT_TRUE(drawing_of(desk.settings, desk.context.data).lines.empty());
    EXPECT_FALSE(before.hides_surfaces());
    desk.click(desk.in_room({30, 25, 30}));
    ASSERT_EQ(desk.settings.slices.planes.size(), 2u) << "another one is laid beside it";
    EXPECT_EQ(desk.settings.slices.planes[0], before.planes[0]);
    EXPECT_EQ(desk.settings.slices.picked, 1u);
}

TEST(Tools, AClipPlaneGoesWithTheHandThatHoldsIt) {
    Random random(test_seed());
    for (int round = 0; round < 100; ++round) {
        ToolDesk desk;
        desk.settings.room_from_physical.exaggeration = round % 2 ? 1.0 : 3.0;
        desk.settings.tools.wand = ToolKind::clip;
        desk.settings.clip = {true, {30, 25, 30}, {0, 0, 1}};
        const Pose before{{0.1f, 1.2f, -0.3f}, random_rotation(random)};
        const Pose after{{-0.2f, 1.5f, -0.1f}, random_rotation(random)};
        desk.frame({wand_at(before, kHold)});
        desk.frame({wand_at(after, kHold)});
        // In the hand's own frame the plane has stayed.
        const auto seen = [&](const Pose& hand, const ClipPlane& plane) {
            const glm::dquat into = glm::conjugate(glm::dquat(hand.orientation));
            const glm::dvec3 at =
                into * (transform(desk.volume(), plane.point) - glm::dvec3(hand.position));
            return std::pair(at, into * normal_in_room(desk.volume(), plane.normal));
        };
        const auto [place, normal] = seen(before, {true, {30, 25, 30}, {0, 0, 1}});
        const auto [now_at, now_normal] = seen(after, desk.settings.clip);
        expect_near(now_at, place, 1e-5);
        expect_near(now_normal, normal, 1e-5);
    }
}

TEST(Tools, TheMousePullsTheClipPlaneUnderItsRayAndTurnsNothing) {
    ToolDesk desk;
    desk.settings.tools.mouse = ToolKind::clip;
    // A plane that faces to the right and upwards, so that its normal can be seen.
    desk.settings.clip = {true, {30, 25, 30}, glm::normalize(glm::dvec3(1, 0.4, 0.6))};
    const glm::dvec3 normal = desk.settings.clip.normal;
    const glm::dvec3 to = glm::dvec3(30, 25, 30) + 8.0 * normal;
    desk.mouse(desk.in_room({30, 25, 30}), bit(MouseBit::left));
    const Commands pulled = desk.mouse(desk.in_room(to), bit(MouseBit::left), 0.1f);
    EXPECT_FALSE(pulled.room_from_physical) << "the drag is the plane's";
    ASSERT_TRUE(pulled.clip);
    EXPECT_NEAR(glm::dot(pulled.clip->point - glm::dvec3(30, 25, 30), normal), 8.0, 1e-3);
    EXPECT_EQ(pulled.clip->normal, normal);
}

TEST(Tools, AClipPlaneThatFacesTheUserMovesAwayAsTheMouseMovesUp) {
    for (const double side : {1.0, -1.0}) {
        ToolDesk desk;
        desk.settings.tools.mouse = ToolKind::clip;
        const glm::dvec3 at(30, 25, 30);
        const glm::dvec3 eye = in_physical(desk.volume(), glm::dvec3(kStanding.position));
        const glm::dvec3 away = glm::normalize(at - eye);
        desk.settings.clip = {true, at, side * away};
        desk.mouse(desk.in_room(at), bit(MouseBit::left));
        const glm::dvec3 up(0, 6, 0);
        const Commands pulled = desk.mouse(desk.in_room(at + up), bit(MouseBit::left), 0.1f);
        EXPECT_FALSE(pulled.room_from_physical) << "the drag is the plane's";
        ASSERT_TRUE(pulled.clip);
        const double moved = glm::dot(pulled.clip->point - at, away);
        EXPECT_GT(moved, 4);
        EXPECT_LT(moved, 8);
        expect_near(pulled.clip->point, at + moved * away, 1e-4);
        expect_near(pulled.clip->normal, side * away);
        const Commands back = desk.mouse(desk.in_room(at), bit(MouseBit::left), 0.1f);
        ASSERT_TRUE(back.clip);
        expect_near(back.clip->point, at, 1e-3);
    }
}

TEST(Tools, AClipPlaneIsTurnedToCutAwayTheOtherSide) {
    ToolDesk desk;
    EXPECT_TRUE(desk.tap(Action::flip_clip).empty()) << "there is none";
    desk.settings.clip = {true, {30, 25, 30}, {0, 0.6, 0.8}};
    EXPECT_EQ(desk.tap(Action::flip_clip).clip, (ClipPlane{true, {30, 25, 30}, {0, -0.6, -0.8}}));
}

TEST(Tools, AClipPlaneIsUnderTheMouseWhereHeightsAreExaggerated) {
    ToolDesk desk;
    desk.settings.room_from_physical =
        exaggerated(desk.settings.room_from_physical, desk.context.series.pivot, 2.5);
    desk.settings.tools.mouse = ToolKind::clip;
    const glm::dvec3 point(30, 25, 30);
    desk.settings.clip = {true, point, glm::normalize(glm::dvec3(1, 0.4, 0.6))};
    const Similarity& room = desk.settings.room_from_physical;
    const glm::dvec3 normal = normal_in_room(room, desk.settings.clip.normal);
    const glm::dvec3 to = in_physical(room, transform(room, point) + 0.05 * normal);
    desk.mouse(desk.in_room(point), bit(MouseBit::left));
    const Commands pulled = desk.mouse(desk.in_room(to), bit(MouseBit::left), 0.1f);
    ASSERT_TRUE(pulled.clip);
    EXPECT_NEAR(glm::dot(transform(room, pulled.clip->point) - transform(room, point), normal),
                0.05, 1e-5);
}

TEST(Tools, AClipPlaneSnapsToTheAxesInTurn) {
    ToolDesk desk;
    for (const int axis : {0, 1, 2, 0}) {
        desk.tap(bit(Action::snap_clip));
        EXPECT_TRUE(desk.settings.clip.shown);
        glm::dvec3 expected(0.0);
        expected[axis] = 1;
        expect_near(desk.settings.clip.normal, expected);
    }
    const ClipPlane other = snapped(desk.settings.clip, 0, desk.context.data);
    expect_near(other.normal, {-1, 0, 0});
}

TEST(Tools, TheOutlineOfAClipPlaneLiesOnThePlaneAndOnTheBox) {
    Random random(test_seed());
    ToolDesk desk;
    const DataFrame& data = desk.context.data;
    for (int round = 0; round < 200; ++round) {
        const glm::dvec3 normal(random_rotation(random) * glm::vec3(0, 0, 1));
        const ClipPlane plane{true, data.at({uniform(random, 0.1, 0.9), 0.5, 0.5}),
                              glm::normalize(normal)};
        const auto corners = outline({plane.point, plane.normal}, data);
        ASSERT_GE(corners.size(), 3u);
        EXPECT_LE(corners.size(), 6u);
        for (const glm::dvec3& corner : corners) {
            EXPECT_NEAR(glm::dot(corner - plane.point, plane.normal), 0.0, 1e-9);
            const glm::dvec3 in_box = data.in_box(corner);
            int on_faces = 0;
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_TRUE(in_box[axis] > -1e-9 && in_box[axis] < 1 + 1e-9);
                on_faces += std::min(std::abs(in_box[axis]), std::abs(in_box[axis] - 1)) < 1e-9;
            }
            EXPECT_GE(on_faces, 2);
        }
    }
}

/// A desk whose data are 60 x 50 x 60 cells of 1 mm; along z they are uneven if so asked.
class SliceDesk : public ToolDesk {
  public:
    SliceDesk() {
        context.data.cells = {60, 50, 4};
        settings.tools.mouse = settings.tools.wand = ToolKind::slice;
    }
    const Plane& slice(std::size_t i = 0) const { return settings.slices.planes.at(i); }
    std::vector<double> uneven{0, 1, 5, 30, 60};
};

TEST(Tools, AClickLaysASliceAcrossTheAxisThatIsNearestToTheRayAndADragPullsIt) {
    SliceDesk desk;
    desk.click(desk.in_room({20, 10, 30}));
    ASSERT_EQ(desk.settings.slices.planes.size(), 1u);
    expect_near(desk.slice().normal, {0, 0, 1});
    expect_near(desk.slice().point, {20, 10, 30}, 1e-3);
    const glm::dvec3 at = desk.slice().point;
    desk.mouse(desk.in_room(at), bit(MouseBit::left));
    desk.mouse(desk.in_room(at) + glm::vec3(0, 0.03f, 0), bit(MouseBit::left), 0.1f);
    EXPECT_GT(std::abs(desk.slice().point.z - at.z), 0.5) << "it faces the user";
    expect_near(desk.slice().normal, {0, 0, 1});
    expect_near({desk.slice().point.x, desk.slice().point.y, 0}, {at.x, at.y, 0});
    desk.mouse(desk.in_room(at), 0);
    EXPECT_EQ(desk.settings.slices.planes.size(), 1u);
}

TEST(Tools, TheMouseTurnsASliceThatItHoldsNearItsOutline) {
    SliceDesk desk;
    desk.settings.slices.planes = {{{20, 10, 30}, {0, 0, 1}}};
    const glm::dvec3 middle(30, 25, 30);
    const glm::vec3 rim = desk.in_room({57, 25, 30});
    desk.mouse(rim, bit(MouseBit::left));
    EXPECT_EQ(desk.slice().normal, glm::dvec3(0, 0, 1)) << "nothing jumps as the button goes down";
    // Towards the middle: the point that was hit goes along the sphere about the middle.
    const glm::vec3 nearer = glm::mix(rim, desk.in_room(middle), 0.4f);
    desk.mouse(nearer, bit(MouseBit::left), 0.1f);
    const Plane turned = desk.slice();
    EXPECT_LT(std::abs(turned.normal.z), 0.95);
    EXPECT_NEAR(turned.normal.y, 0, 0.01);
    EXPECT_NEAR(glm::length(turned.normal), 1, 1e-12);
    EXPECT_NEAR(glm::dot(turned.point - middle, turned.normal), 0, 1e-6) << "about its middle";
    desk.mouse(rim, bit(MouseBit::left), 0.2f);
    EXPECT_NEAR(desk.slice().normal.z, 1, 1e-6) << "and back";
    expect_near(desk.slice().point, {20, 10, 30}, 1e-4);
}

TEST(Tools, AHandTurnsTheSliceThatItPointsAtAndPicksIt) {
    SliceDesk desk;
    desk.settings.slices = with_slice(with_slice({}, desk.context.data), desk.context.data);
    expect_near(desk.slice(0).normal, {0, 0, 1});
    expect_near(desk.slice(1).normal, {0, 1, 0});
    ASSERT_EQ(desk.settings.slices.picked, 1u);
    const glm::vec3 target = desk.in_room({10, 20, 30});
    Pose hand{target + glm::vec3(0, 0, 0.5f), {1, 0, 0, 0}}; // towards -z of the room
    desk.frame({wand_at(hand)});
    desk.frame({wand_at(hand, kHold)});
    EXPECT_EQ(desk.settings.slices.picked, 0u);
    const Plane other = desk.slice(1);
    hand.orientation = glm::angleAxis(glm::radians(30.0f), glm::vec3(0, 1, 0));
    desk.frame({wand_at(hand, kHold)});
    EXPECT_NEAR(std::abs(desk.slice(0).normal.z), std::cos(glm::radians(30.0)), 1e-5);
    EXPECT_EQ(desk.slice(1), other);
}

TEST(Tools, ASliceStepsFromVertexToVertexWithinTheDataAndObliqueOnesByACell) {
    SliceDesk desk;
    desk.context.data.distances[2] = &desk.uneven;
    desk.settings.slices.planes = {{{30, 25, 4}, {0, 0, -1}}};
    for (const double expected : {1.0, 0.0, 0.0}) { // the normal points down
        desk.tap(bit(Action::slice_forward));
        EXPECT_NEAR(desk.slice().point.z, expected, 1e-9);
    }
    for (const double expected : {1.0, 5.0, 30.0, 60.0, 60.0}) {
        desk.tap(bit(Action::slice_back));
        EXPECT_NEAR(desk.slice().point.z, expected, 1e-9);
    }
    const glm::dvec3 oblique = glm::normalize(glm::dvec3(1, 0.2, 0));
    desk.settings.slices.planes = {{{30, 25, 30}, oblique}};
    desk.tap(bit(Action::slice_forward));
    // By 1 mm along x, at the same y: one cell along the axis that it is most across.
    EXPECT_NEAR(glm::dot(desk.slice().point - glm::dvec3(31, 25, 30), oblique), 0, 1e-9);
}

TEST(Tools, AFaceOfTheClipBoxIsDraggedAndItsPlanesCutWhatIsOutside) {
    SliceDesk desk;
    desk.settings.tools.mouse = ToolKind::clip;
    desk.settings.clip_box = {true, {10, 5, 1}, {50, 45, 3}};
    desk.context.data.distances[2] = &desk.uneven; // vertex 3 lies at 30
    const auto planes = cutting_planes(desk.settings, desk.context.data);
    ASSERT_EQ(planes.size(), 6u);
    const auto is_cut = [&](const glm::dvec3& at) {
        return std::ranges::any_of(planes, [&](const auto& cut) { return cut.beyond(at) > 0; });
    };
    EXPECT_FALSE(is_cut({10.1, 5.1, 1.1}) || is_cut({49.9, 44.9, 29.9}));
    for (const glm::dvec3 outside : {glm::dvec3(9.9, 20, 20),
                                     {50.1, 20, 20},
                                     {20, 4.9, 20},
                                     {20, 45.1, 20},
                                     {20, 20, 0.9},
                                     {20, 20, 30.1}})
        EXPECT_TRUE(is_cut(outside)) << outside.x << ' ' << outside.y << ' ' << outside.z;
    const glm::vec3 on_face = desk.in_room({30, 25, 30});
    desk.mouse(on_face, bit(MouseBit::left));
    desk.mouse(on_face + glm::vec3(0, 0.02f, 0), bit(MouseBit::left), 0.1f);
    const ClipBox moved = desk.settings.clip_box;
    EXPECT_NE(moved.high.z, 3);
    EXPECT_EQ(moved.low, glm::dvec3(10, 5, 1));
    EXPECT_FALSE(desk.settings.clip.shown);
    desk.mouse(on_face, 0);
    EXPECT_FALSE(desk.settings.clip.shown) << "a click on the box lays no plane";
    desk.tap(bit(Action::remove_made));
    EXPECT_FALSE(desk.settings.clip_box.shown);
}

} // namespace
} // namespace isochron::interaction
