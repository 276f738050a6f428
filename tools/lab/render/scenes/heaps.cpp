#include "render/raster.h"
#include "render/scenes/scenes.h"
#include "render/shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <random>

namespace vcarve::render {

namespace {

/// A heap of boxes, columns and balls of many sizes on z = 0 around the origin. Each object is
/// rotated randomly and lowered until it touches another.
struct Heap {
    int things = 40;
    double spread = 0.4;   ///< standard deviation of positions along x and y
    double smallest = 0.1; ///< sizes are uniform in the logarithm
    double largest = 0.5;
    std::uint32_t seed = 1;
};

/// Uniform random numbers from 0 to 1, the same with every library.
class Dice {
  public:
    explicit Dice(std::uint32_t seed) : random_(seed) {}

    double share() { return static_cast<double>(random_()) / 4294967296.0; }
    double between(double low, double high) { return low + (high - low) * share(); }
    /// Approximately normal with standard deviation 1, never beyond 3.
    double bell() { return 2.0 * (share() + share() + share() - 1.5); }

  private:
    std::mt19937 random_;
};

/// The height of the heap in a grid of square cells.
class Heights {
  public:
    /// The lowest and highest z of an object in each cell that it covers.
    using Cover = std::map<std::pair<int, int>, std::pair<double, double>>;

    static Cover cover(const std::vector<Eigen::Vector3d>& corners)
    {
        Cover result;
        for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
            cover_triangle(corners[i], corners[i + 1] - corners[i], corners[i + 2] - corners[i],
                           result);
        }
        return result;
    }

    /// The distance by which an object can be lowered.
    double room_below(const Cover& thing) const
    {
        double room = std::numeric_limits<double>::infinity();
        for (const auto& [cell, span] : thing) {
            const auto found = heights_.find(cell);
            room = std::min(room, span.first - (found == heights_.end() ? 0.0 : found->second));
        }
        return room;
    }

    void put(const Cover& thing, double down)
    {
        for (const auto& [cell, span] : thing) {
            double& height = heights_[cell];
            height = std::max(height, span.second - down);
        }
    }

  private:
    static constexpr double kCell = 0.01;

    static void cover_triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& u,
                               const Eigen::Vector3d& v, Cover& result)
    {
        const double longest = std::max({u.norm(), v.norm(), (v - u).norm()});
        const int steps = static_cast<int>(std::ceil(2.0 * longest / kCell));
        for (int i = 0; i <= steps; ++i) {
            for (int k = 0; i + k <= steps; ++k) {
                const Eigen::Vector3d place = a + (i * u + k * v) / steps;
                const std::pair cell(static_cast<int>(std::floor(place.x() / kCell)),
                                     static_cast<int>(std::floor(place.y() / kCell)));
                auto& span = result.try_emplace(cell, place.z(), place.z()).first->second;
                span = {std::min(span.first, place.z()), std::max(span.second, place.z())};
            }
        }
    }

    std::map<std::pair<int, int>, double> heights_;
};

/// Adds a box, column, frustum or ball around the origin.
void add_thing(PartBuilder& builder, Dice& dice, double size, const Paint& paint)
{
    const double kind = dice.share();
    if (kind < 0.5) {
        const Eigen::Vector3d sides(size, size * dice.between(0.3, 1.0),
                                    size * dice.between(0.15, 0.9));
        add_box(builder, {{0.0, 0.0, -0.5 * sides.z()}, sides}, paint);
    } else if (kind < 0.75) {
        const double radius = size * dice.between(0.15, 0.4);
        const double top = dice.share() < 0.6 ? radius : radius * dice.between(0.3, 0.9);
        add_column(builder, {{0.0, 0.0, -0.5 * size}, radius, top, size}, paint);
    } else {
        add_sphere(builder, Eigen::Vector3d::Zero(), 0.4 * size, paint);
    }
}

Eigen::Quaterniond any_turn(Dice& dice)
{
    // Some objects lie flat, others lean.
    const double lean = dice.share() < 0.4 ? 0.0 : dice.between(0.0, std::numbers::pi);
    const double way = dice.between(0.0, 2.0 * std::numbers::pi);
    const Eigen::AngleAxisd leaning(lean, Eigen::Vector3d(std::cos(way), std::sin(way), 0.0));
    return Eigen::AngleAxisd(dice.between(0.0, 2.0 * std::numbers::pi), Eigen::Vector3d::UnitZ()) *
           leaning;
}

Paint any_paint(Dice& dice)
{
    const auto tint = [&] { return static_cast<float>(dice.between(0.4, 0.95)); };
    Paint paint;
    for (int k = 0; k < 3; ++k) {
        paint.tint[k] = tint();
    }
    return paint;
}

/// The final position of an object.
struct Rest {
    double top = std::numeric_limits<double>::infinity();
    Eigen::Isometry3d move; ///< from the origin
    Heights::Cover cover;   ///< before it is lowered
    double down = 0.0;
};

/// Lowers an object at several random positions, and selects the one with the lowest top, because
/// objects roll off a heap.
Rest settled(const std::vector<Eigen::Vector3d>& corners, const Heap& heap, const Heights& heights,
             Dice& dice)
{
    constexpr int kTries = 8;
    Rest lowest;
    for (int i = 0; i < kTries; ++i) {
        Rest rest;
        const double x = heap.spread * dice.bell();
        const double y = heap.spread * dice.bell();
        rest.move = Eigen::Translation3d(x, y, 0.0) * any_turn(dice);
        std::vector<Eigen::Vector3d> moved;
        double top = -std::numeric_limits<double>::infinity();
        for (const Eigen::Vector3d& corner : corners) {
            moved.emplace_back(rest.move * corner);
            top = std::max(top, moved.back().z());
        }
        rest.cover = Heights::cover(moved);
        rest.down = heights.room_below(rest.cover);
        rest.top = top - rest.down;
        if (rest.top < lowest.top) lowest = rest;
    }
    return lowest;
}

void add_heap(PartBuilder& builder, const Heap& heap)
{
    Dice dice(heap.seed);
    Heights heights;
    for (int i = 0; i < heap.things; ++i) {
        // Large objects first, so that the heap does not rest on small ones.
        const double share = (i + 0.5) / heap.things;
        const double size = heap.largest * std::pow(heap.smallest / heap.largest, share);
        const Paint paint = any_paint(dice);
        add_thing(builder, dice, size, paint);
        const Rest rest = settled(builder.part_corners(), heap, heights, dice);
        heights.put(rest.cover, rest.down);
        builder.move_part(Eigen::Translation3d(0.0, 0.0, -rest.down) * rest.move);
    }
}

/// Two rings of views around a table with a heap.
PhotoScene heap_on_table(const Heap& heap)
{
    PartBuilder builder;
    add_box(builder, {{0.0, 0.0, -0.08}, {2.6, 2.6, 0.08}}, {{0.74F, 0.66F, 0.56F}});
    add_heap(builder, heap);
    PhotoScene scene;
    scene.parts = builder.take();
    const Eigen::Vector3d target(0.0, 0.0, 0.3);
    add_arc(scene.views, {}, {target, 2.6, 1.0, 0.0, 20.0, 18});
    add_arc(scene.views, {}, {target, 2.1, 1.9, 10.0, 20.0, 18});
    return scene;
}

} // namespace

PhotoScene clutter()
{
    PhotoScene scene = heap_on_table({40, 0.36, 0.14, 0.50, 7});
    scene.frame = {0.01, turned(2.4, {0.5, 0.2, 0.9}), {0.02, 0.05, -0.03}};
    return scene;
}

PhotoScene noisy()
{
    PhotoScene scene = heap_on_table({25, 0.38, 0.18, 0.55, 23});
    scene.grain = {0.8, 12.0};
    scene.frame = {0.1, turned(0.7, {-0.6, 0.7, 0.1}), {-1.0, 0.4, 0.2}};
    return scene;
}

} // namespace vcarve::render
