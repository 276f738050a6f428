#include "sample_shapes.h"

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <numbers>

namespace vcarve::bench {

namespace {

using Eigen::Vector3d;

constexpr std::uint64_t kImageSizePx = 4000;
constexpr double kFocalPx = 4000.0;

/// A sum of waves a sin(k . x + phase).
class Waves {
  public:
    double at(const Vector3d& x) const
    {
        double sum = 0.0;
        for (const Wave& wave : kWaves) {
            sum += wave.height * std::sin(wave.vector().dot(x) + wave.phase);
        }
        return sum;
    }

    Vector3d gradient_at(const Vector3d& x) const
    {
        Vector3d sum = Vector3d::Zero();
        for (const Wave& wave : kWaves) {
            sum += wave.height * std::cos(wave.vector().dot(x) + wave.phase) * wave.vector();
        }
        return sum;
    }

    static constexpr double kHighest = 0.15;

  private:
    struct Wave {
        double height;
        std::array<double, 3> k;
        double phase;
        Vector3d vector() const { return {k[0], k[1], k[2]}; }
    };
    static constexpr std::array<Wave, 4> kWaves = {{{0.06, {3.0, -2.0, 1.5}, 0.3},
                                                    {0.04, {-2.0, 5.0, 3.0}, 1.1},
                                                    {0.03, {6.0, 4.0, -5.0}, 2.0},
                                                    {0.02, {-7.0, 8.0, 6.0}, 0.7}}};
};

View view_towards(const Vector3d& center, const Vector3d& target, const Vector3d& up)
{
    const Vector3d forward = (target - center).normalized();
    const Vector3d right = forward.cross(up).normalized();
    Eigen::Matrix3d cam_from_world;
    cam_from_world << right.transpose(), forward.cross(right).transpose(), forward.transpose();
    View view;
    view.center = center;
    view.cam_from_world = Eigen::Quaterniond(cam_from_world).normalized();
    return view;
}

class BumpyBall final : public SampleShape {
  public:
    Spot spot(Random& random) const override
    {
        const Vector3d out = random.direction();
        const Vector3d slope = waves_.gradient_at(out);
        const double radius = 1.0 + waves_.at(out);
        const Vector3d normal = out - (slope - out.dot(slope) * out) / radius;
        return {radius * out, normal.normalized()};
    }

    Vector3d vantage(const Spot& spot, Random& random) const override
    {
        return kDistance * (spot.normal + 0.3 * random.normal_3d()).normalized();
    }

    double height_above(const Vector3d& place) const override
    {
        const double radius = place.norm();
        return radius - 1.0 - waves_.at(place / radius);
    }

    Eigen::AlignedBox3d box() const override
    {
        const Vector3d corner = Vector3d::Constant(1.0 + Waves::kHighest);
        return {-corner, corner};
    }

    double area() const override { return 4.0 * std::numbers::pi; }

    std::vector<View> views(std::size_t count) const override
    {
        // Along a spiral, about evenly
        const double turn = std::numbers::pi * (3.0 - std::sqrt(5.0));
        std::vector<View> views;
        for (std::size_t i = 0; i < count; ++i) {
            const double z =
                1.0 - (2.0 * static_cast<double>(i) + 1.0) / static_cast<double>(count);
            const double ring = std::sqrt(1.0 - z * z);
            const double angle = turn * static_cast<double>(i);
            const Vector3d out(ring * std::cos(angle), ring * std::sin(angle), z);
            const Vector3d up = std::abs(z) < 0.9 ? Vector3d::UnitZ() : Vector3d::UnitX();
            views.push_back(view_towards(kDistance * out, Vector3d::Zero(), up));
        }
        return views;
    }

  private:
    static constexpr double kDistance = 3.0;
    Waves waves_;
};

class Terrain final : public SampleShape {
  public:
    Spot spot(Random& random) const override
    {
        const double x = random.uniform(-1.0, 1.0);
        const Vector3d ground(x, random.uniform(-1.0, 1.0), 0.0);
        const Vector3d slope = waves_.gradient_at(ground);
        return {ground + waves_.at(ground) * Vector3d::UnitZ(),
                Vector3d(-slope.x(), -slope.y(), 1.0).normalized()};
    }

    Vector3d vantage(const Spot& spot, Random& random) const override
    {
        const double x = spot.position.x() + 0.1 * random.normal();
        return {x, spot.position.y() + 0.1 * random.normal(), kAltitude};
    }

    double height_above(const Vector3d& place) const override
    {
        return place.z() - waves_.at({place.x(), place.y(), 0.0});
    }

    Eigen::AlignedBox3d box() const override
    {
        return {Vector3d(-1.0, -1.0, -Waves::kHighest), Vector3d(1.0, 1.0, Waves::kHighest)};
    }

    double area() const override { return 4.0; }

    std::vector<View> views(std::size_t count) const override
    {
        // Within a strip the views overlap more than the strips do
        const auto strips = static_cast<std::size_t>(std::ceil(std::sqrt(0.6 * double(count))));
        const std::size_t per_strip = (count + strips - 1) / strips;
        const auto place = [](std::size_t i, std::size_t of) {
            return 2.0 * (static_cast<double>(i) + 0.5) / static_cast<double>(of) - 1.0;
        };
        std::vector<View> views;
        for (std::size_t i = 0; i < count; ++i) {
            const Vector3d center(place(i % per_strip, per_strip), place(i / per_strip, strips),
                                  kAltitude);
            views.push_back(view_towards(center, center - Vector3d::UnitZ(), Vector3d::UnitY()));
        }
        return views;
    }

  private:
    static constexpr double kAltitude = 0.7;
    Waves waves_;
};

} // namespace

std::unique_ptr<SampleShape> bumpy_ball()
{
    return std::make_unique<BumpyBall>();
}

std::unique_ptr<SampleShape> terrain()
{
    return std::make_unique<Terrain>();
}

Camera sample_camera()
{
    constexpr double kMiddlePx = 0.5 * static_cast<double>(kImageSizePx);
    return {.id = 1,
            .model = 1, // PINHOLE
            .width_px = kImageSizePx,
            .height_px = kImageSizePx,
            .params = {kFocalPx, kFocalPx, kMiddlePx, kMiddlePx}};
}

Vector3d in_camera(const View& view, const Vector3d& place)
{
    return view.cam_from_world * (place - view.center);
}

Eigen::Vector2d in_image(const Vector3d& place_in_camera)
{
    constexpr double kMiddlePx = 0.5 * static_cast<double>(kImageSizePx);
    return kFocalPx * place_in_camera.head<2>() / place_in_camera.z() +
           Eigen::Vector2d::Constant(kMiddlePx);
}

} // namespace vcarve::bench
