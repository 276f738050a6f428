#include "sample_shapes.h"

#include <Eigen/Geometry>

#include <algorithm>
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
        // On a spiral, approximately evenly
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
        // Views in a strip overlap more than strips.
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

/// Four walls, floor, ceiling and columns, with free space between them.
class Hall final : public SampleShape {
  public:
    Spot spot(Random& random) const override
    {
        const double part = random.uniform() * area();
        if (part < kColumnsArea) return column_spot(random);
        if (part < kColumnsArea + 2.0 * kFloorArea) return floor_spot(random);
        return wall_spot(random);
    }

    Vector3d vantage(const Spot& spot, Random& random) const override
    {
        const double distance = random.uniform(0.5, 1.5);
        return spot.position + distance * (spot.normal + 0.5 * random.normal_3d()).normalized();
    }

    double height_above(const Vector3d& place) const override
    {
        double height = kHalfHeight - std::abs(place.z());
        height = std::min(height, 1.0 - place.head<2>().cwiseAbs().maxCoeff());
        for (const auto& column : kColumns) {
            const Eigen::Vector2d axis(column[0], column[1]);
            height = std::min(height, (place.head<2>() - axis).norm() - kColumnRadius);
        }
        return height;
    }

    Eigen::AlignedBox3d box() const override
    {
        const Vector3d corner(1.0, 1.0, kHalfHeight);
        return {-corner, corner};
    }

    double area() const override { return kColumnsArea + 2.0 * kFloorArea + kWallsArea; }

    std::vector<View> views(std::size_t count) const override
    {
        // On a path around and between the columns, while the heading turns
        std::vector<View> views;
        for (std::size_t i = 0; i < count; ++i) {
            const double along =
                2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
            const double ring = 0.5 + 0.3 * std::sin(7.0 * along);
            const Vector3d center(ring * std::cos(along), ring * std::sin(along), 0.1);
            const double heading = kTurns * along;
            const double pitch = 0.6 * std::sin(3.0 * heading);
            const Vector3d ahead(std::cos(heading), std::sin(heading), pitch);
            views.push_back(view_towards(center, center + ahead, Vector3d::UnitZ()));
        }
        return views;
    }

  private:
    static Spot column_spot(Random& random)
    {
        const auto& axis = kColumns[random.below(kColumns.size())];
        const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
        const Vector3d normal(std::cos(angle), std::sin(angle), 0.0);
        const Vector3d middle(axis[0], axis[1], random.uniform(-kHalfHeight, kHalfHeight));
        return {middle + kColumnRadius * normal, normal};
    }

    static Spot floor_spot(Random& random)
    {
        const double side = random.below(2) == 0 ? -1.0 : 1.0;
        const double x = random.uniform(-1.0, 1.0);
        return {{x, random.uniform(-1.0, 1.0), side * kHalfHeight}, -side * Vector3d::UnitZ()};
    }

    static Spot wall_spot(Random& random)
    {
        const double side = random.below(2) == 0 ? -1.0 : 1.0;
        const bool along_x = random.below(2) == 0;
        const double along = random.uniform(-1.0, 1.0);
        const double z = random.uniform(-kHalfHeight, kHalfHeight);
        if (along_x) return {{along, side, z}, -side * Vector3d::UnitY()};
        return {{side, along, z}, -side * Vector3d::UnitX()};
    }

    static constexpr double kTurns = 3.0; ///< full turns of the heading along the path
    static constexpr double kHalfHeight = 0.4;
    static constexpr double kColumnRadius = 0.1;
    static constexpr std::array<std::array<double, 2>, 4> kColumns = {
        {{-0.5, -0.5}, {-0.5, 0.5}, {0.5, -0.5}, {0.5, 0.5}}};
    static constexpr double kFloorArea = 4.0;
    static constexpr double kWallsArea = 8.0 * 2.0 * kHalfHeight;
    static constexpr double kColumnsArea =
        4.0 * 2.0 * std::numbers::pi * kColumnRadius * 2.0 * kHalfHeight;
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

std::unique_ptr<SampleShape> hall()
{
    return std::make_unique<Hall>();
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
