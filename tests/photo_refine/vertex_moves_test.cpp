#include "photo_refine/shift_noise.h"
#include "photo_refine/vertex_moves.h"
#include "support/photographed_wall.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vcarve::vertex_moves_test {
namespace {

using Eigen::Vector3d;

/// A curve with its minimum at a shift.
PhotoCurve curve_at(float minimum, float least = 0.1F, int pairs = 10)
{
    PhotoCurve curve;
    for (int k = 0; k < kShifts; ++k) {
        const float off = static_cast<float>(k - kMostShift) - minimum;
        curve.costs[k] = least + 0.05F * off * off;
    }
    curve.weight = 1.0F;
    curve.pairs = pairs;
    return curve;
}

TEST(WantedShift, IsTheMinimumOfTheCurve)
{
    EXPECT_NEAR(wanted_shift(curve_at(0.3F)).steps, 0.3F, 1e-5);
    EXPECT_NEAR(wanted_shift(curve_at(-1.2F)).steps, -1.2F, 1e-5);
    EXPECT_EQ(wanted_shift(curve_at(5.0F)).steps, 2.0F) << "the end, if it lies beyond";
    EXPECT_LT(wanted_shift(curve_at(5.0F)).weight, wanted_shift(curve_at(1.0F)).weight);
}

TEST(WantedShift, WeighsAgreementAndNeedsTwoPairs)
{
    EXPECT_GT(wanted_shift(curve_at(0.0F, 0.05F)).weight,
              2.0F * wanted_shift(curve_at(0.0F, 0.3F)).weight);
    EXPECT_EQ(wanted_shift(curve_at(0.0F, 0.8F)).weight, 0.0F) << "no agreement";
    EXPECT_EQ(wanted_shift(curve_at(0.0F, 0.1F, 1)).weight, 0.0F);
    PhotoCurve flat = curve_at(0.0F);
    flat.costs.fill(0.1F);
    EXPECT_EQ(wanted_shift(flat).weight, 0.0F) << "any shift is as good";
}

/// A wall whose vertices all want the same.
struct Wall {
    TriMesh mesh = wall_mesh(16);
    std::vector<Vector3d> normals = normals_of_vertices(mesh);
    std::vector<float> steps = std::vector<float>(mesh.positions.size(), 0.02F);
    RowTable neighbors = neighbors_of(mesh);

    std::vector<Vector3d> moved(const std::vector<WantedShift>& wanted) const
    {
        const ShiftSolver solver(mesh, normals, steps, neighbors);
        return solver.moved(solver.shifts(wanted, 8.0));
    }
};

TEST(ShiftSolver, MovesASurfaceWhereAllWantIt)
{
    const Wall wall;
    const std::vector<WantedShift> wanted(wall.steps.size(), {1.5F, 5.0F});
    for (const Vector3d& position : wall.moved(wanted)) {
        EXPECT_NEAR(position.z(), -1.5 * 0.02, 1e-3); // it faces -z
    }
}

TEST(ShiftSolver, SpreadsNoOutlier)
{
    const Wall wall;
    std::vector<WantedShift> wanted(wall.steps.size(), {0.0F, 5.0F});
    wanted[8 * 17 + 8].steps = 2.0F;
    for (const Vector3d& position : wall.moved(wanted)) {
        EXPECT_LT(std::abs(position.z()), 0.5 * 2.0 * 0.02);
    }
}

TEST(ShiftSolver, LeavesUnmeasuredVerticesInPlace)
{
    Wall wall;
    for (std::size_t v = 0; v < wall.steps.size(); ++v) {
        if (wall.mesh.positions[v].x() > 0.0) wall.steps[v] = 0.0F;
    }
    const std::vector<WantedShift> wanted(wall.steps.size(), {2.0F, 5.0F});
    const std::vector<Vector3d> moved = wall.moved(wanted);
    for (std::size_t v = 0; v < moved.size(); ++v) {
        if (wall.steps[v] == 0.0F) {
            EXPECT_EQ(moved[v], wall.mesh.positions[v]);
        }
    }
}

/// The weight that all vertices of a wall keep if their groups want this.
float kept_weight(const WantedShift& even, const WantedShift& odd, float all = 5.0F)
{
    const Wall wall;
    const std::vector<GroupShifts> shifts(wall.steps.size(), {{0.5F, all}, even, odd});
    return trusted_shifts(shifts, wall.neighbors).front().weight;
}

TEST(TrustedShifts, LoseWeightIfHalvesOfThePhotographsDisagree)
{
    EXPECT_FLOAT_EQ(kept_weight({0.5F, 5.0F}, {0.4F, 5.0F}), 5.0F);
    const float noisy = kept_weight({0.5F, 5.0F}, {0.1F, 5.0F});
    EXPECT_GT(noisy, 0.0F);
    EXPECT_LT(noisy, 2.0F);
    EXPECT_EQ(kept_weight({1.0F, 5.0F}, {-1.0F, 5.0F}), 0.0F);
}

TEST(TrustedShifts, LoseWeightWithoutTexture)
{
    EXPECT_EQ(kept_weight({0.5F, 0.1F}, {0.5F, 0.1F}, 0.1F), 0.0F);
}

} // namespace
} // namespace vcarve::vertex_moves_test
