#include "steps/3_cells/triangulate.h"
#include "steps/5_labels/labelling.h"
#include "support/made_cells.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace vcarve {
namespace {

using testing::labels_where;
using testing::middle;

using FacetList = std::vector<std::pair<Index, int>>;

FacetList list(const std::vector<CellFacet>& facets)
{
    FacetList all;
    for (const CellFacet& facet : facets) {
        all.emplace_back(facet.cell, facet.slot);
    }
    return all;
}

class LabellingOfABall : public ::testing::Test {
  protected:
    LabellingOfABall()
        : scene(bumpy_sphere(500, 3)),
          mesh(triangulate(scene)),
          labels(labels_where(mesh, [&](Index cell) { return middle(mesh, cell).norm() < 0.8; }))
    {
    }

    Index some_inside_cell() const
    {
        return static_cast<Index>(std::ranges::find(labels, Label::inside) - labels.begin());
    }

    Scene scene;
    TetMesh mesh;
    Labels labels;
};

TEST_F(LabellingOfABall, ExtractsItsBoundaryOnce)
{
    Labelling labelling(mesh, labels);
    const Boundary& boundary = labelling.boundary();
    EXPECT_EQ(&labelling.boundary(), &boundary);
    labelling.set({}, Label::outside);
    EXPECT_EQ(&labelling.boundary(), &boundary) << "nothing was set";
    EXPECT_EQ(list(labelling.facets()), list(boundary_facets(mesh, labels)));
    EXPECT_EQ(list(boundary.facets()), list(boundary_facets(mesh, labels)));
}

TEST_F(LabellingOfABall, HasTheBoundaryOfTheLabelsItWasGivenLast)
{
    Labelling labelling(mesh, labels);
    const std::int64_t before = labelling.num_inside();
    labelling.boundary();
    const std::vector<Index> some = {some_inside_cell()};
    labelling.set(some, Label::outside);
    labels[some[0]] = Label::outside;
    EXPECT_EQ(labelling.labels(), labels);
    EXPECT_EQ(labelling.num_inside(), before - 1);
    EXPECT_EQ(list(labelling.facets()), list(boundary_facets(mesh, labels)));
    EXPECT_EQ(list(labelling.boundary().facets_in_order()), list(boundary_facets(mesh, labels)));
}

TEST_F(LabellingOfABall, KnowsItsFacetsWithoutABoundary)
{
    Labelling labelling(mesh, labels);
    EXPECT_EQ(list(labelling.facets()), list(boundary_facets(mesh, labels)));
    labelling.boundary();
    labelling.forget_boundary();
    EXPECT_EQ(list(labelling.facets()), list(boundary_facets(mesh, labels)));
}

} // namespace
} // namespace vcarve
