#pragma once

#include "io/images/calibrated_photo.h"
#include "mesh/first_faces.h"
#include "vcarve/tri_mesh.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>

namespace vcarve {

/// Sample positions on a face: near its corners, near the midpoints of its edges, and its centroid.
std::array<Eigen::Vector3d, 7> face_samples(const std::array<Eigen::Vector3d, 3>& corners);

/// Tests whether faces of a mesh hide a position from a camera. Keeps a copy of the mesh. Cost: as
/// FirstFaces.
class Occlusion {
  public:
    explicit Occlusion(const TriMesh& mesh);

    const TriMesh& mesh() const { return mesh_; }

    /// Whether nothing hides a position on a face from a camera center. Faces within a thousandth
    /// of the distance do not hide it.
    bool sees(const Eigen::Vector3d& center, const Eigen::Vector3d& position,
              std::uint32_t face) const;

    /// How many of the face_samples() of `corners`, which are a part of a face, a photograph sees.
    int seen_places(const CalibratedPhoto& photo, const std::array<Eigen::Vector3d, 3>& corners,
                    std::uint32_t face) const;

    /// Whether a photograph shows a depth discontinuity within 3 pixels of a face. Next to one,
    /// small errors of shape and pose paint the background or a nearer object on the face.
    bool is_near_silhouette(const CalibratedPhoto& photo,
                            const std::array<Eigen::Vector3d, 3>& corners) const;

  private:
    Eigen::Vector3d position_of(const FirstFace& hit) const;

    TriMesh mesh_;
    FirstFaces faces_;
};

} // namespace vcarve
