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
/// ...), or -1 if a text file names an unknown model.
struct Camera {
    std::uint32_t id = 0;        ///< COLMAP's camera id
    int model = 0;               ///< COLMAP's number of the lens model
    std::uint64_t width_px = 0;  ///< image width
    std::uint64_t height_px = 0; ///< image height
    std::vector<double> params;  ///< lens parameters, in COLMAP's order
    /// A laser scanner, whose rays end at the measured range. So its points need only one view.
    bool measures_range = false;
};

/// A registered image: the pose and the center of its camera.
struct View {
    std::uint32_t id = 0;     ///< COLMAP's image id
    std::uint32_t camera = 0; ///< index into Scene::cameras
    std::string name;         ///< as in the model, UTF-8
    Eigen::Quaterniond cam_from_world = Eigen::Quaterniond::Identity(); ///< rotation only, unit
    Eigen::Vector3d center = Eigen::Vector3d::Zero(); ///< in the frame of Scene::positions
};

/// The views that saw each point: one row of view indices per point, stored back to back. The
/// indices of a row are strictly ascending.
struct Tracks {
    std::vector<std::uint64_t> begins{0}; ///< row i is views[begins[i]] up to views[begins[i + 1]]
    std::vector<std::uint32_t> views;     ///< indices into Scene::views

    /// The number of rows.
    std::size_t size() const { return begins.size() - 1; }
    /// The views that saw a point.
    std::span<const std::uint32_t> operator[](std::size_t point) const
    {
        return {views.data() + begins[point], views.data() + begins[point + 1]};
    }
    /// Appends a row, the track of the next point.
    void push_back(std::span<const std::uint32_t> row)
    {
        views.insert(views.end(), row.begin(), row.end());
        begins.push_back(views.size());
    }
};

/// The origin of a point: measured, or added in a planar region (section 2 of algorithm.md).
enum class PointKind : std::uint8_t {
    measured,
    crease,      ///< added where two regions meet
    border,      ///< added at the border of a region; the space behind it is unknown
    textureless, ///< added inside a region, where images have no features
    witness      ///< outside of a tile of a large model: its rays carve for those of several points
};

/// COLMAP's reconstruction: views, points, and the rays between them. The arrays positions, colors,
/// errors_px, point_ids and tracks are parallel, with one entry per point. normals and kinds are
/// parallel to them, or empty.
struct Scene {
    std::vector<Camera> cameras;            ///< cameras of the views
    std::vector<View> views;                ///< registered images, or scanner positions
    std::vector<Eigen::Vector3d> positions; ///< world coordinates minus `offset`
    std::vector<Color> colors;              ///< of the points
    std::vector<double> errors_px;          ///< mean reprojection error; negative if unknown
    std::vector<std::uint64_t>
        point_ids; ///< COLMAP's point3D ids, or positions in a cloud's file; 0 if added
    std::vector<Eigen::Vector3f> normals; ///< optional: unit, or zero if unknown
    std::vector<PointKind> kinds;         ///< optional: if empty, all are measured
    Tracks tracks;                        ///< the views that saw each point
    bool is_dense = false;                ///< a dense cloud or a scan, whose errors are unknown
    Eigen::Vector3d offset = Eigen::Vector3d::Zero(); ///< add this to a position to get the file's

    /// The number of points.
    std::size_t num_points() const { return positions.size(); }
    /// The origin of a point.
    PointKind kind_of(std::size_t point) const
    {
        return kinds.empty() ? PointKind::measured : kinds[point];
    }
    /// The number of rays: pairs of a point and a view that saw it.
    std::size_t num_rays() const { return tracks.views.size(); }
};

} // namespace vcarve
