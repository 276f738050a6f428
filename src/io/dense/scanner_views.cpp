#include "io/dense/scanner_views.h"

#include "base/numbers.h"
#include "base/parallel.h"
#include "base/statistics.h"
#include "io/dense/cloud_points.h"
#include "io/ply/ply_file.h"
#include "vcarve/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numbers>
#include <unordered_map>
#include <utility>

namespace vcarve {
namespace {

using Eigen::Vector3d;

constexpr double kStationShare = 0.02; ///< side of a station's cube / median range
/// Pixels are finer than the typical point spacing, because some regions are denser.
constexpr double kPixelsBetweenPoints = 4.0;
constexpr std::uint32_t kNoStation = 0xffffffffU;
constexpr int kEquirectangular = 17;

/// Three numbers that identify a position.
using Key = std::array<std::uint64_t, 3>;

struct HashOfKey {
    std::size_t operator()(const Key& key) const
    {
        std::uint64_t hash = 0;
        for (const std::uint64_t part : key) {
            hash = (hash ^ part) * 0x9e3779b97f4a7c15U;
            hash ^= hash >> 32U;
        }
        return hash;
    }
};

/// The bits of a position; -0 equals 0.
Key exact_key(const Vector3d& place)
{
    const Vector3d no_minus_zero = place + Vector3d::Zero();
    Key key;
    std::memcpy(key.data(), no_minus_zero.data(), sizeof(key));
    return key;
}

/// The cube that contains a position, given relative to a corner of the grid.
Key cube_key(const Vector3d& from_corner, double side)
{
    const Vector3d cube = (from_corner / side).array().floor();
    return exact_key(cube);
}

/// The scanner position of a point. `scanners` has one position per point, or one for all.
const Vector3d& scanner_of(std::size_t point, const std::vector<Vector3d>& scanners)
{
    return scanners[scanners.size() == 1 ? 0 : point];
}

/// Scanner positions, and the station of each point.
struct Stations {
    std::vector<Vector3d> places;
    std::vector<std::uint32_t> of_point; ///< kNoStation if the point is not finite
};

/// One station per key of the scanner positions. Empty if there are more than kMostStations.
template <typename KeyOf>
Stations stations_by(const std::vector<Vector3d>& scanners, const std::vector<Vector3d>& points,
                     const KeyOf& key_of)
{
    Stations stations;
    stations.of_point.resize(points.size(), kNoStation);
    std::unordered_map<Key, std::uint32_t, HashOfKey> known;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!points[i].allFinite()) continue;
        const Vector3d& place = scanner_of(i, scanners);
        const auto [found, is_new] =
            known.emplace(key_of(place), static_cast<std::uint32_t>(stations.places.size()));
        if (is_new) stations.places.push_back(place);
        if (stations.places.size() > kMostStations) return {};
        stations.of_point[i] = found->second;
    }
    return stations;
}

bool is_too_many(const Stations& stations, const std::vector<Vector3d>& points)
{
    return stations.of_point.size() != points.size();
}

double median_range(const std::vector<Vector3d>& scanners, const std::vector<Vector3d>& points)
{
    std::vector<double> ranges;
    ranges.reserve(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double range = (scanner_of(i, scanners) - points[i]).norm();
        if (std::isfinite(range)) ranges.push_back(range);
    }
    return median_in_place(ranges);
}

Stations find_stations(const std::vector<Vector3d>& scanners, const std::vector<Vector3d>& points,
                       double range)
{
    Stations stations = stations_by(scanners, points, exact_key);
    // The grid starts at the first position used, so cubes do not depend on the scene's offset.
    Vector3d corner = Vector3d::Zero();
    for (std::size_t i = points.size(); i-- > 0;) {
        if (points[i].allFinite()) corner = scanner_of(i, scanners);
    }
    constexpr double kLeastSide = 1e-300; // if all ranges are zero
    for (double side = std::max(kStationShare * range, kLeastSide); is_too_many(stations, points);
         side *= 2.0) {
        stations = stations_by(scanners, points, [&](const Vector3d& place) {
            return cube_key(place - corner, side);
        });
    }
    return stations;
}

/// The point spacing around `place`, assuming points spread evenly on a surface.
double spacing_at(const std::vector<Vector3d>& points, const Vector3d& place)
{
    constexpr std::size_t kAround = 8;
    std::array<double, kAround + 1> least; // the point itself and its neighbors
    least.fill(std::numeric_limits<double>::infinity());
    for (const Vector3d& point : points) {
        const double distance_sq = (point - place).squaredNorm();
        if (!(distance_sq < least.back())) continue;
        std::size_t rank = kAround;
        for (; rank > 0 && least[rank - 1] > distance_sq; --rank) {
            least[rank] = least[rank - 1];
        }
        least[rank] = distance_sq;
    }
    return std::sqrt(std::numbers::pi * least.back() / static_cast<double>(kAround));
}

/// The median angle between neighboring points, seen from their stations, in radians.
double angle_between_points(const Stations& stations, const std::vector<Vector3d>& points)
{
    constexpr std::size_t kSamples = 200;
    const std::size_t count = std::min(kSamples, points.size());
    std::vector<double> angles(count, 0.0);
    parallel_for(
        count,
        [&](std::size_t k) {
            const std::size_t i = k * (points.size() / count);
            if (stations.of_point[i] == kNoStation) return;
            const double range = (points[i] - stations.places[stations.of_point[i]]).norm();
            angles[k] = spacing_at(points, points[i]) / range;
        },
        1);
    std::erase_if(angles, [](double angle) { return !(angle > 0.0 && std::isfinite(angle)); });
    const double evenly = std::sqrt(4.0 * std::numbers::pi / static_cast<double>(points.size()));
    return angles.empty() ? evenly : median_in_place(angles);
}

/// An equirectangular camera whose pixels span `pixel_rad` at the horizon.
Camera panorama(double pixel_rad)
{
    constexpr double kMost = 1e6;
    const double height = std::clamp(std::round(std::numbers::pi / pixel_rad), 1.0, kMost);
    const auto height_px = static_cast<std::uint64_t>(height);
    return {.id = 1,
            .model = kEquirectangular,
            .width_px = 2 * height_px,
            .height_px = height_px,
            .params = {2.0 * height, height},
            .measures_range = true};
}

} // namespace

void add_scanner_views(const std::vector<Vector3d>& scanners, Scene& scene)
{
    const double range = median_range(scanners, scene.positions);
    const Stations stations = find_stations(scanners, scene.positions, range);
    if (stations.places.empty()) {
        scene.tracks.begins.assign(scene.num_points() + 1, 0);
        return;
    }
    const double between_rad = angle_between_points(stations, scene.positions);
    scene.cameras.push_back(panorama(between_rad / kPixelsBetweenPoints));
    for (std::uint32_t i = 0; i < stations.places.size(); ++i) {
        scene.views.push_back({.id = i + 1,
                               .camera = 0,
                               .name = fmt::format("scanner {}", i + 1),
                               .center = stations.places[i]});
    }
    scene.tracks.begins.reserve(scene.num_points() + 1);
    scene.tracks.views.reserve(scene.num_points());
    for (const std::uint32_t& station : stations.of_point) {
        const std::size_t count = station == kNoStation ? 0 : 1;
        scene.tracks.push_back({&station, count});
    }
}

Scene read_scan_scene(const ScanFile& file, const Progress& progress)
{
    PointCloud cloud =
        read_ply_cloud(file.cloud, progress.part(0.0, 0.8),
                       file.scanner ? PlyContent::points : PlyContent::points_and_scanners);
    if (file.scanner) cloud.scanners = {*file.scanner + read_ply_header(file.cloud).offset};
    if (cloud.scanners.empty() && !cloud.positions.empty()) {
        throw InputError(fmt::format("{}: the file has no scanner position; give it with --scanner "
                                     "x,y,z",
                                     file.cloud.string()));
    }
    Scene scene;
    scene.positions = std::move(cloud.positions);
    add_scanner_views(cloud.scanners, scene);
    progress.report(0.95);
    take_attributes(std::move(cloud), 0, scene);
    return scene;
}

std::optional<SceneSize> scan_size_before_reading(const ScanFile& file)
{
    const PlyHeader header = read_ply_header(file.cloud);
    const PlyElement* const vertices = header.find("vertex");
    if (vertices == nullptr || vertices->count > kMostIndices) return std::nullopt;
    return SceneSize{.points = vertices->count,
                     .rays = vertices->count,
                     .views = 1,
                     .has_normals = PlyVertexLayout(*vertices).has_normals(),
                     .is_dense = true};
}

} // namespace vcarve
