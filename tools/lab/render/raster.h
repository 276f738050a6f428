#pragma once

#include "vcarve/tri_mesh.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace vcarve::render {

/// A lens without distortion at a place in the mesh's frame. Pixel (x, y) is centred at x + 0.5, y
/// + 0.5.
struct Pinhole {
    Eigen::Matrix3d cam_from_world =
        Eigen::Matrix3d::Identity(); ///< rotation; z looks ahead, y down
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    Eigen::Vector2d focal_px = Eigen::Vector2d::Ones();
    Eigen::Vector2d principal_px = Eigen::Vector2d::Zero();
    int width_px = 0;
    int height_px = 0;

    /// The direction in the world of the ray through a place in the image; its z in the camera
    /// is 1.
    Eigen::Vector3d ray(const Eigen::Vector2d& pixel) const;
};

/// The same image with `factor` times the pixels a side.
Pinhole enlarged(const Pinhole& view, int factor);

/// What a pixel shows: the nearest face, or kNoFace.
struct Hit {
    static constexpr std::uint32_t kNoFace = 0xffffffffU;
    std::uint32_t face = kNoFace;
    bool front = false; ///< seen from the side its vertices run counter-clockwise on
    double depth = 0.0; ///< along the camera's z
};

/// Renders a mesh with a depth buffer: one Hit a pixel, row by row. Exact up to rounding: depth
/// comes from the face's plane, nothing is left out but what lies behind the camera. Cost: linear
/// in faces plus pixels covered.
std::vector<Hit> rasterize(const TriMesh& mesh, const Pinhole& view);

/// Unit normal of a face on the side its vertices run counter-clockwise on; zero for a face without
/// area.
Eigen::Vector3d face_normal(const TriMesh& mesh, std::uint32_t face);

struct Lens {
    int width_px = 800;
    int height_px = 600;
    double focal_px = 760.0;
};

/// A level camera at a place that looks at another, z upwards.
Pinhole looking_at(const Lens& lens, const Eigen::Vector3d& center, const Eigen::Vector3d& target);

/// Cameras on an arc of a level circle around a target, evenly spaced, all looking at it. Turn 0
/// stands at -y of the target, 90 at +x.
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
