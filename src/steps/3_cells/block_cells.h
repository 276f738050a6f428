#pragma once

#include "base/progress.h"
#include "geometry/point_tree.h"
#include "model/tet_mesh.h"
#include "steps/3_cells/limits.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace vcarve {

/// A facet of a block's cell whose other cell belongs to another block.
struct OpenFacet {
    std::array<Index, 3> corners; ///< ascending
    Index cell;                   ///< index within the block
    std::uint32_t slot;
};

/// The cells whose smallest vertices are in a run of points.
struct BlockCells {
    UnsetArray<Cell>
        cells; ///< in canonical order; neighbors are indices in here, or CellNumber::kNone
    std::vector<OpenFacet> open_facets;
    std::size_t taken_in = 0; ///< number of points of other blocks
};

/// Adds the progress of a block to a count of all blocks' points.
class BlockProgress {
  public:
    /// `all` must outlive it.
    BlockProgress(ProgressCount& all, std::size_t points) : all_(all), points_(points) {}

    /// `share` must not decrease. Throws Cancelled as Progress does.
    void report(double share)
    {
        const auto done = static_cast<std::size_t>(share * static_cast<double>(points_));
        all_.add(done - done_);
        done_ = done;
    }

  private:
    ProgressCount& all_;
    std::size_t points_;
    std::size_t done_ = 0;
};

/// Thrown if too many points lie on or near common spheres or planes. Each sphere of a block's
/// cells would have to be tested against most points.
struct TooManyTies {};

/// Returns points that span space and the extreme points in 14 directions, ascending. Each block
/// begins with them, so that its points are not outside all others. Returns fewer than four if all
/// points are coplanar. Cost: O(points).
std::vector<Index> first_points(const std::vector<Eigen::Vector3d>& points);

/// Returns the cells of the Delaunay triangulation of all points that have their smallest vertex in
/// `own`. It triangulates these points and as few others as necessary. The sphere of each cell with
/// a corner in `own` is tested, and the deepest point in it is inserted, until all are empty. Then
/// each of these cells belongs to the whole triangulation. This is unique, because CGAL decides by
/// the points alone if several lie on one sphere. `first` is first_points(). Throws TooManyTies,
/// and InputError if `count`, which counts the cells of all blocks, exceeds its limit. Memory:
/// about 450 bytes per inserted point.
BlockCells block_cells(const PointTree& tree, const std::vector<Index>& first, const PointRun& own,
                       CellCount& count, BlockProgress& progress);

} // namespace vcarve
