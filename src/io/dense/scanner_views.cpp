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

constexpr double kStationShare = 0.02; ///< of the median range, the side of a station's cube
/// A scan shows detail finer than its points stand apart on average, where they stand closer.
constexpr double kPixelsBetweenPoints = 4.0;
constexpr std::uint32_t kNoStation = 0xffffffffU;
constexpr int kEquirectangular = 17;

/// Three numbers that tell places apart.
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

/// The bits of a place.
Key exact_key(const Vector3d& place)
{
    const Vector3d no_minus_zero = place + Vector3d::Zero();
    Key key;
    std::memcpy(key.data(), no_minus_zero.data(), sizeof(key));
    return key;
}

/// The cube that holds a place, by its distance from a corner.
Key cube_key(const Vector3d& from_corner, double side)
{
    const Vector3d cube = (from_corner / side).array().floor();
    return exact_key(cube);
}

/// Where the scanner of a point stood: one for all, or one a point.
const Vector3d& scanner_of(std::size_t point, const std::vector<Vector3d>& scanners)
{
    return scanners[scanners.size() == 1 ? 0 : point];
}

/// Where scanners stood, and which of the points each measured.
struct Stations {
    std::vector<Vector3d> places;
    std::vector<std::uint32_t> of_point; ///< kNoStation for a point that is not finite
};

/// The stations by the keys of the places; none where there are more than may be.
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
    // The first place that counts: cubes do not depend on where the scene is.
    Vector3d corner = Vector3d::Zero();
    for (std::size_t i = points.size(); i-- > 0;) {
        if (points[i].allFinite()) corner = scanner_of(i, scanners);
    }
    constexpr double kLeastSide = 1e-300; // where all ranges are zero
    for (double side = std::max(kStationShare * range, kLeastSide); is_too_many(stations, points);
         side *= 2.0) {
        stations = stations_by(scanners, points, [&](const Vector3d& place) {
            return cube_key(place - corner, side);
        });
    }
    return stations;
}

/// How far apart the points around one stand, if they lie on a surface there and evenly.
double spacing_at(const std::vector<Vector3d>& points, const Vector3d& place)
{
    constexpr std::size_t kAround = 8;
    std::array<double, kAround + 1> least; // itself, and those around
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

/// The angle at which points stand apart that are next to each other, seen from their stations.
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

/// Looks all round, with pixels so wide at the horizon.
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
        throw InputError(fmt::format("{}: the file does not tell where the scanner of its points "
                                     "stood",
                                     file.cloud.string()));
    }
    Scene scene;
    scene.positions = std::move(cloud.positions);
    add_scanner_views(cloud.scanners, scene);
    progress.tell(0.95);
    take_attributes(std::move(cloud), 0, scene);
    return scene;
}

std::optional<SceneSize> scan_size_before_reading(const ScanFile& file)
{
    const PlyHeader header = read_ply_header(file.cloud);
    const PlyElement* const vertices = header.find("vertex");
    if (vertices == nullptr || vertices->count > kMostIndices) return std::nullopt;
    return SceneSize{.points = vertices->count,
                     .sights = vertices->count,
                     .views = 1,
                     .has_normals = PlyVertexLayout(*vertices).has_normals(),
                     .is_dense = true};
}

} // namespace vcarve
