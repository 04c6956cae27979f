// Curves are made in the background: in which order, what stops them, and that their numbers are
// those of `isochron measure`.
#include "app/session/curve_maker.h"

#include "index/error.h"
#include "index/indexing/index_build.h"
#include "index/measure/measures.h"
#include "tests/support/indexed.h"
#include "tests/support/memory_series.h"
#include "tests/support/test_field.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <semaphore>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace isochron::app {
namespace {

using index::Instant;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::size_t kSteps = 9;

class CurveMakerTest : public testing::Test {
  protected:
    CurveMakerTest() {
        std::mt19937 random{test_seed()};
        const index::TestField field({9, 8, 7}, kSteps, index::ValueType::f32,
                                     index::turbulence(random));
        file_ = index::indexed(folder_, field.view());
    }
    CurveSubject surface(double isovalue) const { return {.array = file_, .isovalue = isovalue}; }

    /// Remembers what it has measured: isovalue and step.
    CurveMaker::Measure fake() {
        return [this](const CurveSubject& subject, std::uint32_t step, const std::stop_token&) {
            measured_.emplace_back(subject.isovalue, step);
            return std::optional(std::vector(numbers_of(subject), subject.isovalue + step));
        };
    }
    std::vector<std::uint32_t> steps() const {
        std::vector<std::uint32_t> all;
        for (const auto& [isovalue, step] : measured_)
            all.push_back(step);
        return all;
    }
    static WantedCurves all_of(std::vector<CurveSubject> subjects, std::uint32_t now = 0) {
        WantedCurves wanted;
        wanted.subjects = std::move(subjects);
        wanted.now = now;
        return wanted;
    }

    test_support::TestFolder folder_;
    std::shared_ptr<const index::IndexFile> file_;
    std::vector<std::pair<double, std::uint32_t>> measured_;
};

TEST_F(CurveMakerTest, BeginsWithTheShownStepAndTheStepsAtHand) {
    CurveMaker maker(fake());
    WantedCurves wanted = all_of({surface(1)}, 4);
    wanted.at_hand = {8, 1};
    maker.update(wanted);
    maker.finish();
    EXPECT_THAT(steps(), ElementsAre(4, 1, 8, 5, 3, 6, 2, 7, 0));
    const StepCurvePtr curve = maker.curves().at(0);
    EXPECT_EQ(curve->left, 0u);
    EXPECT_EQ(curve->values[0][3], 4.0);
}

TEST_F(CurveMakerTest, BeginsNothingWhileThePictureComesFirst) {
    CurveMaker maker(fake());
    WantedCurves wanted = all_of({surface(1)});
    wanted.paused = true;
    maker.update(wanted);
    maker.finish();
    EXPECT_THAT(measured_, IsEmpty());
    wanted.paused = false;
    maker.update(wanted);
    maker.finish();
    EXPECT_EQ(measured_.size(), kSteps);
}

/// A measure that ends for one isovalue only when it is stopped.
struct Blocking {
    std::binary_semaphore begun{0};

    CurveMaker::Measure measure(double endless) {
        return [this, endless](const CurveSubject& subject, std::uint32_t,
                               const std::stop_token& stop) -> std::optional<std::vector<double>> {
            if (subject.isovalue != endless)
                return std::vector(numbers_of(subject), subject.isovalue);
            begun.release();
            std::mutex mutex;
            std::unique_lock lock(mutex);
            std::condition_variable_any never;
            never.wait(lock, stop, [] { return false; });
            return std::nullopt;
        };
    }
};

TEST_F(CurveMakerTest, GivesTheStepUpWhenTheSurfaceChanges) {
    Blocking blocking;
    CurveMaker maker(blocking.measure(1));
    maker.update(all_of({surface(1)}));
    blocking.begun.acquire();
    maker.update(all_of({surface(2)}));
    maker.finish();
    ASSERT_EQ(maker.curves().size(), 1u);
    EXPECT_EQ(maker.curves()[0]->subject.isovalue, 2);
    EXPECT_EQ(maker.curves()[0]->left, 0u);
}

TEST_F(CurveMakerTest, StopsWhenNothingIsWanted) {
    Blocking blocking;
    CurveMaker maker(blocking.measure(1));
    maker.update(all_of({surface(1)}));
    blocking.begun.acquire();
    maker.update({});
    maker.finish();
    EXPECT_THAT(maker.curves(), IsEmpty());
    maker.update(all_of({surface(1)})); // its end stops this one
    blocking.begun.acquire();
}

TEST_F(CurveMakerTest, KeepsWhatIsKnownOfSurfacesThatStay) {
    CurveMaker maker(fake());
    maker.update(all_of({surface(1), surface(2)}));
    maker.finish();
    const StepCurvePtr before = maker.curves().at(1);
    measured_.clear();
    maker.update(all_of({surface(2), surface(3)}));
    maker.finish();
    EXPECT_EQ(maker.curves().at(0)->values, before->values);
    for (const auto& [isovalue, step] : measured_)
        EXPECT_EQ(isovalue, 3) << step;
    EXPECT_EQ(measured_.size(), kSteps);
}

TEST_F(CurveMakerTest, LeavesAStepOutThatCannotBeMeasured) {
    CurveMaker maker([](const CurveSubject& subject, std::uint32_t step, const std::stop_token&) {
        if (step == 3)
            throw index::Error("step 3 is damaged");
        return std::optional(std::vector(numbers_of(subject), 1.0));
    });
    maker.keep_in(KeptCurves(folder_.path() / "kept"));
    maker.update(all_of({surface(1)}));
    maker.finish();
    EXPECT_EQ(maker.failure(), "step 3 is damaged");
    EXPECT_EQ(maker.curves().at(0)->left, 0u);
    EXPECT_TRUE(std::isnan(maker.curves()[0]->values[0][3]));
    EXPECT_EQ(maker.curves()[0]->values[0][4], 1.0);
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "kept")) << "only whole ones are kept";
}

TEST_F(CurveMakerTest, HasTheNumbersOfIsochronMeasure) {
    CurveMaker maker(measured_in_index());
    CurveSubject cut = surface(0.05);
    cut.clip = interaction::ClipPlane{true, {4, 3, 3}, {0.6, 0, 0.8}};
    const CurveSubject place{.array = file_, .place = glm::dvec3(3, 4, 2)};
    CurveSubject boxed = surface(-0.1);
    boxed.box = index::VertexBox{{1, 2, 0}, {6, 7, 4}};
    boxed.from = glm::dvec3(3, 4, 2);
    maker.update(all_of({surface(0.05), cut, surface(-0.1), place, boxed}, 2));
    maker.finish();
    const std::vector<StepCurvePtr> curves = maker.curves();
    index::SurfaceMeasures measuring(file_);
    for (std::uint32_t step = 0; step < kSteps; ++step)
        for (const StepCurvePtr& curve : {curves[0], curves[1], curves[2], curves[4]}) {
            index::MeasureWishes wishes;
            if (curve == curves[4])
                wishes = {.box = {{{1, 2, 0}, {6, 7, 4}}}, .from = {{3, 4, 2}}};
            if (curve->subject.clip)
                wishes.clip = {{4, 3, 3}, {0.6, 0, 0.8}};
            const auto expected =
                measuring.measure({Instant(step), curve->subject.isovalue}, wishes)->values;
            for (std::size_t i = 0; i < expected.size(); ++i)
                if (!is_measured(index::measures()[i], false, wishes.from.has_value()))
                    EXPECT_TRUE(std::isnan(curve->values[i][step]));
                else
                    EXPECT_EQ(curve->values[i][step], expected[i]) << index::measures()[i].name;
        }
    const auto stored = file_->values().step<float>(5);
    EXPECT_EQ(curves[3]->values[0][5], double{stored[3 + 9 * (4 + 8 * 2)]});
    EXPECT_NE(curves[0]->values[1], curves[1]->values[1]) << "the clip plane cuts it";
    EXPECT_NE(curves[2]->values[1], curves[4]->values[1]) << "the box leaves some out";

    std::istringstream table(csv_of({curves[0], curves[2]}));
    std::string line;
    std::getline(table, line);
    EXPECT_EQ(line,
              "step,fraction,time,isovalue,cells,area,volume,volume-below,pieces,bodies,euler,"
              "border-edges");
    std::getline(table, line);
    std::getline(table, line); // the other surface
    EXPECT_THAT(line, HasSubstr("0,0,0,-0.1,"));
    std::istringstream fields(line);
    std::vector<std::string> all;
    for (std::string field; std::getline(fields, field, ',');)
        all.push_back(field);
    ASSERT_EQ(all.size(), 12u);
    EXPECT_EQ(std::stod(all[5]), curves[2]->values[1][0]) << "all digits of the area";
}

TEST(CurveTables, HaveNamesOfFilesThatCommandNoSpreadsheet) {
    const test_support::TestFolder folder;
    const index::TestField field({3, 3, 3}, 1, index::ValueType::f32,
                                 [](double x, double, double, double) { return x; });
    std::vector<StepCurvePtr> curves;
    for (const char* name : {"=1+1,\n\"2\"", "plain"}) {
        index::MemorySeries series(field.view());
        series.info().array = name;
        StepCurve curve({index::build_index(series, folder.path() / "a.isochron", {})}, 20, 1);
        curve.set(0, std::vector<double>(20, 1.0));
        curves.push_back(std::make_shared<const StepCurve>(std::move(curve)));
    }
    EXPECT_THAT(csv_of(curves), HasSubstr("\n\"'=1+1,\\n\"\"2\"\"\",0,0,0,"));
    EXPECT_THAT(csv_of(curves), HasSubstr("\nplain,0,0,0,"));
}

class KeptCurvesTest : public CurveMakerTest {
  protected:
    std::filesystem::path kept() const { return folder_.path() / "cache" / "curves"; }
    /// Makes the curve, or has it. @return its area
    std::vector<double> made(const KeptCurves& folder, double isovalue) {
        measured_.clear();
        CurveMaker maker(fake());
        maker.keep_in(folder);
        maker.update(all_of({surface(isovalue)}));
        maker.finish();
        return maker.curves().at(0)->values[1];
    }
};

TEST_F(KeptCurvesTest, AreHadAgainUnlessTheirFileIsDamagedOrOfAnother) {
    const KeptCurves folder(kept());
    const std::vector<double> area = made(folder, 1);
    EXPECT_EQ(measured_.size(), kSteps);
    EXPECT_EQ(made(folder, 1), area);
    EXPECT_THAT(measured_, IsEmpty()) << "it was kept";
    made(folder, 2);
    EXPECT_EQ(measured_.size(), kSteps) << "another isovalue is another curve";

    const auto path = folder.path_of(surface(1));
    std::ifstream in(path, std::ios::binary);
    const std::string whole(std::istreambuf_iterator<char>(in), {});
    const auto write = [&](const std::string& bytes) {
        std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
    };
    for (std::size_t at = 0; at < whole.size(); at += at < 32 ? 1 : 37) {
        std::string damaged = whole;
        damaged[at] = static_cast<char>(damaged[at] ^ 4);
        write(damaged);
        EXPECT_FALSE(folder.read(surface(1))) << "byte " << at;
    }
    for (const std::string& foreign :
         {std::string(), whole + "x", whole.substr(0, 100), std::string("not a curve")}) {
        write(foreign);
        EXPECT_FALSE(folder.read(surface(1)));
    }
    std::filesystem::copy_file(folder.path_of(surface(2)), path,
                               std::filesystem::copy_options::overwrite_existing);
    EXPECT_FALSE(folder.read(surface(1))) << "another one's under its name";
    EXPECT_EQ(made(folder, 1), area);
    EXPECT_EQ(measured_.size(), kSteps) << "made anew";
    EXPECT_TRUE(folder.read(surface(1)));
}

TEST_F(KeptCurvesTest, AreAtMostSoMany) {
    const KeptCurves three(kept(), 3);
    std::filesystem::create_directories(kept());
    std::ofstream(kept() / "mine.txt") << "stays";
    for (int i = 0; i < 6; ++i)
        made(three, i);
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(kept()))
        files += entry.path().extension() == ".curve";
    EXPECT_EQ(files, 3u);
    EXPECT_TRUE(three.read(surface(5))) << "the newest";
    EXPECT_TRUE(std::filesystem::exists(kept() / "mine.txt"));

    const auto bytes = std::filesystem::file_size(three.path_of(surface(5)));
    const KeptCurves two(kept(), 100, 2 * bytes);
    made(two, 9);
    files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(kept()))
        files += entry.path().extension() == ".curve";
    EXPECT_EQ(files, 2u);
}

TEST_F(KeptCurvesTest, AreNoneWhereTheFolderCannotBeWritten) {
    std::ofstream(folder_.path() / "file") << "no folder";
    const KeptCurves folder(folder_.path() / "file" / "curves");
    EXPECT_EQ(made(folder, 1).size(), kSteps);
    EXPECT_FALSE(folder.read(surface(1)));
}

} // namespace
} // namespace isochron::app
