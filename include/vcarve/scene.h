#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace vcarve {

using Color = std::array<std::uint8_t, 3>; ///< red, green, blue

/// A calibrated lens, as COLMAP stores it. `model` is COLMAP's number (0 SIMPLE_PINHOLE, 1 PINHOLE,
/// ...), or -1 where a text file names a model that is not known.
struct Camera {
    std::uint32_t id = 0;        ///< COLMAP's camera id
    int model = 0;               ///< COLMAP's number of the lens model
    std::uint64_t width_px = 0;  ///< of its images
    std::uint64_t height_px = 0; ///< of its images
    std::vector<double> params;  ///< in COLMAP's order for the lens model
    /// A scanner: its sights end where it measured, so a point needs no other view to be known.
    bool measures_range = false;
};

/// A registered image: the pose of its camera and the centre all its sights meet in.
struct View {
    std::uint32_t id = 0;     ///< COLMAP's image id
    std::uint32_t camera = 0; ///< index into Scene::cameras
    std::string name;         ///< as in the model, UTF-8
    Eigen::Quaterniond cam_from_world = Eigen::Quaterniond::Identity(); ///< rotation only, unit
    Eigen::Vector3d center = Eigen::Vector3d::Zero(); ///< in the frame of Scene::positions
};

/// Which views saw which point: one row of view indices per point, rows stored end to end.
/// Within a row the indices ascend and none occurs twice.
struct Tracks {
    std::vector<std::uint64_t> begins{0}; ///< row i is views[begins[i]] up to views[begins[i + 1]]
    std::vector<std::uint32_t> views;     ///< indices into Scene::views

    /// How many rows there are.
    std::size_t size() const { return begins.size() - 1; }
    /// The views that saw a point.
    std::span<const std::uint32_t> operator[](std::size_t point) const
    {
        return {views.data() + begins[point], views.data() + begins[point + 1]};
    }
    /// Adds a row, the track of the next point.
    void push_back(std::span<const std::uint32_t> row)
    {
        views.insert(views.end(), row.begin(), row.end());
        begins.push_back(views.size());
    }
};

/// Where a point comes from: measured, or added to those that were, in a planar region.
enum class PointKind : std::uint8_t {
    measured,
    crease,     ///< where two regions meet
    border,     ///< where one ends: behind it there may be anything
    textureless ///< amid one, where images show no features
};

/// What COLMAP reconstructed: views, points, and the sights between them.
/// The arrays positions, colors, errors_px, point_ids and tracks run parallel, one entry a point;
/// so do the normals and the kinds, where there are any.
struct Scene {
    std::vector<Camera> cameras;            ///< what the views were taken with
    std::vector<View> views;                ///< from where points were seen
    std::vector<Eigen::Vector3d> positions; ///< in world minus `offset`
    std::vector<Color> colors;              ///< of the points
    std::vector<double> errors_px;          ///< mean reprojection error; negative where unknown
    std::vector<std::uint64_t>
        point_ids; ///< COLMAP's point3D ids, or places in a cloud's file; 0 if added
    std::vector<Eigen::Vector3f> normals; ///< optional: unit, or zero where unknown
    std::vector<PointKind> kinds;         ///< optional: all are measured where there are none
    Tracks tracks;                        ///< which views saw which point
    bool is_dense = false; ///< points of a dense cloud or a scan, whose errors are not known
    Eigen::Vector3d offset = Eigen::Vector3d::Zero(); ///< add to a position to get the file's

    /// How many points there are.
    std::size_t num_points() const { return positions.size(); }
    /// Where a point comes from.
    PointKind kind_of(std::size_t point) const
    {
        return kinds.empty() ? PointKind::measured : kinds[point];
    }
    /// How many pairs of a point and a view that saw it there are.
    std::size_t num_sights() const { return tracks.views.size(); }
};

} // namespace vcarve
