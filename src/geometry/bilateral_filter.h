#pragma once

#include "base/parallel.h"
#include "geometry/nearest_neighbors.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace vcarve {

/// The logarithm of how the share of a neighbour falls with its distance, if the farthest is within
/// the root of `reach_sq`. Logarithms, so that one exponential does for a product.
double log_nearness(double distance_sq, double reach_sq);

/// Unit normals filtered once, with weights by nearness and likeness (Jones, Durand, Zwicker,
/// "Normal improvement for point rendering", CG&A 2004). A normal may be zero, and stays so if all
/// around are. Cost: O(points x neighbours), in parallel.
std::vector<Eigen::Vector3d> filtered_normals(std::span<const Eigen::Vector3d> positions,
                                              std::span<const Eigen::Vector3d> normals,
                                              const Neighborhoods& neighborhoods);

/// How far a point lies above the surface, and how uncertain the surface is there.
struct Height {
    double value = 0.0;
    double variance = 0.0; ///< at a pixel
};

/// The bilateral filter of Fleishman, Drori, Cohen-Or ("Bilateral mesh denoising", SIGGRAPH 2003)
/// for points whose uncertainty is known: a point is held against the planes through those around
/// it, across their normals, each as much as it is near, like in its normal, and certain.
class BilateralFilter {
  public:
    /// Of points with unit `normals` of the surface there. covariance_of(i) is what noise of one
    /// pixel makes of a point, zero where it says nothing of where the surface is. Holds a
    /// reference to the positions. Cost: a call for each point, in parallel.
    template <typename Covariance>
    BilateralFilter(std::span<const Eigen::Vector3d> positions,
                    std::vector<Eigen::Vector3d> normals, Neighborhoods neighborhoods,
                    const Covariance& covariance_of)
        : positions_(positions),
          normals_(std::move(normals)),
          neighborhoods_(std::move(neighborhoods)),
          spreads_(positions.size()),
          variances_(positions.size())
    {
        parallel_for(positions.size(), [&](std::size_t i) {
            const Eigen::Matrix3d covariance = covariance_of(i);
            spreads_[i] = covariance * normals_[i];
            variances_[i] = normals_[i].dot(spreads_[i]);
        });
    }

    /// Planes count less, the farther they are for `gate` pixels of noise, and not if they are much
    /// farther. Cost: O(neighbours).
    Height height(std::size_t point, double gate) const;

    /// Where a point most likely is, from itself and the planes; it is no more than `gate` times
    /// what a pixel makes of its uncertainty from where it was. Cost: O(neighbours).
    Eigen::Vector3d estimate(std::size_t point, double gate) const;

    /// The standard deviation of the points' places in images, in pixels: the median height above
    /// planes however far, over what one pixel makes of it, of the points that say where the
    /// surface is; of many, of every n-th. Cost: O(points x neighbours), in parallel.
    double noise_px() const;

    /// The same of their heights, over the distances between points: the median.
    double noise_in_spacings() const;

  private:
    std::span<const Eigen::Vector3d> positions_;
    std::vector<Eigen::Vector3d> normals_;
    Neighborhoods neighborhoods_;
    std::vector<Eigen::Vector3d> spreads_; ///< the covariance times the normal
    std::vector<double> variances_;        ///< along the normal
};

} // namespace vcarve
