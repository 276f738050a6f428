#pragma once

#include "base/progress.h"
#include "model/tet_mesh.h"
#include "steps/3_cells/limits.h"
#include "vcarve/scene.h"

#include <cstddef>

namespace vcarve {

/// In how many blocks triangulate() works, each one thread at a time: two for each thread, so that
/// one which has less to do takes its turn, and half of CGAL's structure is there at a time.
std::size_t usual_blocks(std::size_t points, std::size_t threads);

/// The Delaunay triangulation of the points of a scene. Points on one sphere are told apart by
/// CGAL's symbolic perturbation, so the triangulation depends on the points alone, not on their
/// order or on the number of threads. Needs finite points, no two at one place. Throws InputError
/// where there are fewer than four points or all lie in one plane, and where there are more cells
/// than the limit says, as soon as there are, or too many for 32-bit indices. Cost: O(points log
/// points) on surfaces where points that follow each other lie near each other, as spatial_sort()
/// puts them. Memory: CGAL's structure, about 500 bytes a point of the blocks in work, beside the
/// cells; of all points where there is one thread, or triangulate_in_blocks() gives up.
TetMesh triangulate(const Scene& scene, const Progress& progress = {}, const CellLimit& limit = {});

/// The same, made by one thread and not in blocks: for points that triangulate_in_blocks() has
/// given up already.
TetMesh triangulate_at_once(const Scene& scene, const Progress& progress = {},
                            const CellLimit& limit = {});

} // namespace vcarve
