#pragma once

#include "base/progress.h"
#include "model/tet_mesh.h"
#include "steps/3_cells/limits.h"
#include "vcarve/scene.h"

#include <cstddef>

namespace vcarve {

/// Returns the number of blocks for triangulate(). It is one per thread, and up to two for large
/// models, to hold only half of CGAL's structure at a time.
std::size_t usual_blocks(std::size_t points, std::size_t threads);

/// Returns the Delaunay triangulation of the points of a scene. CGAL's symbolic perturbation breaks
/// ties of points on one sphere. So the result depends only on the points, not on their order or
/// the thread count. Points must be finite and distinct. Throws InputError for fewer than four
/// points, coplanar points, or too many cells for 32-bit indices, and as soon as the limit is
/// exceeded. Cost: O(points log points) for points on surfaces in the order of spatial_sort().
/// Memory: the cells, and CGAL's structure of about 500 bytes per point of the blocks in progress.
/// With one thread, or if triangulate_in_blocks() gives up, this is needed for all points.
TetMesh triangulate(const Scene& scene, const Progress& progress = {},
                    std::size_t most_cells = kAnyCells);

/// The same on one thread and without blocks, for points that triangulate_in_blocks() gave up.
TetMesh triangulate_at_once(const Scene& scene, const Progress& progress = {},
                            std::size_t most_cells = kAnyCells);

} // namespace vcarve
