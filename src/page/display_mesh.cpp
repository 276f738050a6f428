#include "page/display_mesh.h"

#include "base/median.h"
#include "mesh/half_edge_mesh.h"
#include "mesh/used_vertices.h"
#include "model/scene_points.h"
#include "steps/6_surface/split_nonmanifold.h"

#include <Eigen/Core>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModNormalFlippingT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace vcarve {

namespace {

/// The vertices that the faces use, in their order, and what belongs to them.
TriMesh with_used_vertices(const TriMesh& mesh, std::vector<Face> faces)
{
    const std::vector<std::uint32_t> vertices = used_vertices(faces, mesh.positions.size());
    renumber(faces, vertices, mesh.positions.size());
    TriMesh used;
    used.offset = mesh.offset;
    used.positions = values_at(vertices, mesh.positions);
    used.colors = values_at(vertices, mesh.colors);
    used.points = values_at(vertices, mesh.points);
    used.faces = std::move(faces);
    return used;
}

/// Evenly chosen ones of the faces.
TriMesh some_faces(const TriMesh& mesh, std::size_t max_faces)
{
    std::vector<Face> faces(std::min(mesh.faces.size(), max_faces));
    for (std::size_t i = 0; i < faces.size(); ++i) {
        faces[i] = mesh.faces[i * mesh.faces.size() / faces.size()];
    }
    return with_used_vertices(mesh, std::move(faces));
}

/// The power of two next to the median length of the faces' first edges.
double usual_length(const TriMesh& mesh)
{
    std::vector<double> lengths;
    lengths.reserve(mesh.faces.size());
    for (const Face& face : mesh.faces) {
        lengths.push_back((mesh.positions[face[1]] - mesh.positions[face[0]]).norm());
    }
    const double middle = median_in_place(lengths);
    return middle > 0.0 ? std::exp2(std::round(std::log2(middle))) : 1.0;
}

/// Tells how far collapsing has come; a collapse takes about two faces.
class CollapseProgress final : public OpenMesh::Decimater::Observer {
  public:
    CollapseProgress(const Progress& progress, std::size_t faces, std::size_t wanted)
        : Observer(128), progress_(progress), collapses_(static_cast<double>(faces - wanted) / 2.0)
    {
    }

    void notify(std::size_t collapses) override
    {
        progress_.tell(std::min(1.0, static_cast<double>(collapses) / collapses_));
    }

  private:
    Progress progress_;
    double collapses_;
};

/// Collapses the edge that costs least, again and again, as far as no face turns over.
void decimate(HalfEdgeMesh& mesh, std::size_t max_faces, const Progress& progress)
{
    mesh.request_face_normals();
    mesh.update_face_normals();
    OpenMesh::Decimater::DecimaterT<HalfEdgeMesh> decimater(mesh);
    OpenMesh::Decimater::ModQuadricT<HalfEdgeMesh>::Handle quadrics;
    OpenMesh::Decimater::ModNormalFlippingT<HalfEdgeMesh>::Handle flipping;
    decimater.add(quadrics);
    decimater.add(flipping);
    decimater.module(quadrics).unset_max_err();
    decimater.module(flipping).set_max_normal_deviation(60.0);
    decimater.initialize();
    CollapseProgress told(progress, mesh.n_faces(), max_faces);
    decimater.set_observer(&told);
    decimater.decimate_to_faces(0, max_faces);
    mesh.release_face_normals();
}

TriMesh collapse_edges(const TriMesh& mesh, std::size_t max_faces, const Progress& progress)
{
    ManifoldSurface manifold = split_nonmanifold(mesh);
    // OpenMesh's costs are floats: edges of about 1 keep them in range. Powers of two scale
    // exactly.
    const double unit = usual_length(mesh);
    for (Eigen::Vector3d& position : manifold.mesh.positions) {
        position /= unit;
    }
    HalfEdgeMesh surface(manifold.mesh, manifold.twins);
    manifold = {};
    if (surface.n_faces() > max_faces) decimate(surface, max_faces, progress);
    TriMesh collapsed = tri_mesh(surface);
    for (Eigen::Vector3d& position : collapsed.positions) {
        position *= unit;
    }
    return collapsed;
}

} // namespace

TriMesh display_mesh(const TriMesh& mesh, std::int64_t max_faces, const Progress& progress)
{
    const auto wanted = static_cast<std::size_t>(std::max<std::int64_t>(max_faces, 1));
    if (mesh.faces.size() <= wanted) return mesh;
    const TriMesh collapsed = collapse_edges(mesh, wanted, progress);
    return collapsed.faces.size() <= wanted ? collapsed : some_faces(collapsed, wanted);
}

} // namespace vcarve
