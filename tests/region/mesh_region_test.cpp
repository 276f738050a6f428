#include "region/region.h"
#include "support/region_checks.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"
#include "vcarve/io.h"

#include <gtest/gtest.h>

namespace vcarve::mesh_region_test {
namespace {

using Eigen::Vector3d;

/// Adds the surface of a box, with normals pointing out.
void add_box(TriMesh& mesh, const Vector3d& low, const Vector3d& high)
{
    const auto base = static_cast<std::uint32_t>(mesh.positions.size());
    for (int corner = 0; corner < 8; ++corner) {
        mesh.positions.emplace_back((corner & 1) != 0 ? high.x() : low.x(),
                                    (corner & 2) != 0 ? high.y() : low.y(),
                                    (corner & 4) != 0 ? high.z() : low.z());
    }
    const std::array<Face, 12> faces = {{{0, 2, 1},
                                         {1, 2, 3},
                                         {4, 5, 6},
                                         {5, 7, 6},
                                         {0, 1, 4},
                                         {1, 5, 4},
                                         {2, 6, 3},
                                         {3, 6, 7},
                                         {0, 4, 2},
                                         {2, 4, 6},
                                         {1, 3, 5},
                                         {3, 7, 5}}};
    for (const Face& face : faces) {
        mesh.faces.push_back({base + face[0], base + face[1], base + face[2]});
    }
}

TriMesh cube()
{
    TriMesh mesh;
    add_box(mesh, {-2, -2, -2}, {2, 2, 2});
    return mesh;
}

class MeshFile : public ::testing::Test {
  protected:
    std::unique_ptr<Region> read(const TriMesh& mesh, const Vector3d& offset = {0, 0, 0}) const
    {
        write_ply(path, mesh, {});
        return read_mesh_region(path, offset);
    }
    std::string refused(const TriMesh& mesh) const
    {
        const std::string message = refusal<InputError>([&] { read(mesh); });
        return message.starts_with(path) ? message.substr(path.size()) : message;
    }

    TemporaryFolder folder;
    std::string path = folder / "region.ply";
};

TEST_F(MeshFile, GivesABoxForACube)
{
    expect_same_region(*read(cube()), *box_region({-2, -2, -2}, {2, 2, 2}), 4);
}

TEST_F(MeshFile, MayHaveUnsharedVerticesAndInvertedFaces)
{
    TriMesh loose;
    const TriMesh shared = cube();
    for (const Face& face : shared.faces) {
        const auto base = static_cast<std::uint32_t>(loose.positions.size());
        for (const std::uint32_t corner : face) {
            loose.positions.push_back(shared.positions[corner]);
        }
        loose.faces.push_back({base, base + 1, base + 2});
    }
    std::swap(loose.faces[3][0], loose.faces[3][1]);
    expect_same_region(*read(loose), *box_region({-2, -2, -2}, {2, 2, 2}), 4);
}

TEST_F(MeshFile, MayHaveBoxesThatTouchAtAnEdge)
{
    TriMesh two = cube();
    add_box(two, {2, 2, -2}, {4, 4, 2});
    const EitherRegion boxes(box_region({-2, -2, -2}, {2, 2, 2}),
                             box_region({2, 2, -2}, {4, 4, 2}));
    expect_same_region(*read(two), boxes, 5);
}

TEST_F(MeshFile, HasACavityInsideANestedSurface)
{
    TriMesh hollow = cube();
    add_box(hollow, {-1, -1, -1}, {1, 1, 1});
    const auto region = read(hollow);
    EXPECT_FALSE(region->contains({0, 0, 0}));
    EXPECT_TRUE(region->contains({1.5, 0, 0}));
    EXPECT_FALSE(region->meets({-0.5, 0, 0}, {0.5, 0.25, 0})); // within the cavity
    EXPECT_TRUE(region->meets({0, 0, 0}, {9, 0, 0}));
}

TEST_F(MeshFile, MayHaveFacesWithZeroArea)
{
    TriMesh mesh = cube(); // the diagonal 1-2 of the bottom gets a vertex at its midpoint
    mesh.positions.emplace_back(0, 0, -2);
    mesh.faces[0] = {0, 2, 8};
    mesh.faces.push_back({0, 8, 1});
    mesh.faces.push_back({1, 8, 2}); // without area
    mesh.faces[1] = {1, 2, 3};
    expect_same_region(*read(mesh), *box_region({-2, -2, -2}, {2, 2, 2}), 4);
}

TEST_F(MeshFile, IsReadInTheFrameOfTheFile)
{
    TriMesh far = cube();
    far.offset = {5e5, 4.6e6, 100};
    const auto region = read(far, {500001, 4600002, 103});
    EXPECT_EQ(region->bounds().min(), Vector3d(-3, -4, -5));
    EXPECT_TRUE(region->contains({-2.5, -3.5, -4.5}));
    EXPECT_FALSE(region->contains({1.5, 0, 0}));
}

TEST_F(MeshFile, IsRejectedIfItIsNotClosed)
{
    TriMesh open = cube();
    open.faces.pop_back();
    EXPECT_EQ(refused(open), ": found 3 of 18 edges that bound an odd number of faces, expected a "
                             "closed surface");
    open.faces.clear();
    EXPECT_EQ(refused(open), ": found no face, expected a closed surface");
}

TEST_F(MeshFile, MayBeTinyAndFarAway)
{
    TriMesh tiny;
    const double step = 1e-9; // some units in the last place
    add_box(tiny, Vector3d(1e6, 1e6, 1e6),
            Vector3d(1e6 + 4 * step, 1e6 + 4 * step, 1e6 + 4 * step));
    const auto region = read(tiny);
    EXPECT_TRUE(region->contains(Vector3d::Constant(1e6 + 2 * step)));
    EXPECT_TRUE(region->contains({1e6, 1e6 + 2 * step, 1e6 + 2 * step}));
    EXPECT_FALSE(region->contains({1e6 - step, 1e6 + 2 * step, 1e6 + 2 * step}));
}

TEST_F(MeshFile, IsRejectedIfItIsTooFarAway)
{
    TriMesh far = cube();
    far.positions[0].x() = -1e101;
    EXPECT_EQ(refused(far), ": found a vertex farther than 1e+100 from the origin, expected a "
                            "surface in the frame of the model");
}

} // namespace
} // namespace vcarve::mesh_region_test
