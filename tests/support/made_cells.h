#pragma once

#include "model/tet_mesh.h"
#include "steps/3_cells/triangulate.h"
#include "steps/4_visibility/face_visibility.h"
#include "steps/5_labels/boundary.h"
#include "steps/6_surface/carve_surface.h"
#include "support/point_sets.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <tbb/task_arena.h>

#include <array>
#include <cstdint>
#include <functional>
#include <set>
#include <vector>

namespace vcarve::testing {

/// The mean of the corners of a finite cell.
Eigen::Vector3d middle(const TetMesh& mesh, Index cell);
Eigen::Vector3d middle(const TetMesh& mesh, const CellFacet& facet);

/// The cell with these corners; kInfinite if there is none.
Index cell_of(const TetMesh& mesh, const std::array<Index, 4>& corners);
/// The facet of a cell across from one of its corners.
CellFacet facet_across(const TetMesh& mesh, Index cell, Index corner);

/// Labels the finite cells inside for which `is_inside` returns true.
Labels labels_where(const TetMesh& mesh, const std::function<bool(Index)>& is_inside);
/// Labels all finite cells inside, so the boundary is the convex hull.
Labels solid(const TetMesh& mesh);

/// Turns a view so that the center of its image shows a position.
void aim(View& view, const Eigen::Vector3d& place);
/// Empties the tracks of some points.
void forget(Scene& scene, const std::set<Index>& points);

/// columns x rows points of a triangular lattice at height 0, row by row along x from the origin.
/// Edges have the length 1 along rows and 1.008 between rows. Coordinates are exact, so border
/// points are collinear. Each row is shifted by half a step from the previous one. A point has the
/// neighbors +-1, +-columns and +-(columns - 1).
Positions triangular_lattice(int columns, int rows);

template <typename Action>
auto with_threads(int threads, const Action& action)
{
    tbb::task_arena arena(threads);
    return arena.execute(action);
}

/// A scene with labeled cells, their boundary, and its visibility from the views.
struct LabeledScene {
    LabeledScene(Scene made, const std::function<Labels(const TetMesh&)>& label)
        : scene(std::move(made)),
          mesh(triangulate(scene)),
          labels(label(mesh)),
          facets(boundary_facets(mesh, labels)),
          corners(boundary_faces(mesh, facets)),
          surface(extract_surface(mesh, facets, scene)),
          visibility(mesh, labels, scene)
    {
    }

    Scene scene;
    TetMesh mesh;
    Labels labels;
    std::vector<CellFacet> facets;
    std::vector<Face> corners; ///< of each facet, as indices of points of the scene
    TriMesh surface;
    FaceVisibility visibility;
};

} // namespace vcarve::testing
