#include "steps/1_points/merge_points.h"

#include "base/parallel.h"
#include "model/mean_color.h"
#include "model/scene_points.h"
#include "model/united_tracks.h"

#include <cmath>
#include <span>
#include <utility>

namespace vcarve {

namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

/// The points of one cluster.
class Members {
  public:
    Members(const MergedPoints& points, std::span<const std::uint32_t> places)
        : points_(points), places_(places)
    {
        for (const std::uint32_t place : places_) {
            weight_ += weight(place);
        }
    }

    std::uint32_t count() const { return static_cast<std::uint32_t>(weight_); }

    Vector3d mean_position() const
    {
        Vector3d sum = Vector3d::Zero();
        for (const std::uint32_t place : places_) {
            sum += weight(place) * points_.scene.positions[place];
        }
        return sum / weight_;
    }

    Color mean_color() const
    {
        return vcarve::mean_color(points_.scene, places_,
                                  [&](std::uint32_t place) { return weight(place); });
    }

    Vector3f mean_normal() const
    {
        Vector3f sum = Vector3f::Zero();
        for (const std::uint32_t place : places_) {
            sum += static_cast<float>(weight(place)) * points_.scene.normals[place];
        }
        return sum.normalized(); // leaves zero as it is
    }

  private:
    double weight(std::uint32_t place) const
    {
        return points_.counts.empty() ? 1.0 : points_.counts[place];
    }

    const MergedPoints& points_;
    std::span<const std::uint32_t> places_;
    double weight_ = 0.0; ///< of all
};

} // namespace

MergedPoints merge_points(const MergedPoints& points, const Clusters& clusters)
{
    const Scene& scene = points.scene;
    MergedPoints result{without_points(scene), std::vector<std::uint32_t>(clusters.size())};
    Scene& merged = result.scene;
    merged.positions.resize(clusters.size());
    merged.colors.resize(clusters.size());
    if (!scene.normals.empty()) merged.normals.resize(clusters.size());
    parallel_for(clusters.size(), [&](std::size_t i) {
        const Members members(points, clusters[i]);
        merged.positions[i] = members.mean_position();
        merged.colors[i] = members.mean_color();
        if (!scene.normals.empty()) merged.normals[i] = members.mean_normal();
        result.counts[i] = members.count();
    });
    merged.errors_px = values_at(clusters.leaders(), scene.errors_px);
    merged.point_ids = values_at(clusters.leaders(), scene.point_ids);
    merged.tracks = united_tracks(scene.tracks, clusters);
    return result;
}

void append(MergedPoints& points, MergedPoints more)
{
    if (more.counts.empty()) more.counts.assign(more.scene.num_points(), 1);
    if (points.scene.num_points() == 0) {
        points = std::move(more);
        return;
    }
    const auto add = [](auto& values, const auto& others) {
        values.insert(values.end(), others.begin(), others.end());
    };
    const std::size_t first = points.scene.num_sights();
    add(points.scene.positions, more.scene.positions);
    add(points.scene.colors, more.scene.colors);
    add(points.scene.errors_px, more.scene.errors_px);
    add(points.scene.point_ids, more.scene.point_ids);
    add(points.scene.normals, more.scene.normals);
    add(points.scene.tracks.views, more.scene.tracks.views);
    add(points.counts, more.counts);
    std::vector<std::uint64_t>& begins = points.scene.tracks.begins;
    for (std::size_t i = 1; i <= more.scene.num_points(); ++i) {
        begins.push_back(first + more.scene.tracks.begins[i]);
    }
}

} // namespace vcarve
