#include "figures/timed_object.h"

#include "paper/box_solid.h"
#include "paper/sample_surface.h"
#include "steps/1_points/arrange.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

namespace vcarve::paper {

namespace {

const BoxSolid& block_with_a_pit()
{
    static const BoxSolid solid({{0, 0, 0, 4, 4, 2.5}, // below the pit
                                 {0, 0, 2.5, 1.5, 4, 3},
                                 {2.5, 0, 2.5, 4, 4, 3},
                                 {1.5, 0, 2.5, 2.5, 1.5, 3},
                                 {1.5, 2.5, 2.5, 2.5, 4, 3}});
    return solid;
}

/// Samples whose triangulation fits the solid.
std::vector<Spot> fitting_spots()
{
    constexpr int kMostSeeds = 1000;
    constexpr std::int64_t kAnyRadius = 1000 * kSpotsPerUnit;
    for (int seed = 1; seed <= kMostSeeds; ++seed) {
        std::mt19937_64 random(seed);
        std::vector<Spot> spots = sample_surface(block_with_a_pit(), kAnyRadius, random);
        if (spots.size() == kPapersPoints && triangulate(block_with_a_pit(), spots)) return spots;
    }
    throw std::runtime_error(
        "no sampling of the block with a pit has the required number of points");
}

/// Random positions on the surface, uniform by area.
class SurfaceSpots {
  public:
    explicit SurfaceSpots(std::uint64_t seed) : random_(seed) {}

    Spot next()
    {
        const BoxSolid& solid = block_with_a_pit();
        while (true) {
            // A position in the bounding box, projected along an axis onto one of the planes.
            const Side& side = sides_[below(sides_.size())];
            Spot spot;
            for (int k = 0; k < 3; ++k) {
                spot[k] = solid.low()[k] + below(solid.high()[k] - solid.low()[k]);
            }
            spot[side.axis] = side.plane;
            // If two sides share a plane, a position hits only one of them.
            if (below(largest_) < area_of(side.axis) && solid.on_side(side, 3 * spot)) return spot;
        }
    }

  private:
    std::int64_t below(std::int64_t end)
    {
        return static_cast<std::int64_t>(random_() % static_cast<std::uint64_t>(end));
    }

    /// The area of the bounding box perpendicular to an axis.
    static std::int64_t area_of(int axis)
    {
        const Spot size = block_with_a_pit().high() - block_with_a_pit().low();
        return size[(axis + 1) % 3] * size[(axis + 2) % 3];
    }

    std::mt19937_64 random_;
    std::vector<Side> sides_ = block_with_a_pit().sides();
    std::int64_t largest_ = std::max({area_of(0), area_of(1), area_of(2)});
};

std::vector<Spot> spread_spots(std::size_t count)
{
    SurfaceSpots surface(count);
    std::vector<Spot> spots;
    while (spots.size() < count) {
        while (spots.size() < count) {
            spots.push_back(surface.next());
        }
        std::ranges::sort(spots, [](const Spot& a, const Spot& b) {
            return std::ranges::lexicographical_compare(a, b);
        });
        spots.erase(std::unique(spots.begin(), spots.end()), spots.end());
    }
    return spots;
}

/// The van der Corput sequence: each number between 0 and 1 halves the largest gap.
double halving(std::size_t i)
{
    double share = 0.0;
    for (double step = 0.5; i > 0; i /= 2, step /= 2.0) {
        share += static_cast<double>(i % 2) * step;
    }
    return share;
}

/// A viewpoint on a dome above the solid; azimuths advance by the golden angle.
Spot viewpoint(std::size_t i)
{
    const Spot& high = block_with_a_pit().high();
    const double reach = 2.0 * static_cast<double>(high.maxCoeff());
    const double height = 0.1 + 0.85 * halving(i + 1);
    const double turn = std::numbers::pi * (3.0 - std::sqrt(5.0)) * static_cast<double>(i);
    const double out = std::sqrt(1.0 - height * height);
    const Eigen::Vector3d way(out * std::cos(turn), out * std::sin(turn), height);
    return high / 2 + (reach * way).array().round().matrix().cast<std::int64_t>();
}

} // namespace

Scene timed_object(std::size_t points, std::size_t viewpoints)
{
    const std::vector<Spot> spots =
        points == kPapersPoints ? fitting_spots() : spread_spots(points);
    Scene scene;
    scene.cameras.emplace_back();
    std::vector<Spot> places;
    for (std::size_t i = 0; i < viewpoints; ++i) {
        places.push_back(viewpoint(i));
        View view;
        view.id = static_cast<std::uint32_t>(i + 1);
        view.center = places.back().cast<double>() / kSpotsPerUnit;
        scene.views.push_back(view);
    }
    for (const Spot& spot : spots) {
        std::vector<std::uint32_t> row;
        for (std::uint32_t i = 0; i < viewpoints; ++i) {
            if (block_with_a_pit().sees(spot, places[i])) row.push_back(i);
        }
        scene.positions.push_back(spot.cast<double>() / kSpotsPerUnit);
        scene.tracks.push_back(row);
        scene.point_ids.push_back(scene.point_ids.size() + 1);
    }
    scene.colors.resize(points);
    scene.errors_px.resize(points, 0.0);
    return spatial_sort(std::move(scene));
}

} // namespace vcarve::paper
