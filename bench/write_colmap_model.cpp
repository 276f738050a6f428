// The layout is documented at https://colmap.github.io/format.html.

#include "sample_scene.h"
#include "sample_shapes.h"
#include "vcarve/error.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <fstream>
#include <type_traits>

namespace vcarve::bench {

namespace {

/// A file of little-endian records without padding.
class RecordWriter {
  public:
    explicit RecordWriter(const std::filesystem::path& path)
        : path_(path), file_(path, std::ios::binary)
    {
    }

    template <typename T>
    void put(const T& value)
    {
        static_assert(std::is_trivially_copyable_v<T> &&
                      std::endian::native == std::endian::little);
        file_.write(reinterpret_cast<const char*>(&value), sizeof(T));
    }

    void put_text(const std::string& text)
    {
        file_.write(text.c_str(), static_cast<std::streamsize>(text.size() + 1));
    }

    void close()
    {
        file_.close();
        if (!file_) throw UsageError(fmt::format("cannot write {}", path_.string()));
    }

  private:
    std::filesystem::path path_;
    std::ofstream file_;
};

void write_cameras(const std::filesystem::path& path, const Scene& scene)
{
    RecordWriter file(path);
    file.put(std::uint64_t{scene.cameras.size()});
    for (const Camera& camera : scene.cameras) {
        file.put(camera.id);
        file.put(std::int32_t{camera.model});
        file.put(camera.width_px);
        file.put(camera.height_px);
        for (const double param : camera.params) {
            file.put(param);
        }
    }
    file.close();
}

/// For each view the points it sees, ascending.
std::vector<std::vector<std::uint32_t>> points_of_views(const Scene& scene)
{
    std::vector<std::vector<std::uint32_t>> points(scene.views.size());
    for (std::uint32_t point = 0; point < scene.num_points(); ++point) {
        for (const std::uint32_t view : scene.tracks[point]) {
            points[view].push_back(point);
        }
    }
    return points;
}

void write_images(const std::filesystem::path& path, const Scene& scene)
{
    const auto points_of = points_of_views(scene);
    RecordWriter file(path);
    file.put(std::uint64_t{scene.views.size()});
    for (std::size_t i = 0; i < scene.views.size(); ++i) {
        const View& view = scene.views[i];
        const Eigen::Quaterniond& q = view.cam_from_world;
        const Eigen::Vector3d translation = -(q * view.center);
        file.put(view.id);
        file.put(std::array{q.w(), q.x(), q.y(), q.z()});
        file.put(std::array{translation.x(), translation.y(), translation.z()});
        file.put(scene.cameras[view.camera].id);
        file.put_text(view.name);
        file.put(std::uint64_t{points_of[i].size()});
        for (const std::uint32_t point : points_of[i]) {
            const Eigen::Vector2d pixel_px = in_image(in_camera(view, scene.positions[point]));
            file.put(std::array{pixel_px.x(), pixel_px.y()});
            file.put(scene.point_ids[point]);
        }
    }
    file.close();
}

void write_points(const std::filesystem::path& path, const Scene& scene)
{
    std::vector<std::uint32_t> listed(scene.views.size(), 0); // 2D points of each view so far
    RecordWriter file(path);
    file.put(std::uint64_t{scene.num_points()});
    for (std::size_t point = 0; point < scene.num_points(); ++point) {
        const Eigen::Vector3d& position = scene.positions[point];
        file.put(scene.point_ids[point]);
        file.put(std::array{position.x(), position.y(), position.z()});
        file.put(scene.colors[point]);
        file.put(scene.errors_px[point]);
        file.put(std::uint64_t{scene.tracks[point].size()});
        for (const std::uint32_t view : scene.tracks[point]) {
            file.put(scene.views[view].id);
            file.put(listed[view]++);
        }
    }
    file.close();
}

} // namespace

void write_colmap_model(const std::filesystem::path& folder, const Scene& scene)
{
    std::filesystem::create_directories(folder);
    write_cameras(folder / "cameras.bin", scene);
    write_images(folder / "images.bin", scene);
    write_points(folder / "points3D.bin", scene);
}

} // namespace vcarve::bench
