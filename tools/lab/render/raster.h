#pragma once

#include "vcarve/tri_mesh.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace vcarve::render {

/// A camera without distortion in the mesh's frame. The center of pixel (x, y) is (x + 0.5, y +
/// 0.5).
struct Pinhole {
    Eigen::Matrix3d cam_from_world =
        Eigen::Matrix3d::Identity(); ///< rotation; z looks ahead, y down
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    Eigen::Vector2d focal_px = Eigen::Vector2d::Ones();
    Eigen::Vector2d principal_px = Eigen::Vector2d::Zero();
    int width_px = 0;
    int height_px = 0;

    /// The direction in the world of the ray through an image position. Its z in the camera's frame
    /// is 1.
    Eigen::Vector3d ray(const Eigen::Vector2d& pixel) const;
};

/// The same view with `factor` times as many pixels per side.
Pinhole enlarged(const Pinhole& view, int factor);

/// The nearest face at a pixel, or kNoFace.
struct Hit {
    static constexpr std::uint32_t kNoFace = 0xffffffffU;
    std::uint32_t face = kNoFace;
    bool front = false; ///< whether the vertices are counterclockwise from the view
    double depth = 0.0; ///< along the camera's z
};

/// Renders a mesh with a depth buffer: one Hit per pixel, row by row. Exact up to rounding: depth
/// is that of the face's plane, and only parts behind the camera are clipped. Cost: linear in faces
/// plus covered pixels.
std::vector<Hit> rasterize(const TriMesh& mesh, const Pinhole& view);

/// The unit normal of a face, towards the side from which its vertices are counterclockwise; zero
/// for a face without area.
Eigen::Vector3d face_normal(const TriMesh& mesh, std::uint32_t face);

struct Lens {
    int width_px = 800;
    int height_px = 600;
    double focal_px = 760.0;
};

/// A level camera at `center` that looks at `target`; z is up.
Pinhole looking_at(const Lens& lens, const Eigen::Vector3d& center, const Eigen::Vector3d& target);

/// Evenly spaced cameras on an arc of a horizontal circle around a target, all looking at it. Turn
/// 0 is at -y of the target, 90 at +x.
struct Arc {
    Eigen::Vector3d target;
    double radius;
    double height; ///< z of the cameras
    double first_deg;
    double step_deg;
    int count;
};
void add_arc(std::vector<Pinhole>& views, const Lens& lens, const Arc& arc);

} // namespace vcarve::render
