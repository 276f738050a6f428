#pragma once

#include "base/arrays.h"
#include "vcarve/scene.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace vcarve {

/// Points that may be merged.
struct Dots {
    std::span<const Eigen::Vector3d> positions;
    std::span<const Eigen::Vector3f> normals; ///< empty, or one per dot
    std::vector<double> footprints;           ///< in scene units; infinite: never merged
    std::vector<std::uint32_t> num_views;

    std::size_t size() const { return positions.size(); }
};

/// The cubes in which dots are merged.
struct CubesForDots {
    double unit = 1.0;  ///< the median side
    double shift = 0.0; ///< of all cubes along every axis, in units
    double reach = 1.0; ///< maximum distance of a dot to its leader, in sides of the dot's cube
};

/// Returns the leader of each dot. The sides of cubes are powers of two times the unit. A dot
/// belongs to the cube whose side is nearest to its footprint, as a ratio. Dots in the same cube
/// form a cluster, and coarser dots join finer ones in their cube. The dot with most views leads;
/// the first of several. Dots whose normals differ by more than 60 degrees never share a cluster.
/// Cost: O(n log n), in parallel.
std::vector<std::uint32_t> leaders_in_cubes(const Dots& dots, const CubesForDots& cubes);

/// The members of every cluster. Clusters are in the order of their leaders.
class Clusters {
  public:
    explicit Clusters(const std::vector<std::uint32_t>& leader_of);

    std::size_t size() const { return leaders_.size(); }
    std::uint32_t leader(std::size_t cluster) const { return leaders_[cluster]; }
    const std::vector<std::uint32_t>& leaders() const { return leaders_; }
    std::span<const std::uint32_t> operator[](std::size_t cluster) const
    {
        return members_[leaders_[cluster]];
    }

  private:
    RowTable members_; ///< per dot; empty if the dot is no leader
    std::vector<std::uint32_t> leaders_;
};

/// Points, each with the number of input points that it was merged from.
struct MergedPoints {
    Scene scene;
    std::vector<std::uint32_t> counts; ///< empty if each point is an input point
};

/// Returns one point per cluster, in their order. It has the mean position, color and normal of its
/// points, and all their views. Error and id are the leader's. Cost: O(points + rays), in parallel.
MergedPoints merge_points(const MergedPoints& points, const Clusters& clusters);

/// Appends points that refer to the same views. `points` may be empty.
void append(MergedPoints& points, MergedPoints more);

} // namespace vcarve
