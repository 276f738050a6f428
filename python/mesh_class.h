#pragma once

#include "vcarve/provenance.h"
#include "vcarve/texture.h"
#include "vcarve/tri_mesh.h"

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

namespace vcarve::python {

/// A mesh in the frame of the model, with its provenance if requested.
struct Mesh {
    TriMesh surface; ///< its offset is zero
    /// The positions before the run's offset was added, and this offset; empty for other meshes.
    /// The program writes .glb files from these, so that rounding would differ otherwise.
    std::vector<Eigen::Vector3d> run_positions;
    Eigen::Vector3d run_offset = Eigen::Vector3d::Zero();
    Provenance provenance;
    Texture texture;
    std::vector<std::string> comments;            ///< of its files
    Eigen::Vector3d up = Eigen::Vector3d::Zero(); ///< up in .glb; zero keeps y
    pybind11::dict counts;                        ///< counts of every stage of the run
};

/// Adds the offset to positions, so they are in the frame of the model. Files do not change.
TriMesh in_frame_of_model(TriMesh mesh);

/// Throws UsageError with the first face that has a vertex out of range. Users can write into the
/// arrays of a mesh at any time.
void require_corners(const TriMesh& mesh);

/// Adds the class Mesh. Its NumPy arrays refer to the library's memory.
void add_mesh_class(pybind11::module_& module);

} // namespace vcarve::python
