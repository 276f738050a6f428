#include "base/progress.h"
#include "io/colmap/colmap_model.h"
#include "steps/1_points/arrange.h"
#include "steps/3_cells/triangulate.h"
#include "steps/4_visibility/trace.h"
#include "steps/5_labels/label_cells.h"
#include "steps/6_surface/carve_surface.h"
#include "support/cast_rays.h"
#include "support/exact_ray.h"
#include "support/paper_rule.h"
#include "support/places.h"
#include "support/point_sets.h"
#include "support/scenes.h"
#include "support/tetra_grid.h"
#include "vcarve/io.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

namespace vcarve::label_cells_test {
namespace {

using Eigen::Vector3d;

/// An energy without terms and without cells of views.
VisibilityEnergy silence(const TetMesh& mesh)
{
    VisibilityEnergy energy;
    energy.unit = 256;
    energy.network.arc_capacities.assign(mesh.cells.size(), {0, 0, 0, 0});
    energy.network.terminal_capacities.assign(mesh.cells.size(), 0);
    return energy;
}

/// Two tetrahedra with a common triangle: a bipyramid with apexes at +-height.
TetMesh bipyramid(double height)
{
    return triangulate(make_scene({{9, 9, 9}}, {{{1, 0, 0}, {0}},
                                                {{-0.5, 0.8, 0}, {0}},
                                                {{-0.5, -0.8, 0}, {0}},
                                                {{0, 0, height}, {0}},
                                                {{0, 0, -height}, {0}}}));
}

std::vector<Index> finite_cells(const TetMesh& mesh)
{
    std::vector<Index> finite;
    for (Index i = 0; i < mesh.cells.size(); ++i) {
        if (!mesh.cells[i].is_infinite()) {
            finite.push_back(i);
        }
    }
    return finite;
}

TEST(Cut, LabelsEverythingOutsideWithoutEvidence)
{
    const TetMesh mesh = triangulate(spatial_sort(bumpy_sphere(300, 31)));
    const Labels labels = cut(mesh, silence(mesh), {});
    EXPECT_EQ(labels, Labels(mesh.cells.size(), Label::outside));
}

TEST(Cut, LabelsACellInsideIfItsVoteExceedsTheCostOfItsFacets)
{
    const TetMesh mesh = bipyramid(2.0);
    ASSERT_EQ(finite_cells(mesh).size(), 2U);
    const Index chosen = finite_cells(mesh)[0];
    VisibilityEnergy energy = silence(mesh);
    energy.network.terminal_capacities[chosen] = -100 * energy.unit;
    // The other cell stays outside: the common triangle costs 0.38 of a ray by the angles of its
    // circumspheres, and the three other facets of the other cell cost 0.73 to 0.78 each.
    Labels expected(mesh.cells.size(), Label::outside);
    expected[chosen] = Label::inside;
    EXPECT_EQ(cut(mesh, energy, {}), expected);

    // If facets cost more than the sink capacity, the cell stays outside.
    EXPECT_EQ(cut(mesh, energy, {.quality = 1000.0}), Labels(mesh.cells.size(), Label::outside));
}

TEST(Cut, NeverLabelsTheCellOfAViewInside)
{
    const TetMesh mesh = bipyramid(2.0);
    const Index chosen = finite_cells(mesh)[0];
    VisibilityEnergy energy = silence(mesh);
    energy.network.terminal_capacities[chosen] = -100 * energy.unit;
    energy.cell_of_view = {chosen};
    EXPECT_EQ(cut(mesh, energy, {})[chosen], Label::outside);
}

TEST(Cut, UsesOnlyRaysIfQualityIsZero)
{
    const TetMesh mesh = bipyramid(0.3);
    const auto finite = finite_cells(mesh);
    VisibilityEnergy energy = silence(mesh);
    energy.network.terminal_capacities[finite[1]] = -1; // the smallest term there is
    const Labels labels = cut(mesh, energy, {.quality = 0.0});
    EXPECT_EQ(labels[finite[0]], Label::outside);
    EXPECT_EQ(labels[finite[1]], Label::inside);
}

TEST(Cut, NeverLabelsAnInfiniteCellInside)
{
    const Scene scene = spatial_sort(bumpy_sphere(1000, 32));
    const TetMesh mesh = triangulate(scene);
    Log silent;
    Stage stage(silent, "");
    const Labels labels = cut(mesh, energy_of(mesh, scene, {}), {});
    std::int64_t inside = 0;
    for (Index i = 0; i < mesh.cells.size(); ++i) {
        inside += labels[i] == Label::inside;
        ASSERT_FALSE(mesh.cells[i].is_infinite() && labels[i] == Label::inside);
    }
    EXPECT_GT(inside, static_cast<std::int64_t>(mesh.cells.size() / 4));
}

constexpr Label o = Label::outside;
constexpr Label i = Label::inside;

// ---- hand-computed cases ------------------------------------------------------------------------

TEST(Carve, RemovesInfiniteCellsAndCellsWithEnoughCrossingsOfOneFacet)
{
    // Two tetrahedra, {0 1 2 3} and {0 1 2 4}, and the six cells around them.
    const TetMesh mesh = triangulation_of({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 3}, {1, 1, -3}});
    ASSERT_EQ(mesh.cells.size(), 8U);
    ASSERT_FALSE(mesh.cells[0].is_infinite());
    ASSERT_FALSE(mesh.cells[1].is_infinite());
    Crossings crossings(8, {0, 0, 0, 0});
    EXPECT_EQ(carve(mesh, crossings, 1), (Labels{i, i, o, o, o, o, o, o}));
    crossings[1] = {0, 0, 1, 0};
    EXPECT_EQ(carve(mesh, crossings, 1), (Labels{i, o, o, o, o, o, o, o}));
    EXPECT_EQ(carve(mesh, crossings, 2), (Labels{i, i, o, o, o, o, o, o}));
    crossings[0] = {1, 1, 1, 1}; // one facet must be crossed twice, not two facets once
    crossings[1] = {0, 0, 0, 2};
    EXPECT_EQ(carve(mesh, crossings, 2), (Labels{i, o, o, o, o, o, o, o}));
    EXPECT_EQ(carve(mesh, crossings, 3), (Labels{i, i, o, o, o, o, o, o}));
}

// ---- the paper's objects ------------------------------------------------------------------------

using Whole = Eigen::Matrix<std::int64_t, 3, 1>;

/// A position in units of the grid that contains all coordinates of the paper's objects.
Whole on_grid(const Vector3d& position)
{
    const Vector3d scaled = position * 2048.0;
    EXPECT_EQ(scaled, scaled.array().round().matrix());
    return scaled.cast<std::int64_t>();
}

std::int64_t determinant(const Whole& a, const Whole& b, const Whole& c)
{
    return a.x() * (b.y() * c.z() - b.z() * c.y()) - a.y() * (b.x() * c.z() - b.z() * c.x()) +
           a.z() * (b.x() * c.y() - b.y() * c.x());
}

/// Six times the volume within a closed surface, in cubes of the grid.
std::int64_t volume_6(const TriMesh& solid)
{
    std::int64_t sum = 0;
    for (const Face& face : solid.faces) {
        sum += determinant(on_grid(solid.positions[face[0]]), on_grid(solid.positions[face[1]]),
                           on_grid(solid.positions[face[2]]));
    }
    return sum;
}

/// Six times the volume of the inside cells, in cubes of the grid.
std::int64_t volume_6(const TetMesh& mesh, const Labels& labels)
{
    std::int64_t sum = 0;
    for (Index cell = 0; cell < mesh.cells.size(); ++cell) {
        if (labels[cell] == i) {
            const auto& v = mesh.cells[cell].vertices;
            const Whole origin = on_grid(mesh.positions[v[0]]);
            sum += determinant(on_grid(mesh.positions[v[1]]) - origin,
                               on_grid(mesh.positions[v[2]]) - origin,
                               on_grid(mesh.positions[v[3]]) - origin);
        }
    }
    return sum;
}

/// Rotates a face so that the smallest vertex comes first.
Face turned(Face face)
{
    std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
    return face;
}

/// The facets between inside and outside, counter-clockwise seen from outside, sorted.
std::vector<Face> boundary(const TetMesh& mesh, const Labels& labels)
{
    std::vector<Face> faces;
    for (Index cell = 0; cell < mesh.cells.size(); ++cell) {
        for (int slot = 0; slot < 4 && labels[cell] == i; ++slot) {
            if (labels[mesh.cells[cell].neighbors[slot]] == o) {
                const auto& v = mesh.cells[cell].vertices;
                const auto& corners = kFacetCorners[slot]; // counter-clockwise from inside
                faces.push_back(turned({v[corners[2]], v[corners[1]], v[corners[0]]}));
            }
        }
    }
    std::sort(faces.begin(), faces.end());
    return faces;
}

std::vector<Face> sorted_faces(const TriMesh& solid)
{
    std::vector<Face> faces;
    for (const Face& face : solid.faces) {
        faces.push_back(turned(face));
    }
    std::sort(faces.begin(), faces.end());
    return faces;
}

/// An object of the paper, with values from README.md of the fixtures.
struct PaperObject {
    std::string name;
    double volume;
    std::ptrdiff_t solid_cells;
    std::ptrdiff_t empty_cells;
    std::size_t rays;
    std::array<int, 3>
        marks; ///< slots of finite cells by the paper's test: none, unclear, redundant
};

std::ostream& operator<<(std::ostream& out, const PaperObject& object)
{
    return out << object.name;
}

class PaperObjects : public ::testing::TestWithParam<PaperObject> {
  protected:
    PaperObjects()
        : folder_(fixtures_folder() / "paper" / GetParam().name),
          scene_(read_colmap_model(folder_, ModelFormat::text)),
          solid_(read_ply(folder_ / "solid.ply")),
          mesh_(triangulate(scene_))
    {
        Log log;
        Stage stage(log, "rays");
        crossings_ = crossings_of(mesh_, scene_);
    }

    std::filesystem::path folder_;
    Scene scene_;
    TriMesh solid_;
    TetMesh mesh_;
    Crossings crossings_;
};

TEST_P(PaperObjects, CarvesTheTrueSolid)
{
    ASSERT_EQ(scene_.positions, solid_.positions); // so that indices are the same
    ASSERT_EQ(scene_.num_rays(), GetParam().rays);
    const Labels labels = carve(mesh_, crossings_, 1);
    EXPECT_EQ(volume_6(mesh_, labels), volume_6(solid_));
    EXPECT_EQ(static_cast<double>(volume_6(solid_)), 6.0 * GetParam().volume * std::pow(2048.0, 3));
    EXPECT_EQ(boundary(mesh_, labels), sorted_faces(solid_));
    EXPECT_EQ(std::count(labels.begin(), labels.end(), i), GetParam().solid_cells);
    const auto finite = std::count_if(mesh_.cells.begin(), mesh_.cells.end(),
                                      [](const Cell& cell) { return !cell.is_infinite(); });
    EXPECT_EQ(finite, GetParam().solid_cells + GetParam().empty_cells);
}

TEST_P(PaperObjects, MatchesBruteForceCrossings)
{
    Crossings expected(mesh_.cells.size(), {0, 0, 0, 0});
    for (Index vertex = 0; vertex < scene_.num_points(); ++vertex) {
        for (const std::uint32_t view : scene_.tracks[vertex]) {
            const Vector3d& center = scene_.views[view].center;
            for (const auto& [facet, share] : crossings_by_brute_force(mesh_, vertex, center)) {
                ++expected[facet.cell][facet.slot];
                const Index beyond = mesh_.cells[facet.cell].neighbors[facet.slot];
                ++expected[beyond][mesh_.mirror(facet.cell, facet.slot)];
            }
        }
    }
    EXPECT_EQ(crossings_, expected);
}

TEST_P(PaperObjects, MatchesTheRuleOfThePaper)
{
    const auto marks = marks_by_paper_rule(mesh_, scene_);
    std::array<int, 3> found = {0, 0, 0};
    for (Index cell = 0; cell < mesh_.cells.size(); ++cell) {
        for (int slot = 0; slot < 4 && !mesh_.cells[cell].is_infinite(); ++slot) {
            const Mark mark = marks[cell][slot];
            ++found[static_cast<std::size_t>(mark)];
            if (mark != Mark::unclear) {
                ASSERT_EQ(crossings_[cell][slot] > 0, mark == Mark::redundant)
                    << "cell " << cell << ", slot " << slot;
            }
        }
    }
    EXPECT_EQ(found, GetParam().marks);
}

INSTANTIATE_TEST_SUITE_P(
    Carve, PaperObjects,
    ::testing::Values(PaperObject{"cube_with_cavity", 54.0, 243, 41, 813, {937, 83, 116}},
                      PaperObject{"boissonnat", 62.0, 245, 154, 976, {1012, 71, 513}},
                      PaperObject{"cubicles", 43.875, 703, 234, 3011, {2866, 177, 705}},
                      PaperObject{"desk", 32.0625, 435, 201, 1655, {1889, 0, 655}}),
    [](const auto& instance) { return instance.param.name; });

} // namespace
} // namespace vcarve::label_cells_test
