#include "steps/3_cells/sphere_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vcarve {

namespace {

using Eigen::Vector3d;

constexpr double kRounding = 0x1p-53;

template <typename Number>
using Vector3 = Eigen::Matrix<Number, 3, 1>;

/// The cross product with sums instead of differences, which bounds its rounding errors if both
/// vectors have no negative component.
template <typename Number>
Vector3<Number> cross_bound(const Vector3<Number>& a, const Vector3<Number>& b)
{
    return {a.y() * b.z() + a.z() * b.y(), a.z() * b.x() + a.x() * b.z(),
            a.x() * b.y() + a.y() * b.x()};
}

} // namespace

/// A difference of two coordinates has one rounding error. A product of k factors has k, and one
/// per multiplication; each sum adds one. So 16 for D, of three factors, and 24 for N, of four, are
/// more than enough. The other terms are for rounding both to doubles, and for the few operations
/// of the polynomial.
template <typename Number>
SphereBound SphereBound::computed(const std::array<Vector3d, 4>& corners)
{
    const Vector3<Number> origin = corners[0].cast<Number>();
    const Vector3<Number> b = corners[1].cast<Number>() - origin;
    const Vector3<Number> c = corners[2].cast<Number>() - origin;
    const Vector3<Number> d = corners[3].cast<Number>() - origin;
    const Vector3<Number> cd = c.cross(d);
    const Number volume = b.dot(cd);
    const Vector3<Number> normal =
        b.squaredNorm() * cd + c.squaredNorm() * d.cross(b) + d.squaredNorm() * b.cross(c);

    const Vector3<Number> bs = b.cwiseAbs();
    const Vector3<Number> cs = c.cwiseAbs();
    const Vector3<Number> ds = d.cwiseAbs();
    const Vector3<Number> cds = cross_bound(cs, ds);
    const Vector3<Number> normal_terms = b.squaredNorm() * cds +
                                         c.squaredNorm() * cross_bound(ds, bs) +
                                         d.squaredNorm() * cross_bound(bs, cs);
    const Number unit = std::numeric_limits<Number>::epsilon() / 2;

    SphereBound bound;
    bound.corner_ = corners[0];
    bound.volume_ = static_cast<double>(volume);
    bound.normal_ = normal.template cast<double>();
    bound.volume_error_ =
        static_cast<double>(16 * unit * bs.dot(cds)) + 16.0 * kRounding * std::abs(bound.volume_);
    bound.normal_error_ = (24 * unit * normal_terms).template cast<double>() +
                          16.0 * kRounding * bound.normal_.cwiseAbs();
    if (bound.volume_ > 0.0) bound.center_ = bound.normal_ / (2.0 * bound.volume_);
    return bound;
}

bool SphereBound::is_flat() const
{
    return volume_ < 256.0 * volume_error_;
}

SphereBound SphereBound::around(const std::array<Vector3d, 4>& corners)
{
    const SphereBound bound = computed<double>(corners);
    return bound.is_flat() ? computed<long double>(corners) : bound;
}

SphereBound SphereBound::beyond(const std::array<Vector3d, 3>& corners)
{
    const Vector3d b = corners[1] - corners[0];
    const Vector3d c = corners[2] - corners[0];
    SphereBound bound;
    bound.corner_ = corners[0];
    bound.normal_ = b.cross(c);
    bound.normal_error_ = kRounding * (8.0 * cross_bound<double>(b.cwiseAbs(), c.cwiseAbs()) +
                                       16.0 * bound.normal_.cwiseAbs());
    return bound;
}

SphereBound SphereBound::within(const Box& all) const
{
    SphereBound bound = *this;
    bound.most_error_ = error_in(all);
    return bound;
}

bool SphereBound::is_within(double distance) const
{
    // Two points of the sphere are at most a diameter apart.
    const double diameter_times_volume = normal_.norm() + normal_error_.norm();
    return volume_ > 2.0 * volume_error_ &&
           diameter_times_volume < 0.999 * distance * (volume_ - volume_error_);
}

} // namespace vcarve
