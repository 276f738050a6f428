#pragma once

#include "base/progress.h"
#include "model/tet_mesh.h"
#include "vcarve/scene.h"

namespace vcarve {

/// The Delaunay triangulation of the points of a scene. Points on one sphere are told apart by
/// CGAL's symbolic perturbation, so the triangulation depends on the points alone, not on their
/// order or on the number of threads. Needs finite points, no two at one place. Throws InputError
/// where there are fewer than four points or all lie in one plane, and where there are too many
/// cells for 32-bit indices. Cost: O(points log points) on surfaces where points that follow each
/// other lie near each other, as spatial_sort() puts them; CGAL's structure, about 600 bytes a
/// point, lives beside the result only while that is filled.
TetMesh triangulate(const Scene& scene, const Progress& progress = {});

} // namespace vcarve
