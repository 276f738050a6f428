#include "observed/write_model.h"

#include "observed/observe.h"
#include "vcarve/io.h"

#include <fmt/format.h>
#include <fmt/os.h>

#include <cmath>
#include <cstdint>
#include <fstream>
#include <vector>

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
    std::vector<std::size_t> listed(scene.views.size(),
                                    0); // number of 2D points of each view so far
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

/// A plausible order of registration by a mapper: every eleventh view, cyclically.
std::vector<std::uint32_t> registered_order(std::size_t num_views)
{
    std::vector<std::uint32_t> order;
    for (std::size_t first = 0; first < 11; ++first) {
        for (std::size_t view = first; view < num_views; view += 11) {
            order.push_back(static_cast<std::uint32_t>(view));
        }
    }
    return order;
}

template <typename Number>
void put(std::ofstream& file, Number value)
{
    file.write(reinterpret_cast<const char*>(&value), sizeof(value));
}

float rounded(double value, double step)
{
    return static_cast<float>(step > 0.0 ? step * std::round(value / step) : value);
}

void write_cloud(const std::filesystem::path& path, const Scene& scene, double step)
{
    std::ofstream file(path, std::ios::binary);
    file << "ply\nformat binary_little_endian 1.0\nelement vertex " << scene.num_points();
    for (const char* name : {"x", "y", "z", "nx", "ny", "nz"}) {
        file << "\nproperty float " << name;
    }
    file << "\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n";
    for (std::size_t i = 0; i < scene.num_points(); ++i) {
        for (const double coordinate : scene.positions[i]) {
            put(file, rounded(coordinate, step));
        }
        for (const float coordinate : scene.normals[i]) {
            put(file, rounded(coordinate, step));
        }
        for (const std::uint8_t channel : scene.colors[i]) {
            put(file, channel);
        }
    }
}

void write_visibility(const std::filesystem::path& path, const Scene& scene,
                      const std::vector<std::uint32_t>& order)
{
    std::vector<std::uint32_t> place_of(order.size());
    for (std::uint32_t place = 0; place < order.size(); ++place) {
        place_of[order[place]] = place;
    }
    std::ofstream file(path, std::ios::binary);
    put(file, std::uint64_t{scene.num_points()});
    for (std::size_t i = 0; i < scene.num_points(); ++i) {
        put(file, static_cast<std::uint32_t>(scene.tracks[i].size()));
        for (const std::uint32_t view : scene.tracks[i]) {
            put(file, place_of[view]);
        }
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

void write_workspace(const std::filesystem::path& folder, const Scene& scene, double step)
{
    const std::vector<std::uint32_t> order = registered_order(scene.views.size());
    ObservedModel model;
    model.scene.cameras = scene.cameras;
    for (const std::uint32_t view : order) {
        model.scene.views.push_back(scene.views[view]);
    }
    model.observations.resize(scene.views.size());
    write_model(folder / "sparse", model);
    write_cloud(folder / "fused.ply", scene, step);
    write_visibility(folder / "fused.ply.vis", scene, order);
}

} // namespace vcarve::observed
