#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace vcarve {

/// Finds the points nearest to a place, by CGAL's k-d tree.
class NearestNeighbors {
  public:
    /// Cost: O(points log points), in parallel.
    explicit NearestNeighbors(const std::vector<Eigen::Vector3d>& points);
    ~NearestNeighbors();
    NearestNeighbors(NearestNeighbors&&) noexcept;
    NearestNeighbors& operator=(NearestNeighbors&&) = delete;

    struct Neighbor {
        std::uint32_t point;
        double distance_sq;
    };

    /// Fills `nearest` with the `count` points nearest to a place, or all if there are fewer, the
    /// nearest first. Which of points equally far are left out depends on the points alone. Safe
    /// from many threads. Cost: O(log points + count).
    void find(const Eigen::Vector3d& place, std::size_t count,
              std::vector<Neighbor>& nearest) const;
    /// Whether any point is nearer to a place than so far. Safe from many threads. Cost: O(log
    /// points).
    bool has_nearer(const Eigen::Vector3d& place, double distance) const;

  private:
    struct Search;
    std::unique_ptr<Search> search_;
};

} // namespace vcarve
