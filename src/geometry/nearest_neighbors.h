#pragma once

#include "base/progress.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <span>
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

  private:
    struct Search;
    std::unique_ptr<Search> search_;
};

/// For every point those around it, up to so many, and how far they reach. Takes 4 bytes for each
/// of them, and 12 a point.
class Neighborhoods {
  public:
    /// Every point is alone.
    Neighborhoods(std::size_t num_points, std::size_t most)
        : most_(most), points_(num_points * most), counts_(num_points), reaches_sq_(num_points)
    {
    }

    /// Puts up to `most` points around a point, within the root of `reach_sq` of it. Safe from many
    /// threads for different points.
    void set(std::size_t point, std::span<const std::uint32_t> around, double reach_sq);

    std::span<const std::uint32_t> around(std::size_t point) const
    {
        return {points_.data() + most_ * point, counts_[point]};
    }
    /// The square of how far they reach; 0 of a point that is alone.
    double reach_sq(std::size_t point) const { return reaches_sq_[point]; }

    /// The square of how far points stand apart where the surface is flat.
    double spacing_sq(std::size_t point) const
    {
        return reaches_sq_[point] * std::numbers::pi / static_cast<double>(counts_[point]);
    }

  private:
    std::size_t most_;
    std::vector<std::uint32_t> points_;
    std::vector<std::uint32_t> counts_;
    std::vector<double> reaches_sq_;
};

/// The `count` points nearest to each of at least two, no two at one place, or all others where
/// there are fewer; they reach to the farthest. Cost: O(points x (log points + count)), in
/// parallel.
Neighborhoods nearest_neighborhoods(const std::vector<Eigen::Vector3d>& positions,
                                    std::size_t count, const Progress& progress = {});

} // namespace vcarve
