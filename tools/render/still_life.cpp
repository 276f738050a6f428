#include "render/still_life.h"

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <numbers>

namespace vcarve::render {

namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

/// Adds one part after the other, each with faces counter-clockwise seen from outside.
class Builder {
  public:
    void begin_part(const Eigen::Array3f& tint) { scene_.tint_of_part.push_back(tint); }

    std::uint32_t next_vertex() const
    {
        return static_cast<std::uint32_t>(scene_.mesh.positions.size());
    }

    std::uint32_t vertex(const Eigen::Vector3d& position)
    {
        scene_.mesh.positions.push_back(position);
        return static_cast<std::uint32_t>(scene_.mesh.positions.size() - 1);
    }

    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c)
    {
        scene_.mesh.faces.push_back({a, b, c});
        scene_.part_of_face.push_back(static_cast<std::uint32_t>(scene_.tint_of_part.size() - 1));
    }

    void quad(const std::array<std::uint32_t, 4>& v)
    {
        triangle(v[0], v[1], v[2]);
        triangle(v[0], v[2], v[3]);
    }

    StillLife take() { return std::move(scene_); }

  private:
    StillLife scene_;
};

/// A box of the given size that stands on its place, turned about the vertical.
struct StandingBox {
    Eigen::Vector3d place; ///< middle of its bottom
    Eigen::Vector3d size;
    double turn_deg = 0.0;
};

void add_box(Builder& builder, const StandingBox& box, const Eigen::Array3f& tint)
{
    builder.begin_part(tint);
    const Eigen::AngleAxisd turn(box.turn_deg * kTwoPi / 360.0, Eigen::Vector3d::UnitZ());
    std::array<std::uint32_t, 8> v;
    for (int i = 0; i < 8; ++i) {
        const Eigen::Vector3d share((i & 1) - 0.5, ((i >> 1) & 1) - 0.5, (i >> 2) & 1);
        v[i] = builder.vertex(box.place + turn * share.cwiseProduct(box.size));
    }
    builder.quad({v[0], v[2], v[3], v[1]});
    builder.quad({v[4], v[5], v[7], v[6]});
    builder.quad({v[0], v[1], v[5], v[4]});
    builder.quad({v[2], v[6], v[7], v[3]});
    builder.quad({v[0], v[4], v[6], v[2]});
    builder.quad({v[1], v[3], v[7], v[5]});
}

void add_sphere(Builder& builder, const Eigen::Vector3d& middle, double radius,
                const Eigen::Array3f& tint)
{
    constexpr int kRings = 24;
    constexpr int kSteps = 48;
    builder.begin_part(tint);
    const std::uint32_t bottom = builder.vertex(middle - radius * Eigen::Vector3d::UnitZ());
    const std::uint32_t first = builder.next_vertex();
    for (int ring = 1; ring < kRings; ++ring) {
        const double tilt = -kTwoPi / 4 + kTwoPi / 2 * ring / kRings;
        for (int step = 0; step < kSteps; ++step) {
            const double turn = kTwoPi * step / kSteps;
            const Eigen::Vector3d way(std::cos(tilt) * std::cos(turn),
                                      std::cos(tilt) * std::sin(turn), std::sin(tilt));
            builder.vertex(middle + radius * way);
        }
    }
    const std::uint32_t top = builder.vertex(middle + radius * Eigen::Vector3d::UnitZ());
    const auto at = [&](int ring, int step) { return first + (ring - 1) * kSteps + step % kSteps; };
    for (int step = 0; step < kSteps; ++step) {
        builder.triangle(bottom, at(1, step + 1), at(1, step));
        for (int ring = 1; ring + 1 < kRings; ++ring) {
            builder.quad(
                {at(ring, step), at(ring, step + 1), at(ring + 1, step + 1), at(ring + 1, step)});
        }
        builder.triangle(at(kRings - 1, step), at(kRings - 1, step + 1), top);
    }
}

/// A ring that stands upright, its hole seen along y.
void add_ring(Builder& builder, const Eigen::Vector3d& middle, const Eigen::Vector2d& radii,
              const Eigen::Array3f& tint)
{
    constexpr int kAround = 64;
    constexpr int kAcross = 24;
    builder.begin_part(tint);
    const std::uint32_t first = builder.next_vertex();
    for (int i = 0; i < kAround; ++i) {
        const double around = kTwoPi * i / kAround;
        const Eigen::Vector3d out(std::cos(around), 0.0, std::sin(around));
        for (int k = 0; k < kAcross; ++k) {
            const double across = kTwoPi * k / kAcross;
            builder.vertex(middle + (radii[0] + radii[1] * std::cos(across)) * out +
                           radii[1] * std::sin(across) * Eigen::Vector3d::UnitY());
        }
    }
    const auto at = [&](int i, int k) { return first + (i % kAround) * kAcross + k % kAcross; };
    for (int i = 0; i < kAround; ++i) {
        for (int k = 0; k < kAcross; ++k) {
            builder.quad({at(i, k), at(i, k + 1), at(i + 1, k + 1), at(i + 1, k)});
        }
    }
}

} // namespace

StillLife still_life()
{
    Builder builder;
    add_box(builder, {{0.0, 0.1, -0.1}, {4.0, 3.0, 0.1}}, {0.80F, 0.74F, 0.64F}); // floor
    add_box(builder, {{0.0, 1.65, 0.0}, {4.0, 0.1, 2.0}}, {0.74F, 0.80F, 0.86F}); // wall
    add_box(builder, {{-0.85, 0.45, 0.0}, {0.7, 0.6, 0.55}, 20.0}, {0.86F, 0.45F, 0.36F});
    add_box(builder, {{0.75, 0.75, 0.0}, {0.6, 0.5, 1.05}, -15.0}, {0.42F, 0.62F, 0.82F});
    add_box(builder, {{0.05, -0.25, 0.0}, {0.04, 0.7, 0.6}, 55.0}, {0.90F, 0.78F, 0.36F}); // panel
    add_box(builder, {{0.05, 1.1, 0.0}, {0.25, 0.25, 0.3}, 35.0}, {0.66F, 0.50F, 0.76F});
    add_sphere(builder, {-0.85, 0.45, 0.82}, 0.27, {0.46F, 0.76F, 0.50F}); // on the red box
    add_ring(builder, {0.9, -0.35, 0.32}, {0.24, 0.08}, {0.92F, 0.62F, 0.72F});
    return builder.take();
}

} // namespace vcarve::render
