#pragma once

#include "model/labels.h"
#include "model/scene.h"
#include "model/tet_mesh.h"
#include "surface/boundary.h"

#include <vector>

namespace vcarve {

/// How plausible a face of a boundary is, from 0 to 1: its chance to be right, as measured on
/// scenes whose geometry is known. Small faces and those that go on with the surface around them
/// mostly are; long ones that stand across it are right every other time (docs/quality.md).
double plausibility(const Boundary& boundary, std::size_t face);

/// A labelling of cells and its boundary.
struct BoundedLabels {
    const Labels& labels;
    const Boundary& boundary;
};

/// The cells that became free without being worth it, ascending. The cells inside before and
/// outside after form pieces, joined through facets. A piece takes away the faces it had with the
/// outside before, and lays others open. Each counts by its area times its plausibility: by half of
/// that where its corners were not seen from its front, and by minus half its area where they were
/// seen from its back instead, like the underside of a roof, so that it speaks against a piece that
/// lays it open and for one that takes it away. A piece pays if what it lays open counts at least
/// as much as what it takes away; the cells of all others are returned. Cost: O(faces + freed
/// cells), in parallel but for the sums.
std::vector<Index> unpaid_cells(const TetMesh& cells, const Scene& scene,
                                const BoundedLabels& before, const BoundedLabels& after);

} // namespace vcarve
