#include "compare/truth.h"
#include "support/measured_scenes.h"
#include "vcarve/error.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace vcarve::truth_test {
namespace {

using testing::few_samples;
using testing::high_centers;
using testing::scene_above_square;
using testing::square;
using testing::strip;

/// Four standard deviations of a fraction of 20,000 random samples, at most.
constexpr double kFourDeviations = 0.0142;

Reference reference_of(const TriMesh& truth, const std::vector<Eigen::Vector3d>& centers)
{
    const NamedMesh named{"gt.ply", truth};
    return make_reference(scene_above_square(11, centers), &named, few_samples());
}

TruthFigures figures_of(const TriMesh& mesh, const Reference& reference)
{
    return measure_against_truth(place_mesh({"a.ply", mesh}, reference), reference);
}

TEST(Truth, AgreesWithItself)
{
    const Reference reference = reference_of(square(), high_centers());
    const TruthFigures figures = figures_of(square(), reference);
    for (const Agreement& agreement : figures.agreements) {
        EXPECT_EQ(agreement.precision, 1.0);
        EXPECT_EQ(agreement.recall, 1.0);
        EXPECT_EQ(agreement.f_score, 1.0);
    }
    EXPECT_NEAR(figures.mean_accuracy, 0.0, 1e-15);
    EXPECT_NEAR(figures.mean_completeness, 0.0, 1e-15);
    EXPECT_EQ(figures.blocked, 0.0);
}

TEST(Truth, MeasuresAShiftAlongTheNormal)
{
    const Reference reference = reference_of(square(), high_centers());
    const double height = 0.004 * std::numbers::sqrt2;
    const TruthFigures figures = figures_of(square(height), reference);
    EXPECT_EQ(figures.agreements[1].precision, 0.0);
    EXPECT_EQ(figures.agreements[1].recall, 0.0);
    EXPECT_EQ(figures.agreements[1].f_score, 0.0);
    EXPECT_EQ(figures.agreements[2].precision, 1.0);
    EXPECT_EQ(figures.agreements[2].recall, 1.0);
    // The samples do not quite reach the corners, so the diagonal is slightly short.
    EXPECT_NEAR(figures.mean_accuracy, 0.004, 4e-5);
    EXPECT_NEAR(figures.mean_completeness, 0.004, 4e-5);
}

TEST(Truth, MeasuresAShiftAlongTheSurface)
{
    const Reference reference = reference_of(square(), high_centers());
    const TruthFigures figures = figures_of(strip(0.2, 1.2, 0.0), reference);
    for (std::size_t i = 0; i < kTolerances.size(); ++i) {
        // All but the strip beyond the other surface is within tolerance.
        const double overlap = 0.8 + kTolerances[i] * std::numbers::sqrt2;
        EXPECT_NEAR(figures.agreements[i].precision, overlap, kFourDeviations);
        EXPECT_NEAR(figures.agreements[i].recall, overlap, kFourDeviations);
        EXPECT_NEAR(figures.agreements[i].f_score, overlap, kFourDeviations);
    }
    // 20 % of the area is 0.1 away on average.
    EXPECT_NEAR(figures.mean_accuracy, 0.02 / std::numbers::sqrt2, 3e-4);
}

TEST(Truth, DistinguishesPrecisionAndRecall)
{
    const Reference reference = reference_of(square(), high_centers());
    const TruthFigures half = figures_of(strip(0.0, 0.5, 0.0), reference);
    EXPECT_EQ(half.agreements[3].precision, 1.0);
    EXPECT_NEAR(half.agreements[3].recall, 0.5 + 0.01 * std::numbers::sqrt2, kFourDeviations);
    const double recall = half.agreements[3].recall;
    EXPECT_DOUBLE_EQ(half.agreements[3].f_score, 2.0 * recall / (1.0 + recall));
}

/// A roof with `count` ridges over a part of the square. Each flank rises by `rise`.
TriMesh ridges(double from, double to, int count, double rise)
{
    TriMesh mesh;
    const double step = (to - from) / (2.0 * count);
    for (int i = 0; i <= 2 * count; ++i) {
        const double x = from + i * step;
        const double z = i % 2 == 0 ? 0.0 : rise;
        mesh.positions.emplace_back(x, 0.0, z);
        mesh.positions.emplace_back(x, 1.0, z);
        if (i == 0) continue;
        const auto last = static_cast<std::uint32_t>(2 * i);
        mesh.faces.push_back({last - 2, last, last + 1});
        mesh.faces.push_back({last - 2, last + 1, last - 1});
    }
    return mesh;
}

TEST(Truth, MeasuresAnglesBetweenNormals)
{
    const Reference reference = reference_of(square(), high_centers());
    const NormalFigures flat = *figures_of(square(0.004), reference).normals;
    EXPECT_EQ(flat.median_deg, 0.0);
    EXPECT_EQ(flat.most_deg, 0.0);
    // The flanks have a slope of 1 in 10.
    const double slope = std::atan(0.1) * 180.0 / std::numbers::pi;
    const TriMesh third = testing::together(strip(0.0, 0.7, 0.0), ridges(0.7, 1.0, 3, 0.005));
    const NormalFigures some = *figures_of(third, reference).normals;
    EXPECT_EQ(some.median_deg, 0.0);
    EXPECT_NEAR(some.most_deg, slope, 1e-9);
    TriMesh inverted = ridges(0.0, 1.0, 10, 0.005);
    for (Face& face : inverted.faces) {
        std::swap(face[0], face[1]);
    }
    EXPECT_NEAR(figures_of(inverted, reference).normals->median_deg, slope, 1e-9);
}

TEST(Truth, ComparesNormalsOnlyNearTheTruth)
{
    const Reference reference = reference_of(square(), high_centers());
    // Two samples in three are too far away.
    const TriMesh far =
        testing::together(square(), testing::together(ridges(0.0, 1.0, 2, 0.3), square(0.4)));
    EXPECT_EQ(figures_of(far, reference).normals->median_deg, 0.0);
    EXPECT_FALSE(figures_of(square(0.4), reference).normals);
}

/// Four views so high that their lines are vertical.
std::vector<Eigen::Vector3d> upright_centers()
{
    std::vector<Eigen::Vector3d> centers = high_centers();
    for (Eigen::Vector3d& center : centers) {
        center.z() = 1e6;
    }
    return centers;
}

TEST(Truth, CountsBlockedLines)
{
    // A screen is above a quarter of the square.
    const Reference reference = reference_of(square(), upright_centers());
    const TriMesh screened = testing::together(square(), strip(0.0, 0.25, 0.5));
    EXPECT_NEAR(figures_of(screened, reference).blocked, 0.25, kFourDeviations);
    // A screen nearer than 1 % of the diagonal is not a hit.
    const TriMesh skin = testing::together(square(), strip(0.0, 0.25, 0.01));
    EXPECT_EQ(figures_of(skin, reference).blocked, 0.0);
    const TriMesh farther = testing::together(square(), strip(0.0, 0.25, 0.015));
    EXPECT_NEAR(figures_of(farther, reference).blocked, 0.25, kFourDeviations);
}

TEST(Truth, CountsOnlySamplesThatThreeViewsSee)
{
    const TriMesh stacked = testing::together(square(), square(-0.5));
    const Reference reference = reference_of(stacked, high_centers());
    // Every line from the lower square to a view passes through the upper one.
    EXPECT_NEAR(reference.truth->seen_share, 0.5, 1e-4);
    EXPECT_GE(reference.truth->samples.size(), 20000U);
    for (const Eigen::Vector3d& sample : reference.truth->samples) {
        ASSERT_EQ(sample.z(), 0.0);
    }
}

TEST(Truth, IsSeenFromEitherSide)
{
    const Reference reference = reference_of(testing::flipped(square()), high_centers());
    EXPECT_EQ(reference.truth->seen_share, 1.0);
}

TEST(Truth, IgnoresGrazingViews)
{
    // Two views above, and two 100 to 200 away at a height of 1: at least 89 degrees from the
    // normal.
    std::vector<Eigen::Vector3d> centers = {
        {0.2, 0.2, 10}, {0.8, 0.2, 10}, {100, 0, 1}, {0, 200, 1}};
    EXPECT_THAT(
        [&] { reference_of(square(), centers); },
        ::testing::ThrowsMessage<InputError>(
            "gt.ply: less than a thousandth of the true surface is visible from 3 or more of the "
            "model's 4 views, so meshes cannot be compared with it"));
    centers[2] = {0.5, 0.5, 1.0};
    EXPECT_EQ(reference_of(square(), centers).truth->seen_share, 1.0);
}

TEST(Truth, PicksASeeingViewAtRandom)
{
    const Reference reference = reference_of(square(), high_centers());
    const auto samples = static_cast<double>(reference.truth->samples.size());
    for (const std::uint32_t view : {0U, 1U, 2U, 3U}) {
        const auto count = std::ranges::count(reference.truth->views, view);
        EXPECT_NEAR(static_cast<double>(count) / samples, 0.25, kFourDeviations);
    }
}

LineFigures lines_of(const TriMesh& mesh, const Reference& reference)
{
    return figures_of(mesh, reference).lines.value();
}

TEST(TruthLines, AreOpenInAHole)
{
    const Reference reference = reference_of(square(), high_centers());
    const TriMesh holed = testing::together(strip(0.0, 0.3, 0.0), strip(0.7, 1.0, 0.0));
    const auto in_hole = [&](const Eigen::Vector3d& sample) {
        const double x = sample.x() + reference.origin.x();
        return x > 0.3 && x < 0.7;
    };
    const std::vector<Eigen::Vector3d>& samples = reference.truth->samples;
    const double share = static_cast<double>(std::ranges::count_if(samples, in_hole)) /
                         static_cast<double>(samples.size());
    const LineFigures lines = lines_of(holed, reference);
    EXPECT_DOUBLE_EQ(lines.open, share);
    EXPECT_DOUBLE_EQ(lines.seen_right, 1.0 - share);
    EXPECT_EQ(lines.torn, 0.0);
    EXPECT_NEAR(share, 0.4, kFourDeviations);
}

TEST(TruthLines, AreNotOpenIfTheMeshContinuesBehind)
{
    const TriMesh behind = testing::together(strip(0.0, 0.5, 0.0), strip(-1.0, 2.0, -0.5));
    const LineFigures lines = lines_of(behind, reference_of(square(), upright_centers()));
    EXPECT_NEAR(lines.seen_right, 0.5, kFourDeviations);
    EXPECT_EQ(lines.open, 0.0);
    EXPECT_EQ(lines.torn, 0.0);
}

TEST(TruthLines, AreTornIfTheyHitABackFirst)
{
    const Reference reference = reference_of(square(), upright_centers());
    const LineFigures turned = lines_of(testing::flipped(square()), reference);
    EXPECT_EQ(turned.seen_right, 0.0);
    EXPECT_EQ(turned.torn, 1.0);
    EXPECT_EQ(turned.open, 0.0);
    // This holds at any distance in front or behind, but not behind a front.
    EXPECT_EQ(lines_of(testing::flipped(square(0.5)), reference).torn, 1.0);
    EXPECT_EQ(lines_of(testing::flipped(square(-0.5)), reference).torn, 1.0);
    const TriMesh wide = testing::moved(testing::scaled(square(), 10.0), {-4.0, -4.0, -1.3});
    const Reference near_by = reference_of(square(), {{0.2, 0.2, 2}, {0.8, 0.2, 2}, {0.5, 0.8, 2}});
    EXPECT_EQ(lines_of(testing::flipped(wide), near_by).torn, 1.0);
    const TriMesh two = testing::together(square(), testing::flipped(square(-0.001)));
    EXPECT_EQ(lines_of(two, reference).torn, 0.0);
    EXPECT_EQ(lines_of(two, reference).seen_right, 1.0);
}

TEST(TruthLines, AllowHalfAPercentOfTheDiagonalAlongTheLine)
{
    const Reference reference = reference_of(square(), upright_centers());
    const double diagonal = reference.truth->diagonal;
    for (const double side : {-1.0, 1.0}) {
        EXPECT_EQ(lines_of(square(side * 0.0049 * diagonal), reference).seen_right, 1.0);
        const LineFigures lines = lines_of(square(side * 0.0051 * diagonal), reference);
        EXPECT_EQ(lines.seen_right, 0.0);
        EXPECT_EQ(lines.torn, 0.0);
        EXPECT_EQ(lines.open, 0.0);
    }
    // A line at 45 degrees is 1.41 times as long.
    const Reference slanting =
        reference_of(square(), {{1e6, 0, 1e6}, {1e6, 1, 1e6}, {1e6, 2, 1e6}});
    const TriMesh low = strip(-1.0, 2.0, -0.0034 * diagonal);
    EXPECT_EQ(lines_of(low, slanting).seen_right, 1.0);
    const TriMesh lower = strip(-1.0, 2.0, -0.0037 * diagonal);
    EXPECT_EQ(lines_of(lower, slanting).seen_right, 0.0);
}

/// Cameras at height 10 that show `half` to either side of the position below them.
Reference narrow_reference(const std::vector<Eigen::Vector3d>& centers, double half)
{
    Scene scene = scene_above_square(11, centers);
    scene.cameras[0] = testing::square_camera(100, half / 10.0);
    const NamedMesh named{"gt.ply", square()};
    return make_reference(scene, &named, few_samples());
}

TEST(TruthLines, UseViewsWithTheSampleInTheirImage)
{
    // The four images do not overlap, so the view of each sample is known, although three others
    // see the sample, too.
    const Reference reference = narrow_reference(high_centers(), 0.25);
    const Truth& truth = *reference.truth;
    ASSERT_EQ(truth.image_views.size(), truth.samples.size());
    for (std::size_t i = 0; i < truth.samples.size(); ++i) {
        const Eigen::Vector3d place = truth.samples[i] + reference.origin;
        std::uint32_t expected = kNoView;
        for (std::uint32_t view = 0; view < 4; ++view) {
            const Eigen::Vector3d off = place - high_centers()[view];
            if (std::max(std::abs(off.x()), std::abs(off.y())) <= 0.25) expected = view;
        }
        ASSERT_EQ(truth.image_views[i], expected) << "sample " << i;
    }
    // A band of 0.05 to either side of the center is in no image.
    EXPECT_NEAR(static_cast<double>(truth.image_samples()) /
                    static_cast<double>(truth.samples.size()),
                0.81, kFourDeviations);
}

TEST(TruthLines, IgnoreSamplesOutsideAllImages)
{
    // The images end at 0.25 and 0.75, so the rest does not count. A hole in half of the image is
    // half of the part that counts, but an eighth of the truth.
    const std::vector<Eigen::Vector3d> middle(3, Eigen::Vector3d(0.5, 0.5, 10.0));
    const Reference reference = narrow_reference(middle, 0.25);
    EXPECT_EQ(lines_of(strip(0.2, 0.8, 0.0), reference).seen_right, 1.0);
    EXPECT_NEAR(lines_of(strip(0.5, 0.8, 0.0), reference).open, 0.5, 2.0 * kFourDeviations);
}

TEST(TruthLines, AreMissingIfNoImageContainsTheTruth)
{
    std::vector<Eigen::Vector3d> far = high_centers();
    for (Eigen::Vector3d& center : far) {
        center.x() += 5.0;
    }
    const Reference reference = narrow_reference(far, 0.25);
    EXPECT_EQ(reference.truth->image_samples(), 0);
    EXPECT_FALSE(figures_of(square(), reference).lines.has_value());
}

} // namespace
} // namespace vcarve::truth_test
