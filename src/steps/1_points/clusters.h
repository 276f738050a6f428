#pragma once

#include "base/arrays.h"
#include "vcarve/scene.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace vcarve {

/// Points that may be merged: where they are, how fine they were seen, and how much they count.
struct Dots {
    std::span<const Eigen::Vector3d> positions;
    std::span<const Eigen::Vector3f> normals; ///< empty, or one a dot
    std::vector<double> footprints;           ///< infinite: never merged
    std::vector<std::uint32_t> num_views;

    std::size_t size() const { return positions.size(); }
};

/// Cubes that dots are merged in.
struct CubesForDots {
    double unit = 1.0;  ///< the usual side
    double shift = 0.0; ///< of all cubes along every axis, in units
    double reach = 1.0; ///< a dot joins a leader nearer than so many sides of its cube
};

/// The leader of every dot, which is one of its cluster. Dots whose footprint is the side of a cube
/// or up to about twice that, and which lie in the same cube, make a cluster, finer dots first, and
/// coarser dots join finer ones in their cube; the dot with most views leads, the first of several.
/// Dots whose normals differ by more than 60 degrees are not in one. Cost: O(n log n), in parallel.
std::vector<std::uint32_t> leaders_in_cubes(const Dots& dots, const CubesForDots& cubes);

/// The members of every cluster, the clusters in the order of their leaders.
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
    RowTable members_; ///< a dot, empty where it does not lead
    std::vector<std::uint32_t> leaders_;
};

/// Points, and of how many read ones each was made.
struct MergedPoints {
    Scene scene;
    std::vector<std::uint32_t> counts; ///< empty: of itself each
};

/// One point for every cluster, in their order: at the mean of its points, with the mean of their
/// colours and normals, all views that saw any, and error and id of the leader. Cost: O(points +
/// sights), in parallel.
MergedPoints merge_points(const MergedPoints& points, const Clusters& clusters);

/// Adds points of the same views behind others, or makes them the first.
void append(MergedPoints& points, MergedPoints more);

} // namespace vcarve
