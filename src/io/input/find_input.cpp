#include "io/input/find_input.h"

#include "base/text.h"
#include "io/colmap/model_files.h"
#include "io/colmap/transforms_json.h"
#include "io/files/foreign_file.h"
#include "io/files/mapped_file.h"
#include "io/ply/ply_file.h"
#include "vcarve/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <system_error>
#include <utility>

namespace vcarve {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFused = "fused.ply";

bool is_ply_file(const fs::path& path)
{
    return path.extension() == ".ply" && is_file(path);
}

/// The file of --visibility, or the one beside the cloud. Empty for --rays nearest.
fs::path visibility_of(const fs::path& cloud, const PointsOptions& options)
{
    if (options.rays == RaysFrom::nearest) return {};
    if (!options.visibility.empty()) return options.visibility;
    fs::path beside = cloud;
    return beside += ".vis";
}

/// Whether a cloud has lists of the images that saw its points. False for a broken file, which is
/// reported when it is read.
bool has_lists(const fs::path& cloud)
{
    try {
        const PlyHeader header = read_ply_header(cloud);
        const PlyElement* const vertices = header.find("vertex");
        return vertices != nullptr && PlyVertexLayout(*vertices).has_images();
    } catch (const InputError&) {
        return false;
    }
}

/// Whether a file or lists have the views of a cloud's points, or --rays nearest needs none.
bool has_rays(const fs::path& cloud, const PointsOptions& options)
{
    return options.rays == RaysFrom::nearest || is_file(visibility_of(cloud, options)) ||
           has_lists(cloud);
}

/// Throws InputError if the file is a mesh. MeshLab writes an empty element `face` into clouds.
void refuse_mesh(const fs::path& cloud)
{
    const PlyHeader header = read_ply_header(cloud);
    const PlyElement* faces = header.find("face");
    if (faces == nullptr || faces->count == 0) return;
    throw InputError(fmt::format("{}: found a mesh of {} faces, but a model or point cloud is "
                                 "expected; colmap-vcarve compare MODEL {} measures meshes",
                                 cloud.string(), faces->count, cloud.string()));
}

/// The scanner positions in a file. None for a broken file, which is reported when it is read.
PlyScanners scanners_of(const fs::path& cloud)
{
    try {
        return scanners_in(read_ply_header(cloud));
    } catch (const InputError&) {
        return PlyScanners::none;
    }
}

/// Whether a cloud is a scan: scanner positions are known, and options select no other rays. PCL
/// writes a camera into every cloud, so it counts only if no file has the views.
bool is_scan(const fs::path& cloud, const PointsOptions& options)
{
    if (options.scanner) return true;
    if (!options.visibility.empty() || options.rays == RaysFrom::nearest) return false;
    const PlyScanners scanners = scanners_of(cloud);
    return scanners == PlyScanners::each ||
           (scanners == PlyScanners::one_for_all && !is_file(visibility_of(cloud, options)));
}

/// Throws UsageError if --scanner contradicts the other options or the cloud.
void check_scanner(const fs::path& cloud, const PointsOptions& options)
{
    if (!options.scanner) return;
    const std::string given = fmt::format("--scanner {}", fmt::join(*options.scanner, ","));
    if (!options.visibility.empty() || options.rays == RaysFrom::nearest) {
        throw UsageError(fmt::format(
            "{} gives the scanner position, so it cannot be combined with {}", given,
            options.visibility.empty() ? "--rays nearest"
                                       : "--visibility " + options.visibility.string()));
    }
    if (scanners_of(cloud) == PlyScanners::each) {
        throw UsageError(fmt::format("{} is one position for all points, but {} has a scanner "
                                     "position for each point",
                                     given, cloud.string()));
    }
}

/// A note about the source of the scanner positions.
std::string note_on_scan(const fs::path& cloud, const PointsOptions& options)
{
    const std::string points =
        fmt::format("points are read from {} with the scanner ", cloud.string());
    if (options.scanner) {
        return points + fmt::format("at {}", fmt::join(*options.scanner, ", "));
    }
    if (scanners_of(cloud) == PlyScanners::each) {
        return points + "position of each point";
    }
    return points + "position of its element camera";
}

FoundInput scan_input(FoundModel model, const fs::path& cloud, const PointsOptions& options)
{
    check_scanner(cloud, options);
    if (!is_file(cloud)) {
        throw InputError(fmt::format("{}: {}; expected a PLY file of scanned points",
                                     cloud.string(), file_problem(cloud)));
    }
    std::string note = note_on_scan(cloud, options);
    const fs::path visibility = visibility_of(cloud, options);
    if (!model.folder.empty()) {
        note += fmt::format("; the views of {} are ignored", model.folder.string());
    } else if (is_file(visibility)) {
        note += fmt::format("; {} is ignored (--visibility selects it)", visibility.string());
    }
    std::vector<std::string> notes = model.notes;
    notes.push_back(note);
    return {std::move(model), std::nullopt, ScanFile{cloud, options.scanner}, std::move(notes)};
}

/// The model in the folder of a cloud.
FoundModel model_around(const fs::path& cloud)
{
    try {
        return find_model(cloud.has_parent_path() ? cloud.parent_path() : fs::path("."),
                          PointsFile::another);
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}; without a model, {} needs scanner positions "
                                     "(--scanner x,y,z sets one)",
                                     error.what(), cloud.string()));
    }
}

/// A note about the cloud and the source of its views.
std::string note_on(const DenseFiles& files)
{
    if (files.takes_lists) {
        return fmt::format("points are read from {}, with the views of {} in their lists "
                           "view_indices",
                           files.cloud.string(), files.model.string());
    }
    if (files.visibility.empty()) {
        return fmt::format("points are read from {}; no file has their views, so they get the "
                           "nearest views of {} with an unobstructed line to them",
                           files.cloud.string(), files.model.string());
    }
    return fmt::format("points are read from {}, with views of {}", files.cloud.string(),
                       files.model.string());
}

FoundInput dense_input(FoundModel model, const fs::path& cloud, const PointsOptions& options)
{
    if (is_scan(cloud, options)) return scan_input(std::move(model), cloud, options);
    if (options.rays == RaysFrom::nearest && !options.visibility.empty()) {
        throw UsageError(fmt::format("--rays nearest reads no file, so it cannot be combined with "
                                     "--visibility {}",
                                     options.visibility.string()));
    }
    fs::path visibility = visibility_of(cloud, options);
    const bool takes_lists = options.visibility.empty() && !visibility.empty() &&
                             !is_file(visibility) && has_lists(cloud);
    if (takes_lists) visibility.clear();
    if (!is_file(cloud)) {
        throw InputError(fmt::format("{}: {}; expected dense points for the views of {}",
                                     cloud.string(), file_problem(cloud), model.folder.string()));
    }
    if (!visibility.empty() && !is_file(visibility)) {
        throw InputError(
            fmt::format("{}: {}; expected the views of the points of {}, as written by "
                        "COLMAP's stereo_fusion (--visibility selects another file, "
                        "--rays nearest needs none)",
                        visibility.string(), file_problem(visibility), cloud.string()));
    }
    std::vector<std::string> notes = model.notes;
    DenseFiles files{model.folder, model.format, cloud, visibility, takes_lists};
    notes.push_back(note_on(files));
    return {std::move(model), std::move(files), std::nullopt, std::move(notes)};
}

/// Like dense_input(), but points without views get the nearest views. These points count as sparse
/// if the file has a name that nerfstudio and converters give to COLMAP's points.
FoundInput input_of_points(FoundModel model, const fs::path& cloud, const PointsOptions& options)
{
    PointsOptions chosen = options;
    const bool has_visibility = !options.visibility.empty() || has_rays(cloud, options);
    if (options.rays == RaysFrom::automatic && !has_visibility) {
        chosen.rays = RaysFrom::nearest;
    }
    FoundInput found = dense_input(std::move(model), cloud, chosen);
    const bool is_named_so = cloud.filename() == kSparsePly || cloud.filename() == kPointsPly;
    if (found.dense) found.dense->are_sparse = chosen.rays == RaysFrom::nearest && is_named_so;
    return found;
}

/// Uses points3D.ply, whose points usually have no views, if a model has no other points.
std::optional<FoundInput> points_ply_input(const FoundModel& model, const PointsOptions& options)
{
    const fs::path cloud = model.folder / kPointsPly;
    std::string fault;
    if (!is_file(cloud) || count_points(model.folder, model.format, &fault) > 0) {
        return std::nullopt;
    }
    FoundInput found = input_of_points(model, cloud, options);
    if (!fault.empty()) found.notes.push_back(fault + "; copy it again to use its points");
    return found;
}

/// Uses the poses of transforms.json, and the points that it or --points selects.
FoundInput transforms_input(const fs::path& file, const PointsOptions& options)
{
    fs::path cloud = points_of_transforms(file);
    if (options.points == "dense") {
        cloud = file.parent_path() / kFused;
    } else if (!options.points.empty() && options.points != "sparse") {
        cloud = options.points;
    }
    if (cloud.empty()) {
        throw InputError(
            fmt::format("{}: has no ply_file_path, and its folder has no sparse_pc.ply "
                        "or points3D.ply; select a PLY file in the frame of the "
                        "poses with --points FILE",
                        file.string()));
    }
    refuse_foreign_name(cloud);
    return input_of_points({file, ModelFormat::transforms, {}}, cloud, options);
}

/// Returns `input` if it is a .json file, or such a file in the folder `input`. A COLMAP model in
/// the folder is preferred, because it has tracks.
std::optional<fs::path> find_transforms(const fs::path& input)
{
    if (is_file(input) && lower_case_end(input) == ".json") return input;
    // Reading one of the last three throws an error that explains the conversion.
    constexpr std::array kNames = {kTransforms, kTransformsTrain, "cameras.json",
                                   "reconstruction.json", "sfm_data.json"};
    const auto* const name =
        std::ranges::find_if(kNames, [&](const char* each) { return is_file(input / each); });
    if (name == kNames.end()) return std::nullopt;
    try {
        find_model(input);
    } catch (const InputError&) {
        return input / *name;
    }
    return std::nullopt;
}

FoundInput sparse_input(FoundModel model, const PointsOptions& options)
{
    if (auto found = points_ply_input(model, options)) return *found;
    if (options.scanner) {
        throw UsageError(fmt::format("--scanner {} is for the points of a PLY file, but the sparse "
                                     "points of {} are used",
                                     fmt::join(*options.scanner, ","), model.folder.string()));
    }
    if (!options.visibility.empty()) {
        throw UsageError(fmt::format("--visibility {} is for the points of a PLY file, but the "
                                     "sparse points of {} are used",
                                     options.visibility.string(), model.folder.string()));
    }
    std::vector<std::string> notes = model.notes;
    return {std::move(model), std::nullopt, std::nullopt, std::move(notes), options.rays};
}

/// Adds a note about a dense workspace in the folder, which the user may prefer.
void mention_other_cloud(const fs::path& input, FoundInput& found)
{
    for (const char* folder : {"dense", "dense/0"}) {
        const fs::path workspace = input / folder;
        if (!is_file(workspace / kFused)) continue;
        found.notes.push_back(
            fmt::format("sparse points are used; the input {} selects the points of {}",
                        workspace.string(), (workspace / kFused).string()));
        return;
    }
}

FoundInput look_for_points(FoundModel model, const fs::path& input, const PointsOptions& options)
{
    const fs::path fused = input / kFused;
    if (!is_file(fused)) {
        FoundInput found = sparse_input(std::move(model), options);
        mention_other_cloud(input, found);
        return found;
    }
    const bool has_visibility =
        !options.visibility.empty() || options.rays == RaysFrom::nearest || is_scan(fused, options);
    if (has_visibility || is_file(visibility_of(fused, options))) {
        FoundInput found = dense_input(std::move(model), fused, options);
        found.notes.back() += "; --points sparse selects the sparse points";
        return found;
    }
    FoundInput found = sparse_input(std::move(model), options);
    found.notes.push_back(fmt::format("sparse points are used and {} is ignored, because {} with "
                                      "its views is missing; --rays nearest needs no views",
                                      fused.string(), visibility_of(fused, options).string()));
    return found;
}

constexpr const char* kNamesBesideModels[] = {
    "rigs.bin",      "rigs.txt",    "frames.bin",  "frames.txt", "points3D.ply",   "fused.ply",
    "fused.ply.vis", "database.db", "project.ini", kTransforms,  kTransformsTrain, kSparsePly};

void add_if_there(const fs::path& path, std::vector<fs::path>& files)
{
    if (is_file(path)) files.push_back(path);
}

void add_all_below(const fs::path& folder, std::vector<fs::path>& files)
{
    std::error_code error;
    constexpr auto kFollow = fs::directory_options::follow_directory_symlink;
    for (fs::recursive_directory_iterator entry(folder, kFollow, error), end;
         !error && entry != end; entry.increment(error)) {
        add_if_there(entry->path(), files);
    }
}

/// Adds COLMAP's files in the folder of a model or a workspace.
void add_of_folder(const fs::path& folder, std::vector<fs::path>& files)
{
    for (const char* const stem : kModelFiles) {
        add_if_there(folder / model_file(stem, ModelFormat::binary), files);
        add_if_there(folder / model_file(stem, ModelFormat::text), files);
    }
    for (const char* const name : kNamesBesideModels) {
        add_if_there(folder / name, files);
    }
    add_all_below(folder / "images", files);
    add_all_below(folder / "stereo", files);
}

void add_cloud(const fs::path& cloud, std::vector<fs::path>& files)
{
    files.push_back(cloud);
    add_if_there(cloud.string() + ".vis", files);
}

} // namespace

FoundInput find_input(const fs::path& input, const PointsOptions& options)
{
    if (is_ply_file(input)) {
        if (!options.points.empty()) {
            throw UsageError(fmt::format("--points {} selects the points of a model, but {} is a "
                                         "point cloud",
                                         options.points, input.string()));
        }
        if (is_scan(input, options)) return scan_input({}, input, options);
        if (!has_rays(input, options)) refuse_mesh(input);
        return dense_input(model_around(input), input, options);
    }
    if (const auto file = find_transforms(input)) return transforms_input(*file, options);
    const bool has_cloud = !options.points.empty() && options.points != "sparse";
    const bool needs_no_other = has_cloud || is_file(input / kFused);
    FoundModel model =
        find_model(input, needs_no_other ? PointsFile::another : PointsFile::of_model);
    if (options.points.empty()) return look_for_points(std::move(model), input, options);
    if (!has_cloud) return sparse_input(std::move(model), options);
    const fs::path cloud = options.points == "dense" ? input / kFused : fs::path(options.points);
    refuse_foreign_name(cloud);
    return dense_input(std::move(model), cloud, options);
}

std::vector<fs::path> input_files(const fs::path& input, const FoundInput& found)
{
    std::vector<fs::path> files;
    std::error_code error;
    fs::path folder =
        fs::weakly_canonical(fs::is_directory(input, error) ? input : input.parent_path(), error);
    add_of_folder(folder, files);
    // sparse/0 is two folders below the project
    folder = fs::weakly_canonical(found.model.folder, error);
    for (int i = 0; i < 3 && folder.has_filename(); ++i) {
        add_of_folder(folder, files);
        folder = folder.parent_path();
    }
    if (found.model.format == ModelFormat::transforms) files.push_back(found.model.folder);
    if (found.dense) {
        add_cloud(found.dense->cloud, files);
        if (!found.dense->visibility.empty()) files.push_back(found.dense->visibility);
    }
    if (found.scan) add_cloud(found.scan->cloud, files);
    return files;
}

bool is_image_of_views(const fs::path& file, const FoundInput& found)
{
    if (!has_image_name(file) || found.model.folder.empty()) return false;
    std::error_code error;
    const std::string path = fs::weakly_canonical(file, error).string();
    const auto views = read_colmap_views(found.model.folder, found.model.format).views;
    return std::ranges::any_of(views,
                               [&](const View& view) { return path.ends_with("/" + view.name); });
}

} // namespace vcarve
