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

/// The log-weight of a neighbor at a distance; `reach_sq` is the square of the distance to the
/// farthest neighbor. Log-weights are added, so that a product needs only one exponential.
double log_nearness(double distance_sq, double reach_sq);

/// Filters unit normals once, weighted by distance and similarity (Jones, Durand, Zwicker, "Normal
/// improvement for point rendering", CG&A 2004). A zero normal stays zero if all its neighbors'
/// normals are zero. Cost: O(points x neighbors), in parallel.
std::vector<Eigen::Vector3d> filtered_normals(std::span<const Eigen::Vector3d> positions,
                                              std::span<const Eigen::Vector3d> normals,
                                              const Neighborhoods& neighborhoods);

/// The height of a point above the surface, and the variance of the surface there.
struct Height {
    double value = 0.0;
    double variance = 0.0; ///< for noise of one pixel
};

/// The bilateral filter of Fleishman, Drori, Cohen-Or ("Bilateral mesh denoising", SIGGRAPH 2003)
/// for points with known covariances. A point is compared with the planes of its neighbors. Weights
/// of planes depend on distance, similarity of normals, and variance.
class BilateralFilter {
  public:
    /// `normals` are unit normals of the surface. covariance_of(i) is the covariance of a point for
    /// noise of one pixel, or zero if it is unknown. Keeps a reference to the positions. Calls
    /// covariance_of once per point, in parallel.
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

    /// The height above the planes of the neighbors. Weights of planes fall with their distance, as
    /// a Gaussian of `gate` pixels of noise. Zero if all are much farther. Cost: O(neighbors).
    Height height(std::size_t point, double gate) const;

    /// The most likely position of a point, given its own position and the planes. It moves by at
    /// most `gate` standard deviations for noise of one pixel. Cost: O(neighbors).
    Eigen::Vector3d estimate(std::size_t point, double gate) const;

    /// The standard deviation of image positions, in pixels: the median height above planes at any
    /// distance, divided by its standard deviation for one pixel. Points of unknown covariance are
    /// ignored, and large sets are subsampled. Cost: O(points x neighbors), in parallel.
    double noise_px() const;

    /// The median standard deviation of heights, in units of the local spacing of points.
    double noise_in_spacings() const;

  private:
    std::span<const Eigen::Vector3d> positions_;
    std::vector<Eigen::Vector3d> normals_;
    Neighborhoods neighborhoods_;
    std::vector<Eigen::Vector3d> spreads_; ///< the covariance times the normal
    std::vector<double> variances_;        ///< along the normal
};

} // namespace vcarve
