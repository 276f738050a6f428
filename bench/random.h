#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <random>

namespace vcarve::bench {

/// Random numbers that are the same with every standard library. The standard specifies the engine,
/// but not the distributions of <random>.
class Random {
  public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}

    /// In [0, 1), in steps of 2^-53.
    double uniform() { return static_cast<double>(engine_() >> 11U) * 0x1p-53; }
    double uniform(double low, double high) { return low + (high - low) * uniform(); }

    /// In [0, count).
    std::size_t below(std::size_t count)
    {
        return static_cast<std::size_t>(uniform() * static_cast<double>(count));
    }

    /// Approximately normal with mean 0 and variance 1: a sum of twelve, without tails beyond 6.
    double normal()
    {
        double sum = -6.0;
        for (int i = 0; i < 12; ++i) {
            sum += uniform();
        }
        return sum;
    }

    Eigen::Vector3d normal_3d()
    {
        const double x = normal();
        const double y = normal();
        return {x, y, normal()};
    }

    /// Uniform on the unit sphere.
    Eigen::Vector3d direction()
    {
        while (true) {
            const double x = uniform(-1.0, 1.0);
            const double y = uniform(-1.0, 1.0);
            const Eigen::Vector3d inside(x, y, uniform(-1.0, 1.0));
            const double length = inside.norm();
            if (length > 0.1 && length <= 1.0) return inside / length;
        }
    }

  private:
    std::mt19937_64 engine_;
};

} // namespace vcarve::bench
