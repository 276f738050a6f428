#include "mesh/check.h"
#include "photo_refine/divide_faces.h"
#include "support/photographed_wall.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vcarve::divide_faces_test {
namespace {

constexpr std::size_t kMany = 1000000;

double longest_edge(const TriMesh& mesh)
{
    double longest = 0.0;
    for (const Face& face : mesh.faces) {
        for (std::size_t i = 0; i < 3; ++i) {
            const auto& a = mesh.positions[face[i]];
            longest = std::max(longest, (mesh.positions[face[(i + 1) % 3]] - a).norm());
        }
    }
    return longest;
}

TEST(DivideFaces, LeavesNoLongEdgeAndNoCrack)
{
    TriMesh mesh = wall_mesh(3);
    const std::int64_t rim = check_mesh(mesh).boundary_edges;
    std::vector<float> spacing(mesh.positions.size(), 0.05F);
    spacing[0] = 0.02F;
    divide_faces(mesh, spacing, kMany);
    ASSERT_EQ(spacing.size(), mesh.positions.size());
    EXPECT_LE(longest_edge(mesh), 1.4 * 0.05 + 1e-9);
    const MeshCheck check = check_mesh(mesh);
    EXPECT_NEAR(check.area, 4.0, 1e-9);
    EXPECT_TRUE(check.is_manifold());
    EXPECT_EQ(check.orientation_faults, 0);
    EXPECT_EQ(check.components, 1);
    EXPECT_EQ(check.euler_characteristic, 1) << "a disk";
    EXPECT_GT(check.boundary_edges, rim);
}

TEST(DivideFaces, LeavesUnseenPartsWhole)
{
    TriMesh mesh = wall_mesh(4);
    std::vector<float> spacing(mesh.positions.size(), std::numeric_limits<float>::infinity());
    const std::size_t before = mesh.faces.size();
    divide_faces(mesh, spacing, kMany);
    EXPECT_EQ(mesh.faces.size(), before);
}

TEST(DivideFaces, StopsBeforeThereAreTooManyVertices)
{
    TriMesh mesh = wall_mesh(2);
    std::vector<float> spacing(mesh.positions.size(), 0.001F);
    divide_faces(mesh, spacing, 500);
    EXPECT_LE(mesh.positions.size(), 500U);
    EXPECT_GT(mesh.positions.size(), 100U);
    EXPECT_TRUE(check_mesh(mesh).is_manifold());
}

} // namespace
} // namespace vcarve::divide_faces_test
