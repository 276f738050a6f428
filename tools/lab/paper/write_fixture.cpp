#include "paper/write_fixture.h"

#include "geometry/predicates.h"

#include <fmt/format.h>
#include <fmt/os.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <stdexcept>

namespace vcarve::paper {

namespace {

constexpr int kCameraId = 1;

Eigen::Vector3d in_scene(const Spot& spot)
{
    return spot.cast<double>() / static_cast<double>(kSpotsPerUnit);
}

/// COLMAP's translation of a view; exact, because the rotation only swaps and negates coordinates.
Eigen::Vector3d translation(const ExactView& view)
{
    return -(exact_rotations()[view.rotation].toRotationMatrix() * in_scene(view.center));
}

/// A color that distinguishes positions: the relative position in the solid's bounding box.
std::array<int, 3> color(const Fixture& fixture, const Spot& spot)
{
    const Eigen::Array3d size = (fixture.solid.high() - fixture.solid.low()).cast<double>().array();
    const Eigen::Array3d share = (spot - fixture.solid.low()).cast<double>().array() / size;
    const Eigen::Array3i levels = (60.0 + 180.0 * share).round().cast<int>();
    return {levels[0], levels[1], levels[2]};
}

void write_cameras(const std::filesystem::path& folder)
{
    auto out = fmt::output_file((folder / "cameras.txt").string());
    out.print("# CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n");
    out.print("{} PINHOLE {} {} {} {} {} {}\n", kCameraId, kImageSizePx, kImageSizePx, kFocalPx,
              kFocalPx, kImageSizePx / 2, kImageSizePx / 2);
}

void write_images(const std::filesystem::path& folder, const Fixture& fixture)
{
    auto out = fmt::output_file((folder / "images.txt").string());
    out.print("# IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME\n"
              "# POINTS2D[] as (X, Y, POINT3D_ID)\n");
    for (std::size_t i = 0; i < fixture.views.size(); ++i) {
        const ExactView& view = fixture.views[i];
        const Eigen::Quaterniond& q = exact_rotations()[view.rotation];
        const Eigen::Vector3d t = translation(view);
        out.print("{} {} {} {} {} {} {} {} {} {}_{:02}.png\n", i + 1, q.w(), q.x(), q.y(), q.z(),
                  t.x(), t.y(), t.z(), kCameraId, fixture.name, i + 1);
        const char* gap = "";
        for (const std::uint32_t sample : view.sees) {
            const Eigen::Vector2d pixel = project(view, fixture.samples[sample]);
            out.print("{}{:.3f} {:.3f} {}", gap, pixel.x(), pixel.y(), sample + 1);
            gap = " ";
        }
        out.print("\n");
    }
}

/// The track of each sample in COLMAP's format: image id and index in that image's list.
std::vector<std::string> tracks(const Fixture& fixture)
{
    std::vector<std::string> result(fixture.samples.size());
    for (std::size_t i = 0; i < fixture.views.size(); ++i) {
        const auto& sees = fixture.views[i].sees;
        for (std::size_t k = 0; k < sees.size(); ++k) {
            result[sees[k]] += fmt::format(" {} {}", i + 1, k);
        }
    }
    return result;
}

void write_points(const std::filesystem::path& folder, const Fixture& fixture)
{
    auto out = fmt::output_file((folder / "points3D.txt").string());
    out.print("# POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)\n");
    const std::vector<std::string> track = tracks(fixture);
    for (std::size_t i = 0; i < fixture.samples.size(); ++i) {
        const Eigen::Vector3d p = in_scene(fixture.samples[i]);
        const auto [red, green, blue] = color(fixture, fixture.samples[i]);
        out.print("{} {} {} {} {} {} {} 0{}\n", i + 1, p.x(), p.y(), p.z(), red, green, blue,
                  track[i]);
    }
}

void write_solid(const std::filesystem::path& folder, const Fixture& fixture)
{
    auto out = fmt::output_file((folder / "solid.ply").string());
    const double units = std::pow(static_cast<double>(kSpotsPerUnit), 3);
    out.print("ply\nformat ascii 1.0\n");
    out.print("comment volume {}\n", static_cast<double>(fixture.solid.volume()) / units);
    for (const Box& box : fixture.solid.boxes()) {
        const Eigen::Vector3d a = in_scene(box.low);
        const Eigen::Vector3d b = in_scene(box.high);
        out.print("comment box {} {} {} {} {} {}\n", a.x(), a.y(), a.z(), b.x(), b.y(), b.z());
    }
    out.print("element vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
              "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
              fixture.samples.size(), fixture.cells.boundary.size());
    for (const Spot& sample : fixture.samples) {
        const Eigen::Vector3d p = in_scene(sample);
        out.print("{} {} {}\n", p.x(), p.y(), p.z());
    }
    for (const auto& face : fixture.cells.boundary) {
        out.print("3 {} {} {}\n", face[0], face[1], face[2]);
    }
}

struct Segment {
    Eigen::Vector3d begin;
    Eigen::Vector3d end;
};

bool crosses(const Segment& ray, const std::array<Eigen::Vector3d, 3>& t)
{
    const auto& [p, c] = ray;
    if (orientation(t[0], t[1], t[2], p) * orientation(t[0], t[1], t[2], c) >= 0) return false;
    const int turn = orientation(p, c, t[0], t[1]);
    return turn != 0 && turn == orientation(p, c, t[1], t[2]) &&
           turn == orientation(p, c, t[2], t[0]);
}

std::vector<Segment> rays(const Fixture& fixture)
{
    std::vector<Segment> result;
    for (const ExactView& view : fixture.views) {
        const Eigen::Matrix3d rotation = exact_rotations()[view.rotation].toRotationMatrix();
        const Eigen::Vector3d center = -(rotation.transpose() * translation(view));
        for (const std::uint32_t sample : view.sees) {
            result.push_back({in_scene(fixture.samples[sample]), center});
        }
    }
    return result;
}

bool is_crossed(const Fixture& fixture, const std::array<std::uint32_t, 4>& cell,
                const std::vector<Segment>& all)
{
    std::array<Eigen::Vector3d, 4> p;
    std::transform(cell.begin(), cell.end(), p.begin(),
                   [&](std::uint32_t i) { return in_scene(fixture.samples[i]); });
    return std::any_of(all.begin(), all.end(), [&](const Segment& ray) {
        return crosses(ray, {p[0], p[1], p[2]}) || crosses(ray, {p[0], p[1], p[3]}) ||
               crosses(ray, {p[0], p[2], p[3]}) || crosses(ray, {p[1], p[2], p[3]});
    });
}

std::int64_t cells_volume_6(const Fixture& fixture)
{
    const auto& s = fixture.samples;
    return std::accumulate(fixture.cells.solid.begin(), fixture.cells.solid.end(), std::int64_t{0},
                           [&](std::int64_t sum, const auto& c) {
                               return sum + std::abs(volume_6(s[c[0]], s[c[1]], s[c[2]], s[c[3]]));
                           });
}

/// The enclosed volume of the boundary; positive if its faces are oriented outward.
std::int64_t enclosed_volume_6(const Fixture& fixture)
{
    const auto& s = fixture.samples;
    return std::accumulate(fixture.cells.boundary.begin(), fixture.cells.boundary.end(),
                           std::int64_t{0}, [&](std::int64_t sum, const auto& f) {
                               return sum + volume_6(Spot::Zero(), s[f[0]], s[f[1]], s[f[2]]);
                           });
}

} // namespace

void write_fixture(const std::filesystem::path& folder, const Fixture& fixture)
{
    std::filesystem::create_directories(folder);
    write_cameras(folder);
    write_images(folder, fixture);
    write_points(folder, fixture);
    write_solid(folder, fixture);
}

void check_carving(const Fixture& fixture)
{
    const std::vector<Segment> all = rays(fixture);
    for (const auto& cell : fixture.cells.empty) {
        if (!is_crossed(fixture, cell, all)) throw std::logic_error("an empty cell is not carved");
    }
    for (const auto& cell : fixture.cells.solid) {
        if (is_crossed(fixture, cell, all)) throw std::logic_error("a solid cell is carved");
    }
    if (cells_volume_6(fixture) != 6 * fixture.solid.volume()) {
        throw std::logic_error("the solid cells do not have the volume of the solid");
    }
    if (enclosed_volume_6(fixture) != 6 * fixture.solid.volume()) {
        throw std::logic_error("the oriented boundary does not enclose the solid");
    }
}

std::vector<Object> objects()
{
    return {
        {"cube_with_cavity",
         1.0,
         {{0, 0, 0, 4, 4, 1.5}, // below the cavity
          {0, 0, 1.5, 1, 4, 4}, // its four walls
          {3, 0, 1.5, 4, 4, 4},
          {1, 0, 1.5, 3, 1, 4},
          {1, 3, 1.5, 3, 4, 4}}},
        {"boissonnat",
         1.25,
         {{0, 0, 0, 4.25, 4, 1},      // base
          {0, 0, 1, 2.75, 4, 4},      // thick block
          {3.25, 0, 1, 4.25, 4, 4}}}, // thin plate across a narrow slot
        {"cubicles",
         1.0,
         {{0, 0, 0, 6, 6, 0.75},      // floor
          {0, 2.5, 0.75, 3, 3, 2.25}, // partitions along x, staggered
          {3, 3, 0.75, 6, 3.5, 2.25},
          {2.75, 0, 0.75, 3.25, 6, 2.25}, // partition along y
          {0, 0, 0.75, 0.5, 6, 2.25},     // outer walls
          {5.5, 0, 0.75, 6, 6, 2.25}}},
        {"desk",
         1.0,
         {{0, 0, 3, 6, 3, 3.5},          // top
          {0, 0, 0, 0.5, 3, 3},          // side panel
          {4.25, 0, 0, 6, 3, 3},         // block of drawers
          {0.5, 2.5, 0.5, 4.25, 3, 2}}}, // back panel, open above: a handle
    };
}

Fixture make_fixture(const Object& object)
{
    constexpr int kMostSeeds = 100;
    const BoxSolid solid(object.boxes);
    for (int seed = 1; seed <= kMostSeeds; ++seed) {
        std::mt19937_64 random(seed);
        const auto max_radius = static_cast<std::int64_t>(object.max_radius * kSpotsPerUnit);
        const std::vector<Spot> samples = sample_surface(solid, max_radius, random);
        const auto cells = triangulate(solid, samples);
        if (!cells) continue;
        const auto views = place_views(solid, samples, *cells, random);
        return {object.name, solid, samples, *cells, views};
    }
    throw std::runtime_error(object.name + ": found no sampling that fits the object");
}

} // namespace vcarve::paper
