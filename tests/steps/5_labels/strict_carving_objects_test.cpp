// The objects of the paper's figures 15-18: strict carving must give each true solid, no more and
// no less. fixtures/README.md says what the fixtures guarantee.
#include "base/log.h"
#include "io/colmap/colmap_model.h"
#include "steps/3_cells/triangulate.h"
#include "steps/4_visibility/trace.h"
#include "steps/5_labels/strict_carving.h"
#include "steps/6_surface/extract.h"
#include "support/cast_sights.h"
#include "support/places.h"
#include "support/tetra_grid.h"
#include "vcarve/io.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace vcarve::strict_carving_objects_test {
namespace {

using Corner = std::array<double, 3>;
using Corners = std::array<Corner, 3>;

/// The faces by the places of their corners, each begun at its least corner, all in order.
std::vector<Corners> sorted_faces(const TriMesh& mesh)
{
    std::vector<Corners> result;
    for (const Face& face : mesh.faces) {
        Corners corners;
        std::transform(face.begin(), face.end(), corners.begin(), [&](std::uint32_t vertex) {
            const Eigen::Vector3d& p = mesh.positions[vertex];
            return Corner{p.x(), p.y(), p.z()};
        });
        std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()),
                    corners.end());
        result.push_back(corners);
    }
    std::sort(result.begin(), result.end());
    return result;
}

struct Object {
    std::string name;
    double volume;
};

class PaperObject : public ::testing::TestWithParam<Object> {
  protected:
    std::filesystem::path folder() const { return fixtures_folder() / "paper" / GetParam().name; }
};

TEST_P(PaperObject, IsCarvedExactly)
{
    const Scene scene = read_colmap_model(folder(), ModelFormat::text);
    const TetMesh cells = triangulate(scene);
    Log log;
    Stage stage(log, "carve");
    const Labels labels = carve(cells, crossings_of(cells, scene), 1);
    const TriMesh carved = extract_surface(cells, labels, scene);
    EXPECT_EQ(sorted_faces(carved), sorted_faces(read_ply(folder() / "solid.ply")));
    EXPECT_NEAR(testing::volume(carved), GetParam().volume, 1e-12 * GetParam().volume);
}

// Volumes by hand from the boxes each solid is made of.
INSTANTIATE_TEST_SUITE_P(Paper, PaperObject,
                         ::testing::Values(Object{"cube_with_cavity", 64.0 - 10.0},
                                           Object{"boissonnat", 68.0 - 6.0},
                                           Object{"cubicles", 27.0 + 1.5 * (6.0 + 3.0 + 2.25)},
                                           Object{"desk", 9.0 + 4.5 + 15.75 + 2.8125}),
                         [](const auto& object) { return object.param.name; });

} // namespace
} // namespace vcarve::strict_carving_objects_test
