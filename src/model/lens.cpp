#include "model/lens.h"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace vcarve {

namespace {

using enum LensGeometry;

constexpr std::array<LensModel, 20> kLenses{{
    {0, "SIMPLE_PINHOLE", 3, 1, perspective, false},
    {1, "PINHOLE", 4, 2, perspective, false},
    {2, "SIMPLE_RADIAL", 4, 1, perspective, true},
    {3, "RADIAL", 5, 1, perspective, true},
    {4, "OPENCV", 8, 2, perspective, true},
    {5, "OPENCV_FISHEYE", 8, 2, fisheye, true},
    {6, "FULL_OPENCV", 12, 2, perspective, true},
    {7, "FOV", 5, 2, fov, false},
    {8, "SIMPLE_RADIAL_FISHEYE", 4, 1, fisheye, true},
    {9, "RADIAL_FISHEYE", 5, 1, fisheye, true},
    {10, "THIN_PRISM_FISHEYE", 12, 2, fisheye, true},
    {11, "RAD_TAN_THIN_PRISM_FISHEYE", 16, 2, fisheye, true},
    {12, "SIMPLE_DIVISION", 4, 1, division, false},
    {13, "DIVISION", 5, 2, division, false},
    {14, "SIMPLE_FISHEYE", 3, 1, fisheye, false},
    {15, "FISHEYE", 4, 2, fisheye, false},
    {16, "EUCM", 6, 2, unified, false},
    {17, "EQUIRECTANGULAR", 2, 0, equirectangular, false},
    {18, "SKEWED_PINHOLE", 5, 2, perspective, false},
    {19, "BROWN_CONRADY", 8, 1, perspective, true},
}};

constexpr bool numbered_by_place()
{
    for (std::size_t i = 0; i < kLenses.size(); ++i) {
        if (kLenses[i].number != static_cast<int>(i)) return false;
    }
    return true;
}
static_assert(numbered_by_place());

constexpr int kMostSteps = 50;   ///< maximum Newton steps, and halvings per step
constexpr double kExact = 1e-13; ///< tolerance, relative to 1 + |target|
constexpr int kMostRounds = 200; ///< maximum rounds of the search for a turn
constexpr std::size_t kTerms = 20;

/// Coefficients by ascending power.
using Polynomial = std::array<double, kTerms>;

/// The value of 1 + c1 s + c2 s^2 + ... and its derivative.
struct Value {
    double value = 1.0;
    double derivative = 0.0;
};

template <std::size_t kSize>
Value one_plus(const std::array<double, kSize>& coefficients, double s)
{
    Value sum{0.0, 0.0};
    for (std::size_t i = kSize; i-- > 0;) {
        sum.derivative = sum.derivative * s + static_cast<double>(i + 1) * coefficients[i];
        sum.value = (sum.value + coefficients[i]) * s;
    }
    sum.value += 1.0;
    return sum;
}

/// N / D and its derivative with respect to s.
Value radial_factor(const LensDistortion& lens, double s)
{
    const Value numerator = one_plus(lens.radial, s);
    if (!lens.divides) return numerator;
    const Value divisor = one_plus(lens.divisor, s);
    const double factor = numerator.value / divisor.value;
    return {factor, (numerator.derivative - factor * divisor.derivative) / divisor.value};
}

/// The offset of a point by q, a and b.
Eigen::Vector2d offset(const LensDistortion& lens, const Eigen::Vector2d& at)
{
    const double s = at.squaredNorm();
    return s * (lens.tangential + lens.prism_s + s * lens.prism_ss) +
           2.0 * lens.tangential.dot(at) * at;
}

Eigen::Matrix2d offset_jacobian(const LensDistortion& lens, const Eigen::Vector2d& at)
{
    const Eigen::Vector2d& q = lens.tangential;
    const Eigen::Vector2d prism = lens.prism_s + 2.0 * at.squaredNorm() * lens.prism_ss;
    return 2.0 * ((q + prism) * at.transpose() + at * q.transpose() +
                  q.dot(at) * Eigen::Matrix2d::Identity());
}

Eigen::Matrix2d jacobian(const LensDistortion& lens, const Eigen::Vector2d& at)
{
    const Value factor = radial_factor(lens, at.squaredNorm());
    const Eigen::Matrix2d radial =
        factor.value * Eigen::Matrix2d::Identity() + 2.0 * factor.derivative * at * at.transpose();
    if (!lens.in_sequence) return radial + offset_jacobian(lens, at);
    const Eigen::Vector2d moved = factor.value * at;
    return radial + offset_jacobian(lens, moved) * radial;
}

/// The sum at t of the terms with positive coefficients; for sign -1, the negated sum of the terms
/// with negative ones. It never decreases with t.
double sum_of_terms(const Polynomial& polynomial, double sign, double t)
{
    double sum = 0.0;
    for (std::size_t i = kTerms; i-- > 0;)
        sum = sum * t + std::max(0.0, sign * polynomial[i]);
    return sum;
}

/// Whether the polynomial is positive on [0, 1]. It is positive on [from, to] if its positive terms
/// at `from` exceed its negative terms at `to`. May return false if the minimum is close to 0.
bool positive_to_one(const Polynomial& polynomial)
{
    double negative = 0.0;
    for (const double coefficient : polynomial)
        negative += std::min(0.0, coefficient);
    if (polynomial[0] + negative > 0.0) return true;

    double from = 0.0;
    double to = 1.0;
    for (int round = 0; round < kMostRounds; ++round) {
        const double negative_at_to = sum_of_terms(polynomial, -1.0, to);
        if (sum_of_terms(polynomial, 1.0, from) > negative_at_to) {
            if (to == 1.0) return true;
            const double length = to - from;
            from = to;
            to = std::min(1.0, from + 2.0 * length);
        } else if (!(sum_of_terms(polynomial, 1.0, to) > negative_at_to)) {
            return false;
        } else {
            to = from + (to - from) / 2.0;
        }
    }
    return false;
}

/// The terms 1, c1 s, c2 s^2, ...
template <std::size_t kSize>
std::array<double, kSize + 1> scaled(const std::array<double, kSize>& coefficients, double s)
{
    std::array<double, kSize + 1> result{1.0};
    double power = s;
    for (std::size_t i = 0; i < kSize; ++i, power *= s)
        result[i + 1] = coefficients[i] * power;
    return result;
}

/// The slope of the radial offset at t times a point, by t: the coefficients of t and t^3.
std::array<double, 2> offset_slope(const LensDistortion& lens, const Eigen::Vector2d& at)
{
    return {6.0 * lens.tangential.dot(at) + 2.0 * lens.prism_s.dot(at),
            4.0 * at.squaredNorm() * lens.prism_ss.dot(at)};
}

/// The derivative by t of the distorted radius of t times a point, divided by the radius of the
/// point and multiplied by D^2. `s` is the squared radius of the point.
Polynomial slope(const LensDistortion& lens, double s, const std::array<double, 2>& offset_terms)
{
    const auto numerator = scaled(lens.radial, s);
    const auto divisor = scaled(lens.divisor, s);
    const std::size_t divisor_terms = lens.divides ? divisor.size() : 1;
    Polynomial result{};
    for (std::size_t j = 0; j < divisor_terms; ++j) {
        for (std::size_t i = 0; i < numerator.size(); ++i) {
            const double factor = 2.0 * static_cast<double>(i) + 1.0 - 2.0 * static_cast<double>(j);
            result[2 * (i + j)] += factor * numerator[i] * divisor[j];
        }
        for (std::size_t i = 0; i < divisor_terms; ++i) {
            result[2 * (i + j) + 1] += offset_terms[0] * divisor[i] * divisor[j];
            result[2 * (i + j) + 3] += offset_terms[1] * divisor[i] * divisor[j];
        }
    }
    return result;
}

/// A lower bound of 1 plus the terms of an offset, for t up to 1.
double least_offset_slope(const std::array<double, 2>& offset_terms)
{
    return 1.0 - std::abs(offset_terms[0]) - std::abs(offset_terms[1]);
}

/// A fast sufficient test that most pixels pass: a lower bound of the slope is positive.
bool surely_before_turn(const LensDistortion& lens, double s,
                        const std::array<double, 2>& offset_terms)
{
    if (lens.divides) return false;
    double least = least_offset_slope(offset_terms);
    double power = s;
    for (std::size_t i = 0; i < lens.radial.size(); ++i, power *= s) {
        least += std::min(0.0, static_cast<double>(2 * i + 3) * lens.radial[i] * power);
    }
    return least > 0.0;
}

bool divisor_positive(const LensDistortion& lens, double s)
{
    if (!lens.divides) return true;
    Polynomial divisor{};
    std::ranges::copy(scaled(lens.divisor, s), divisor.begin());
    return positive_to_one(divisor);
}

} // namespace

const LensModel* lens_model(int number)
{
    if (number < 0 || static_cast<std::size_t>(number) >= kLenses.size()) return nullptr;
    return &kLenses[static_cast<std::size_t>(number)];
}

const LensModel* lens_model(std::string_view name)
{
    if (name == "SPHERICAL") name = "EQUIRECTANGULAR"; // OpenSfM's name
    const auto found = std::ranges::find(kLenses, name, &LensModel::name);
    return found == kLenses.end() ? nullptr : &*found;
}

Eigen::Vector2d distort(const LensDistortion& lens, const Eigen::Vector2d& point)
{
    const Eigen::Vector2d moved = radial_factor(lens, point.squaredNorm()).value * point;
    return moved + offset(lens, lens.in_sequence ? moved : point);
}

bool before_turn(const LensDistortion& lens, const Eigen::Vector2d& point)
{
    const double s = point.squaredNorm();
    std::array<double, 2> offset_terms{};
    if (!lens.in_sequence) offset_terms = offset_slope(lens, point);
    const bool radially =
        surely_before_turn(lens, s, offset_terms) ||
        (divisor_positive(lens, s) && positive_to_one(slope(lens, s, offset_terms)));
    if (!radially || !lens.in_sequence) return radially;
    offset_terms = offset_slope(lens, radial_factor(lens, s).value * point);
    return least_offset_slope(offset_terms) > 0.0 ||
           positive_to_one({1.0, offset_terms[0], 0.0, offset_terms[1]});
}

Eigen::Vector2d undistort(const LensDistortion& lens, const Eigen::Vector2d& target)
{
    Eigen::Vector2d at = target;
    const auto too_far = [&] {
        return distort(lens, at).norm() > 2.0 * target.norm() || !before_turn(lens, at);
    };
    for (int i = 0; i < kMostSteps && too_far(); ++i)
        at *= 0.75;
    Eigen::Vector2d miss = distort(lens, at) - target;
    for (int i = 0; i < kMostSteps && miss.norm() > kExact * (1.0 + target.norm()); ++i) {
        Eigen::Vector2d step = jacobian(lens, at).inverse() * miss;
        const auto nearer = [&] {
            return (distort(lens, at - step) - target).norm() < miss.norm() &&
                   before_turn(lens, at - step);
        };
        for (int j = 0; j < kMostSteps && !nearer(); ++j)
            step /= 2.0;
        if (!nearer()) break;
        at -= step;
        miss = distort(lens, at) - target;
    }
    return at;
}

} // namespace vcarve
