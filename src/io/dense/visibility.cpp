#include "io/dense/visibility.h"

#include "base/arrays.h"
#include "base/parallel.h"
#include "io/files/output_file.h"
#include "model/camera.h"
#include "vcarve/error.h"
#include "vcarve/io.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace vcarve {
namespace {

constexpr std::size_t kNumberBytes = 4; ///< size of each view count and each image index
constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
/// Number of points between two calls of Progress::report.
constexpr std::uint64_t kPointsBetweenTells = 65536;

/// Fills the rows of tracks in parallel. Precondition: `begins` is complete.
class RowFiller {
  public:
    /// `bytes` starts at the first row.
    RowFiller(std::span<const char> bytes, std::span<const std::uint32_t> file_order,
              Tracks& tracks)
        : bytes_(bytes), file_order_(file_order), tracks_(tracks)
    {
    }

    void fill(const Progress& progress)
    {
        parallel_for(tracks_.size(), progress, [&](std::size_t point) { fill_row(point); });
    }

    /// The first point with an invalid image index, or kNone.
    std::size_t first_wrong() const { return first_wrong_; }
    bool has_repeated_views() const { return repeats_; }

    /// The first invalid image index of that point.
    std::uint32_t wrong_image() const
    {
        const std::uint64_t first = tracks_.begins[first_wrong_];
        for (std::uint64_t i = first;; ++i) {
            const std::uint32_t image = image_at(first_wrong_, i);
            if (image >= file_order_.size()) return image;
        }
    }

  private:
    /// The image index `i`, counted over all rows and belonging to `point`. It follows the lengths
    /// of the rows up to `point` and the earlier `i` indices.
    std::uint32_t image_at(std::size_t point, std::uint64_t i) const
    {
        std::uint32_t image = 0;
        const std::size_t place = kNumberBytes * (point + 1 + i);
        std::memcpy(&image, bytes_.data() + place, sizeof(image));
        return image;
    }

    void fill_row(std::size_t point)
    {
        const auto begin = static_cast<std::ptrdiff_t>(tracks_.begins[point]);
        const auto end = static_cast<std::ptrdiff_t>(tracks_.begins[point + 1]);
        const std::span row(tracks_.views.begin() + begin, tracks_.views.begin() + end);
        for (std::size_t i = 0; i < row.size(); ++i) {
            const std::uint32_t image = image_at(point, tracks_.begins[point] + i);
            if (image >= file_order_.size()) {
                atomic_min(first_wrong_, point);
                return;
            }
            row[i] = file_order_[image];
        }
        std::ranges::sort(row);
        if (std::ranges::adjacent_find(row) != row.end()) repeats_ = true;
    }

    std::span<const char> bytes_;
    std::span<const std::uint32_t> file_order_;
    Tracks& tracks_;
    std::size_t first_wrong_ = kNone; ///< threads lower it atomically
    std::atomic<bool> repeats_ = false;
};

/// Removes repeated views from sorted rows, and closes the gaps between rows.
void merge_repeated_views(Tracks& tracks)
{
    std::uint64_t begin = 0; // of the row in the file
    auto end = tracks.views.begin();
    for (std::size_t point = 0; point < tracks.size(); ++point) {
        const auto row = tracks.views.begin() + static_cast<std::ptrdiff_t>(begin);
        begin = tracks.begins[point + 1];
        end = std::unique_copy(row, tracks.views.begin() + static_cast<std::ptrdiff_t>(begin), end);
        tracks.begins[point + 1] = static_cast<std::uint64_t>(end - tracks.views.begin());
    }
    tracks.views.erase(end, tracks.views.end());
}

/// The fraction of rays whose view shows the point, from a sample of about a thousand points.
double share_shown(const Tracks& tracks, const Scene& scene)
{
    constexpr std::size_t kPoints = 1000;
    const std::size_t step = tracks.size() / kPoints + 1;
    double rays = 0.0;
    double shown = 0.0;
    for (std::size_t point = 0; point < tracks.size(); point += step) {
        for (const std::uint32_t index : tracks[point]) {
            const View& view = scene.views[index];
            const Camera& camera = scene.cameras[view.camera];
            rays += 1.0;
            shown += view_shows(view, camera, scene.positions[point]) ? 1.0 : 0.0;
        }
    }
    return rays > 0.0 ? shown / rays : 1.0;
}

} // namespace

VisibilityReader::VisibilityReader(const std::filesystem::path& path, const CloudSize& cloud,
                                   std::vector<std::uint32_t> file_order)
    : path_(path),
      file_(path),
      reader_(file_.bytes(), path.string()),
      file_order_(std::move(file_order)),
      num_points_(reader_.read_count(kNumberBytes, "points"))
{
    if (num_points_ != cloud.num_points) {
        throw InputError(fmt::format("{}: has the views of {} points, but {} has {} points; for a "
                                     "cropped or thinned cloud, use --rays nearest (--crop "
                                     "reconstructs a region of the whole cloud)",
                                     path.string(), num_points_, cloud.path.string(),
                                     cloud.num_points));
    }
}

/// The offsets of the next rows, from the row lengths.
std::vector<std::uint64_t> VisibilityReader::begins_of_rows(std::size_t count,
                                                            const Progress& progress)
{
    std::vector<std::uint64_t> begins{0};
    begins.reserve(count + 1);
    for (std::uint64_t i = 0; i < count; ++i) {
        const std::size_t begin = reader_.offset();
        const auto length = reader_.read<std::uint32_t>("the number of views of a point");
        const std::size_t most = reader_.left() / kNumberBytes;
        if (length > most) {
            throw InputError(fmt::format("{}: byte {}: found a count of {} views of point {}, but "
                                         "the rest of the file can hold {} at most",
                                         path_.string(), begin, length, done_ + i, most));
        }
        reader_.skip(length, kNumberBytes);
        begins.push_back(begins.back() + length);
        if (i % kPointsBetweenTells == 0) {
            progress.report(static_cast<double>(i), static_cast<double>(count));
        }
    }
    if (done_ + count == num_points_) reader_.expect_end("the views of the last point");
    return begins;
}

Tracks VisibilityReader::next(std::size_t most, const Progress& progress)
{
    const std::size_t count = std::min<std::uint64_t>(most, num_points_ - done_);
    const std::size_t first_byte = reader_.offset();
    Tracks tracks;
    tracks.begins = begins_of_rows(count, progress.part(0.0, 0.5));
    tracks.views.resize(tracks.begins.back());
    RowFiller rows(file_.bytes().subspan(first_byte), file_order_, tracks);
    rows.fill(progress.part(0.5, 1.0));
    if (rows.first_wrong() != kNone) {
        throw InputError(fmt::format("{}: point {} of {} has image {}, but the model has {} "
                                     "images, counted from 0",
                                     path_.string(), done_ + rows.first_wrong(), num_points_,
                                     rows.wrong_image(), file_order_.size()));
    }
    if (rows.has_repeated_views()) merge_repeated_views(tracks);
    done_ += count;
    file_.release(reader_.offset());
    return tracks;
}

std::optional<Tracks> tracks_of_lists(const Tracks& lists,
                                      std::span<const std::uint32_t> file_order, const Scene& scene,
                                      std::string& note)
{
    constexpr double kMost = 0.9;
    constexpr const char* kInstead = "so the nearest views are used instead";
    const auto last = std::ranges::max_element(lists.views);
    if (last != lists.views.end() && *last >= file_order.size()) {
        note = fmt::format("its lists view_indices contain image {}, but the model has {} images, "
                           "counted from 0, {}",
                           *last, file_order.size(), kInstead);
        return std::nullopt;
    }
    Tracks tracks;
    std::vector<std::uint32_t> row;
    for (std::size_t point = 0; point < lists.size(); ++point) {
        row.clear();
        for (const std::uint32_t image : lists[point]) {
            row.push_back(file_order[image]);
        }
        sort_unique(row);
        tracks.push_back(row);
    }
    const double shown = share_shown(tracks, scene);
    if (shown >= kMost) return tracks;
    note = fmt::format("{:.0f} % of the images in its lists view_indices do not show the point, "
                       "and they seem to belong to another model, {}",
                       100.0 * (1.0 - shown), kInstead);
    return std::nullopt;
}

std::filesystem::path visibility_beside(const std::filesystem::path& cloud)
{
    return cloud.string() + ".vis";
}

void write_dense_points(const std::filesystem::path& cloud, const Scene& scene,
                        std::span<const std::uint32_t> file_order)
{
    TriMesh points;
    points.positions = scene.positions;
    points.colors = scene.colors;
    points.normals = scene.normals;
    points.offset = scene.offset;
    write_mesh(cloud, points, {});
    std::vector<std::uint32_t> number_of_view(scene.views.size());
    for (std::uint32_t number = 0; number < file_order.size(); ++number) {
        number_of_view[file_order[number]] = number;
    }
    OutputFile file(visibility_beside(cloud));
    const auto put = [&](const auto value) {
        file.stream().write(reinterpret_cast<const char*>(&value), sizeof value);
    };
    put(static_cast<std::uint64_t>(scene.num_points()));
    for (std::size_t point = 0; point < scene.num_points(); ++point) {
        const auto track = scene.tracks[point];
        put(static_cast<std::uint32_t>(track.size()));
        for (const std::uint32_t view : track) {
            put(number_of_view[view]);
        }
    }
    file.commit();
}

} // namespace vcarve
