#include "observed/write_model.h"

#include "vcarve/io.h"

#include <fmt/format.h>
#include <fmt/os.h>

#include <cmath>

namespace vcarve::observed {

namespace {

using Eigen::Vector3d;

void write_cameras(const std::filesystem::path& folder, const Scene& scene)
{
    const Camera& camera = scene.cameras.front();
    auto out = fmt::output_file((folder / "cameras.txt").string());
    out.print("# CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n");
    out.print("{} PINHOLE {} {} {}\n", camera.id, camera.width_px, camera.height_px,
              fmt::join(camera.params, " "));
}

void write_images(const std::filesystem::path& folder, const ObservedModel& model)
{
    auto out = fmt::output_file((folder / "images.txt").string());
    out.print("# IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME\n"
              "# POINTS2D[] as (X, Y, POINT3D_ID)\n");
    for (std::size_t i = 0; i < model.scene.views.size(); ++i) {
        const View& view = model.scene.views[i];
        const Eigen::Quaterniond& q = view.cam_from_world;
        const Vector3d t = -(q * view.center);
        out.print("{} {:.9f} {:.9f} {:.9f} {:.9f} {:.6f} {:.6f} {:.6f} {} {}\n", view.id, q.w(),
                  q.x(), q.y(), q.z(), t.x(), t.y(), t.z(), model.scene.cameras.front().id,
                  view.name);
        const char* gap = "";
        for (const Observation& seen : model.observations[i]) {
            out.print("{}{:.1f} {:.1f} {}", gap, seen.place_px.x(), seen.place_px.y(),
                      model.scene.point_ids[seen.point]);
            gap = " ";
        }
        out.print("\n");
    }
}

void write_points(const std::filesystem::path& folder, const ObservedModel& model)
{
    const Scene& scene = model.scene;
    std::vector<std::size_t> listed(scene.views.size(), 0); // 2D points of each view so far
    auto out = fmt::output_file((folder / "points3D.txt").string());
    out.print("# POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)\n");
    for (std::size_t i = 0; i < scene.num_points(); ++i) {
        const Vector3d& p = scene.positions[i];
        const auto& [red, green, blue] = scene.colors[i];
        out.print("{} {:.6f} {:.6f} {:.6f} {} {} {} {:.3f}", scene.point_ids[i], p.x(), p.y(),
                  p.z(), red, green, blue, scene.errors_px[i]);
        for (const std::uint32_t view : scene.tracks[i]) {
            out.print(" {} {}", scene.views[view].id, listed[view]++);
        }
        out.print("\n");
    }
}

} // namespace

void write_model(const std::filesystem::path& folder, const ObservedModel& model)
{
    std::filesystem::create_directories(folder);
    write_cameras(folder, model.scene);
    write_images(folder, model);
    write_points(folder, model);
}

void write_truth(const std::filesystem::path& folder, const ObservedScene& observed)
{
    TriMesh mesh = observed.parts.mesh;
    for (Vector3d& position : mesh.positions) {
        position = 1e-6 * (1e6 * position).array().round();
    }
    std::filesystem::create_directories(folder);
    write_ply(folder / "truth.ply", mesh,
              {false, {"the geometry behind fixtures/" + observed.name}});
}

} // namespace vcarve::observed
