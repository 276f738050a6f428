#include "support/point_sets.h"

#include "steps/3_cells/triangulate.h"
#include "support/scenes.h"

#include <cmath>

namespace vcarve {

namespace {

using Eigen::Vector3d;

Index any_cell(const TetMesh& mesh, std::mt19937_64& random)
{
    auto cell = static_cast<Index>(pick(random, mesh.cells.size()));
    while (mesh.cells[cell].is_infinite()) {
        cell = static_cast<Index>(pick(random, mesh.cells.size()));
    }
    return cell;
}

/// A point in a cell, on its border or at a vertex: the mean of four random corners, which is exact
/// on a lattice.
Vector3d any_quarter_point(const TetMesh& mesh, std::mt19937_64& random)
{
    const Cell& cell = mesh.cells[any_cell(mesh, random)];
    Vector3d sum = Vector3d::Zero();
    for (int i = 0; i < 4; ++i) {
        sum += 0.25 * mesh.positions[cell.vertices[pick(random, 4)]];
    }
    return sum;
}

} // namespace

double even(std::mt19937_64& random, double low, double high)
{
    return low + (high - low) * (static_cast<double>(random() >> 11U) * 0x1p-53);
}

Vector3d even_in_cube(std::mt19937_64& random, double low, double high)
{
    const double x = even(random, low, high);
    const double y = even(random, low, high);
    const double z = even(random, low, high);
    return {x, y, z};
}

std::size_t pick(std::mt19937_64& random, std::size_t count)
{
    return static_cast<std::size_t>(random() % count);
}

Positions random_points(std::size_t count, std::uint64_t seed)
{
    std::mt19937_64 random(seed);
    Positions points;
    while (points.size() < count) {
        points.push_back(even_in_cube(random, 0.0, 1.0));
    }
    return points;
}

Positions lattice(int n)
{
    Positions points;
    for (int z = 0; z < n; ++z) {
        for (int y = 0; y < n; ++y) {
            for (int x = 0; x < n; ++x) {
                points.emplace_back(x, y, z);
            }
        }
    }
    return points;
}

Positions body_centered_lattice(int n)
{
    Positions points = lattice(n);
    for (const Vector3d& center : mapped(lattice(n - 1), 1.0, Vector3d::Constant(0.5))) {
        points.push_back(center);
    }
    return points;
}

Positions two_skew_lines(int points_of_line)
{
    Positions points;
    for (int i = 0; i < points_of_line; ++i) {
        const double along = 2.0 * i / points_of_line - 1.0;
        points.emplace_back(along, 0.0, -0.5);
        points.emplace_back(0.0, along, 0.5);
    }
    return points;
}

Positions points_on_sphere()
{
    Positions points;
    for (const Vector3d& p : mapped(lattice(7), 1.0, Vector3d::Constant(-3.0))) {
        if (p.squaredNorm() == 9.0) {
            points.push_back(p);
        }
    }
    return points;
}

Positions nearly_on_a_sphere(std::size_t count, double noise)
{
    std::mt19937_64 random(72);
    Positions points;
    while (points.size() < count) {
        const Vector3d p = even_in_cube(random, -1.0, 1.0);
        if (p.norm() > 1.0 || p.norm() < 0.1) continue;
        points.push_back((1.0 + even(random, -noise, noise)) * p.normalized());
    }
    return points;
}

Positions jittered(Positions points, double reach, std::uint64_t seed)
{
    std::mt19937_64 random(seed);
    for (Vector3d& point : points) {
        point += even_in_cube(random, -reach, reach);
    }
    return points;
}

Positions mapped(Positions points, double factor, const Vector3d& shift)
{
    for (Vector3d& point : points) {
        point = factor * point + shift;
    }
    return points;
}

Scene scene_seen_from(const Positions& centers, const Positions& points, double share,
                      std::uint64_t seed)
{
    std::mt19937_64 random(seed);
    std::vector<MadePoint> made;
    for (const Vector3d& point : points) {
        made.push_back({point, {}});
        for (std::uint32_t view = 0; view < centers.size(); ++view) {
            if (even(random, 0.0, 1.0) < share) {
                made.back().views.push_back(view);
            }
        }
    }
    return make_scene(centers, made);
}

Scene scene_of(const Positions& positions)
{
    return scene_seen_from({}, positions, 0.0, 0);
}

TetMesh triangulation_of(const Positions& positions)
{
    return triangulate(scene_of(positions));
}

std::vector<NamedCells> meshes_to_walk()
{
    const Vector3d origin = Vector3d::Zero();
    const Vector3d far(4'600'000.0, 500'000.0, 1000.0);
    Positions flat = random_points(70, 2);
    for (Vector3d& point : flat) {
        point.z() *= 1e-9;
    }
    Positions on_sphere = points_on_sphere();
    on_sphere.push_back(origin);
    std::vector<std::tuple<std::string, Positions, double>> sets = {
        {"random", random_points(80, 1), 0.2},
        {"flat", flat, 0.1},
        {"lattice", lattice(4), 1.0},
        {"body-centered lattice", body_centered_lattice(3), 0.5},
        {"sphere", on_sphere, 1.0},
        {"lattice jittered by 1e-15", jittered(lattice(4), 1e-15, 3), 1.0},
        {"sphere jittered by 1e-15", jittered(on_sphere, 1e-15, 4), 1.0},
        {"random far from the origin", mapped(random_points(60, 5), 1.0, far), 0.2},
        {"lattice far from the origin", mapped(lattice(3), 0.25, far), 0.25},
        {"lattice of 1e-9, jittered", jittered(mapped(lattice(3), 1e-9, origin), 1e-24, 6), 1e-9},
        {"random of 2^-515", mapped(random_points(50, 7), 0x1p-515, origin), 0x1p-517},
        {"lattice of 2^-515", mapped(lattice(3), 0x1p-515, origin), 0x1p-515},
        {"lattice of 2^-517, jittered", mapped(jittered(lattice(3), 1e-15, 9), 0x1p-517, origin),
         0x1p-517},
        {"random of 2^400", mapped(random_points(50, 8), 0x1p400, origin), 0x1p398},
    };
    std::vector<NamedCells> meshes;
    for (const auto& [name, points, step] : sets) {
        meshes.push_back({name, triangulation_of(points), step});
    }
    return meshes;
}

Vector3d any_target(const NamedCells& named, Index vertex, std::mt19937_64& random)
{
    const TetMesh& mesh = named.mesh;
    const Vector3d& point = mesh.positions[vertex];
    const Vector3d& other = mesh.positions[pick(random, mesh.positions.size())];
    const Vector3d quarter = any_quarter_point(mesh, random);
    constexpr std::array<double, 6> kReaches = {0.5, 0.75, 1.5, 2.0, 3.0, 1024.0};
    const double reach = kReaches[pick(random, kReaches.size())];
    const Vector3d step = named.step * even_in_cube(random, -4.0, 4.0);
    switch (pick(random, 10)) {
    case 0:
        return other;
    case 1:
        return point + reach * (other - point);
    case 2:
    case 3:
        return quarter;
    case 4:
    case 5:
        return point + reach * (quarter - point);
    case 6: // half steps of a lattice
        return point + 0.5 * named.step * (step / named.step).array().round().matrix();
    case 7: // just beside a point that is hard to pass
        return quarter + 1e-15 * step;
    default:
        return point + step;
    }
}

} // namespace vcarve
