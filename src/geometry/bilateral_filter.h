#pragma once

#include "geometry/neighborhoods.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <span>
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

/// Points of a surface that are known up to noise; one entry a point in each array. Holds
/// references.
struct NoisyPoints {
    std::span<const Eigen::Vector3d> positions;
    std::span<const Eigen::Vector3d> normals; ///< unit, of the surface
    /// What noise of one pixel makes of a point: its covariance times the normal, and that along
    /// the normal. Zero where a point says nothing of where the surface is.
    std::span<const Eigen::Vector3d> spreads;
    std::span<const double> variances;
};

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
    BilateralFilter(const NoisyPoints& points, const Neighborhoods& neighborhoods)
        : points_(points), neighborhoods_(neighborhoods)
    {
    }

    /// Planes count less, the farther they are for `gate` pixels of noise, and not if they are much
    /// farther. Cost: O(neighbours).
    Height height(std::size_t point, double gate) const;

    /// Where a point most likely is, from itself and the planes; it is no more than `gate` times
    /// what a pixel makes of its uncertainty from where it was. Cost: O(neighbours).
    Eigen::Vector3d estimate(std::size_t point, double gate) const;

    /// The standard deviation of the points' places in images, in pixels: the median height above
    /// planes however far, over what one pixel makes of it, of the points that say where the
    /// surface is; of many, of every so manieth. Cost: O(points x neighbours), in parallel.
    double noise_px() const;

  private:
    NoisyPoints points_;
    const Neighborhoods& neighborhoods_;
};

} // namespace vcarve
