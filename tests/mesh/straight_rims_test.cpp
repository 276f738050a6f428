#include "geometry/triangle.h"
#include "mesh/check.h"
#include "mesh/straight_rims.h"
#include "steps/6_surface/support.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

namespace vcarve {
namespace {

using Eigen::Vector3d;

/// Faces in the plane z = 0, all with a flag.
struct Sheet {
    TriMesh mesh;
    FaceFlags keep;

    Sheet(std::vector<Vector3d> positions, std::vector<Face> faces)
    {
        mesh.positions = std::move(positions);
        mesh.faces = std::move(faces);
        keep.assign(mesh.faces.size(), 1);
    }

    std::vector<Face> kept() const { return with_faces(mesh, keep).faces; }
    double area() const
    {
        double sum = 0.0;
        for (const Face& face : kept()) {
            EXPECT_GT(scaled_normal(mesh.positions, face).z(), 0.0);
            sum += face_area(mesh.positions, face);
        }
        return sum;
    }
    std::vector<std::uint32_t> straighten(
        std::uint32_t first_vertex, std::uint32_t first_face = 0,
        const PlaneOf& plane_of = [](std::uint32_t) { return 7; })
    {
        return straighten_rims(first_vertex, first_face, plane_of, mesh, keep);
    }
};

/// A triangle over (0, 0), (4, 0) and (1, 3); vertex 3 stands on its lower side, a little off that
/// where wanted.
Sheet halved(double off = 0.0)
{
    return Sheet({{0, 0, 0}, {4, 0, 0}, {1, 3, 0}, {1.7, off, 0}}, {{0, 3, 2}, {3, 1, 2}});
}

/// A square of side 2 whose lower side has vertices 4 to 6, all joined to the upper corners.
Sheet combed()
{
    return Sheet({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0.5, 0, 0}, {1, 0, 0}, {1.5, 0, 0}},
                 {{0, 4, 3}, {4, 5, 3}, {5, 2, 3}, {5, 6, 2}, {6, 1, 2}});
}

TEST(StraightenRims, JoinsTwoFaces)
{
    Sheet sheet = halved();
    EXPECT_EQ(sheet.straighten(3).size(), 1U);
    ASSERT_EQ(sheet.kept().size(), 1U);
    EXPECT_NEAR(sheet.area(), 6.0, 1e-12);
}

TEST(StraightenRims, TakesOutAllVerticesOfAStraightRim)
{
    Sheet sheet = combed();
    EXPECT_EQ(sheet.straighten(4).size(), 3U);
    EXPECT_EQ(sheet.kept().size(), 2U);
    EXPECT_NEAR(sheet.area(), 4.0, 1e-12);
    sheet.mesh.faces = sheet.kept();
    const MeshCheck check = check_mesh(sheet.mesh);
    EXPECT_TRUE(check.is_manifold());
    EXPECT_EQ(check.orientation_faults, 0);
    EXPECT_EQ(check.boundary_edges, 4);
}

TEST(StraightenRims, LeavesBentRims)
{
    for (const double off : {0.001, -0.001}) {
        Sheet sheet = halved(off);
        EXPECT_TRUE(sheet.straighten(3).empty());
        EXPECT_EQ(sheet.kept().size(), 2U);
    }
}

TEST(StraightenRims, LeavesVerticesBeforeTheFirst)
{
    Sheet sheet = combed();
    sheet.straighten(6);
    EXPECT_EQ(sheet.kept().size(), 4U);
}

TEST(StraightenRims, LeavesVerticesWhereFacesOfTwoPlanesMeet)
{
    Sheet sheet = halved();
    EXPECT_TRUE(sheet.straighten(3, 0, [](std::uint32_t face) { return face; }).empty());
    EXPECT_TRUE(sheet.straighten(3, 0, [](std::uint32_t) { return kNoPlane; }).empty());
}

TEST(StraightenRims, KeepsFacesBeforeTheFirst)
{
    for (const std::uint32_t kept : {0U, 1U}) {
        Sheet sheet = halved();
        if (kept == 1) std::swap(sheet.mesh.faces[0], sheet.mesh.faces[1]);
        EXPECT_EQ(sheet.straighten(3, 1), std::vector<std::uint32_t>{1});
        EXPECT_NEAR(sheet.area(), 6.0, 1e-12);
    }
    Sheet sheet = halved();
    EXPECT_TRUE(sheet.straighten(3, 2).empty());
}

TEST(StraightenRims, LooksAtFacesWithAFlagOnly)
{
    // Across the rim is a face without a flag, with the vertex in the middle of its side.
    Sheet sheet = halved();
    sheet.mesh.positions.emplace_back(1, -3, 0);
    sheet.mesh.faces.push_back({3, 0, 4});
    sheet.keep.push_back(0);
    EXPECT_EQ(sheet.straighten(3).size(), 1U);
    sheet = halved();
    sheet.mesh.positions.emplace_back(1, -3, 0);
    sheet.mesh.faces.push_back({3, 0, 4});
    sheet.keep.push_back(1);
    EXPECT_TRUE(sheet.straighten(3).empty()) << "the vertex is no longer between two on a line";
}

TEST(StraightenRims, LeavesVerticesWhereTwoFansMeet)
{
    Sheet sheet = halved();
    sheet.mesh.positions.emplace_back(1, -3, 0);
    sheet.mesh.positions.emplace_back(2.5, -3, 0);
    sheet.mesh.faces.push_back({3, 4, 5});
    sheet.keep.push_back(1);
    EXPECT_TRUE(sheet.straighten(3).empty()) << "the other fan holds the vertex";
}

TEST(StraightenRims, LeavesTheTipOfASlit)
{
    // The rim comes back from the vertex on the way it went there.
    Sheet sheet({{4, 0, 0}, {5, 0, 0}, {3, 3, 0}, {0, 0, 0}, {3, -3, 0}, {2, 0, 0}},
                {{0, 2, 5}, {2, 3, 5}, {3, 4, 5}, {4, 1, 5}});
    EXPECT_TRUE(sheet.straighten(5).empty());
}

TEST(StraightenRims, TakesNoOffenceAtRoundingFarFromTheOrigin)
{
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()));
    Sheet sheet = combed();
    for (Vector3d& position : sheet.mesh.positions) {
        position = turn * position + Vector3d(5e5, 4.6e6, 100.0);
    }
    EXPECT_EQ(sheet.straighten(4).size(), 3U);
}

TEST(StraightenRims, NeverMakesAnEdgeThatIsThere)
{
    // The ends of the straight rim are joined on the other side of the line already.
    Sheet sheet({{0, 0, 0}, {4, 0, 0}, {1, 3, 0}, {2, 0, 0}, {2, -3, 0}},
                {{0, 3, 2}, {3, 1, 2}, {0, 4, 1}});
    EXPECT_TRUE(sheet.straighten(3).empty());
    EXPECT_EQ(sheet.kept().size(), 3U);
}

TEST(StraightenRims, NeverTakesAFaceItsArea)
{
    // Seen from either end of the rim one of the faces between is a line.
    Sheet sheet({{0, 0, 0}, {4, 0, 0}, {1, 1 + 1e-15, 0}, {2, 2, 0}, {3, 1 + 1e-15, 0}, {2, 0, 0}},
                {{0, 5, 2}, {2, 5, 3}, {3, 5, 4}, {4, 5, 1}});
    EXPECT_TRUE(sheet.straighten(5).empty());
    EXPECT_EQ(sheet.kept().size(), 4U);
}

TEST(StraightenRims, NeverTurnsAFaceRound)
{
    // Vertex 3 sees the place 4 past the slope on both sides, the ends of its rim do not.
    Sheet sheet({{0, 0, 0}, {4, 0, 0}, {1.9, 0.1, 0}, {2, 0, 0}, {2, 5, 0}, {2.1, 0.1, 0}},
                {{0, 3, 2}, {2, 3, 4}, {4, 3, 5}, {3, 1, 5}});
    for (Face& face : sheet.mesh.faces) {
        if (scaled_normal(sheet.mesh.positions, face).z() < 0.0) std::swap(face[1], face[2]);
    }
    const double area = sheet.area();
    sheet.straighten(3);
    EXPECT_NEAR(sheet.area(), area, 1e-12);
    EXPECT_EQ(sheet.kept().size(), 4U);
}

} // namespace
} // namespace vcarve
