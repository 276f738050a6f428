// https://colmap.github.io/format.html documents the layout. Points are written part by part.
// images.bin groups the 2D points of each image. They are therefore written after all points, from
// points3D.bin, each at the position of its image.

#include "io/colmap/byte_reader.h"
#include "io/files/mapped_file.h"
#include "model/scene_points.h"
#include "sample_scene.h"
#include "sample_shapes.h"
#include "vcarve/error.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <fstream>
#include <type_traits>
#include <unordered_map>
#include <utility>
#include <vector>

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

    template <typename T>
    void put_all(const std::vector<T>& values)
    {
        file_.write(reinterpret_cast<const char*>(values.data()),
                    static_cast<std::streamsize>(values.size() * sizeof(T)));
    }

    void put_text(const std::string& text)
    {
        file_.write(text.c_str(), static_cast<std::streamsize>(text.size() + 1));
    }

    /// Continues writing at this byte.
    void go_to(std::uint64_t byte) { file_.seekp(static_cast<std::streamoff>(byte)); }
    std::uint64_t byte() { return static_cast<std::uint64_t>(file_.tellp()); }

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

using Counts2d = std::vector<std::uint32_t>; ///< number of 2D points of each view

/// points3D.bin, part by part.
class PointsFile {
  public:
    PointsFile(const std::filesystem::path& path, std::size_t num_points, std::size_t num_views)
        : file_(path), listed_(num_views, 0)
    {
        file_.put(std::uint64_t{num_points});
    }

    void add(const Scene& part)
    {
        for (std::size_t point = 0; point < part.num_points(); ++point) {
            const Eigen::Vector3d& position = part.positions[point];
            file_.put(part.point_ids[point]);
            file_.put(std::array{position.x(), position.y(), position.z()});
            file_.put(part.colors[point]);
            file_.put(part.errors_px[point]);
            file_.put(std::uint64_t{part.tracks[point].size()});
            for (const std::uint32_t view : part.tracks[point]) {
                file_.put(part.views[view].id);
                file_.put(listed_[view]++);
            }
        }
    }

    Counts2d close()
    {
        file_.close();
        return std::move(listed_);
    }

  private:
    RecordWriter file_;
    Counts2d listed_; ///< 2D points so far
};

/// A 2D point of an image.
struct Seen {
    std::array<double, 2> pixel_px;
    std::uint64_t point_id;
};
static_assert(sizeof(Seen) == 24, "records are written without padding");

/// images.bin. Its 2D points are collected and written in batches.
class ImagesFile {
  public:
    ImagesFile(const std::filesystem::path& path, const Scene& scene, const Counts2d& counts)
        : file_(path), views_(scene.views), seen_(scene.views.size())
    {
        file_.put(std::uint64_t{views_.size()});
        for (std::uint32_t i = 0; i < views_.size(); ++i) {
            put_view(views_[i], scene.cameras[views_[i].camera].id);
            file_.put(std::uint64_t{counts[i]});
            places_.push_back(file_.byte());
            file_.go_to(places_.back() + counts[i] * sizeof(Seen));
            index_of_[views_[i].id] = i;
        }
    }

    void add(std::uint32_t view_id, const Eigen::Vector3d& position, std::uint64_t point_id)
    {
        const std::uint32_t view = index_of_.at(view_id);
        const Eigen::Vector2d pixel_px = in_image(in_camera(views_[view], position));
        seen_[view].push_back({{pixel_px.x(), pixel_px.y()}, point_id});
        if (++num_seen_ == kAtOnce) write_seen();
    }

    void close()
    {
        write_seen();
        file_.close();
    }

  private:
    static constexpr std::size_t kAtOnce = std::size_t{1} << 17U;

    void put_view(const View& view, std::uint32_t camera_id)
    {
        const Eigen::Quaterniond& q = view.cam_from_world;
        const Eigen::Vector3d translation = -(q * view.center);
        file_.put(view.id);
        file_.put(std::array{q.w(), q.x(), q.y(), q.z()});
        file_.put(std::array{translation.x(), translation.y(), translation.z()});
        file_.put(camera_id);
        file_.put_text(view.name);
    }

    void write_seen()
    {
        for (std::size_t i = 0; i < seen_.size(); ++i) {
            if (seen_[i].empty()) continue;
            file_.go_to(places_[i]);
            file_.put_all(seen_[i]);
            places_[i] += seen_[i].size() * sizeof(Seen);
            seen_[i].clear();
        }
        num_seen_ = 0;
    }

    RecordWriter file_;
    const std::vector<View>& views_;
    std::vector<std::uint64_t> places_; ///< file offset of the next 2D point of each view
    std::vector<std::vector<Seen>> seen_;
    std::size_t num_seen_ = 0; ///< of all views
    std::unordered_map<std::uint32_t, std::uint32_t> index_of_;
};

/// Writes images.bin from the file of points.
void write_images(const std::filesystem::path& path, const Scene& scene, const Counts2d& counts,
                  const std::filesystem::path& points_path)
{
    const MappedFile points(points_path);
    ByteReader reader(points.bytes(), points_path.string());
    ReadOnce pages(points);
    ImagesFile file(path, scene, counts);
    const auto num_points = reader.read<std::uint64_t>("the number of points");
    for (std::uint64_t i = 0; i < num_points; ++i) {
        const auto id = reader.read<std::uint64_t>("the id of a point");
        const auto position = reader.read<std::array<double, 3>>("the position of a point");
        reader.skip(1, sizeof(Color) + sizeof(double));
        const auto length = reader.read<std::uint64_t>("the length of a track");
        for (std::uint64_t ray = 0; ray < length; ++ray) {
            const auto view_id = reader.read<std::uint32_t>("the track of a point");
            reader.skip(1, sizeof(std::uint32_t));
            file.add(view_id, {position[0], position[1], position[2]}, id);
        }
        pages.read_up_to(reader.offset());
    }
    file.close();
}

} // namespace

void write_colmap_model(const std::filesystem::path& folder, SceneParts& parts)
{
    constexpr std::size_t kMostPoints = 16 * kSampleBlock;
    std::filesystem::create_directories(folder);
    Scene part = parts.next(kMostPoints, {});
    write_cameras(folder / "cameras.bin", part);
    const Scene views = without_points(part);
    PointsFile points(folder / "points3D.bin", parts.num_points(), views.views.size());
    while (part.num_points() > 0) {
        points.add(part);
        part = parts.next(kMostPoints, {});
    }
    write_images(folder / "images.bin", views, points.close(), folder / "points3D.bin");
}

void write_colmap_model(const std::filesystem::path& folder, const Scene& scene)
{
    PartsOfScene parts(scene);
    write_colmap_model(folder, parts);
}

} // namespace vcarve::bench
