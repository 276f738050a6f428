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

/// A facet of a block's cell, beyond which lies a cell of another block.
struct OpenFacet {
    std::array<Index, 3> corners; ///< ascending
    Index cell;                   ///< within the block
    std::uint32_t slot;
};

/// The cells whose smallest vertices are in one run of points.
struct BlockCells {
    UnsetArray<Cell>
        cells; ///< in canonical order; neighbours by number in here or CellNumber::kNone
    std::vector<OpenFacet> open_facets;
    std::size_t taken_in = 0; ///< points of other blocks
};

/// Tells which share of a block is done to a count of all blocks' points.
class BlockProgress {
  public:
    /// `all` must outlive it.
    BlockProgress(ProgressCount& all, std::size_t points) : all_(all), points_(points) {}

    /// Not less than the share told before; throws Cancelled as Progress does.
    void tell(double share)
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

/// Thrown where points lie on common spheres or planes, or next to them, so many that the spheres
/// of a block's cells cannot be told to be empty without looking at most points for each.
struct TooManyTies {};

/// Points that span space, and the farthest ones in 14 directions: what each block begins with, so
/// that its own points do not lie outside all else. Ascending. Fewer than four where all points lie
/// in one plane. Cost: O(points).
std::vector<Index> first_points(const std::vector<Eigen::Vector3d>& points);

/// The cells of the Delaunay triangulation of all points that have their smallest vertex in `own`,
/// made from these points and as few others as they need. Cells with a corner in `own` are looked
/// at: where another point lies in the sphere around one, the deepest such point is inserted, until
/// there is none. Then each of these cells is one of the whole triangulation, which is unique, as
/// CGAL decides by the points alone where several lie on one sphere. `first` is first_points().
/// Throws TooManyTies, and InputError as `count` does, which counts the cells of all blocks.
/// Memory: about 450 bytes for each point inserted.
BlockCells block_cells(const PointTree& tree, const std::vector<Index>& first, const PointRun& own,
                       CellCount& count, BlockProgress& progress);

} // namespace vcarve
