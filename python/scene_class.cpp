#include "scene_class.h"

#include "arrays.h"
#include "base/progress.h"
#include "base/stage_counts.h"
#include "io/dense/nearest_rays.h"
#include "io/dense/scanner_views.h"
#include "logged_run.h"
#include "model/lens.h"
#include "vcarve/error.h"
#include "vcarve/scene.h"

#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <numeric>

namespace vcarve::python {

namespace {

using Eigen::Vector3d;

/// A scene with arrays of this size, to be filled in.
std::shared_ptr<Scene> empty_scene(std::size_t points, std::size_t rays)
{
    auto scene = std::make_shared<Scene>();
    scene->positions.resize(points, Vector3d::Zero());
    scene->colors.resize(points, Color{});
    scene->errors_px.resize(points, -1.0);
    scene->point_ids.resize(points);
    std::iota(scene->point_ids.begin(), scene->point_ids.end(), std::uint64_t{1});
    scene->tracks.begins.resize(points + 1, 0);
    scene->tracks.views.resize(rays, 0);
    return scene;
}

int number_of_lens(const std::string& name)
{
    const LensModel* const model = lens_model(std::string_view(name));
    if (model == nullptr) throw UsageError(fmt::format("COLMAP has no camera model \"{}\"", name));
    return model->number;
}

/// Adds a camera. Returns the new number of cameras.
std::size_t add_camera(Scene& scene, const std::string& lens,
                       const std::array<std::uint64_t, 2>& size_px,
                       const std::vector<double>& params, bool measures_range)
{
    const int number = number_of_lens(lens);
    const std::size_t wanted = lens_model(number)->num_params;
    if (params.size() != wanted) {
        throw UsageError(fmt::format("the camera model {} has {} parameters, not {}", lens, wanted,
                                     params.size()));
    }
    scene.cameras.push_back({.id = static_cast<std::uint32_t>(scene.cameras.size() + 1),
                             .model = number,
                             .width_px = size_px[0],
                             .height_px = size_px[1],
                             .params = params,
                             .measures_range = measures_range});
    return scene.cameras.size();
}

/// The rotation of a pose. It must be exact to about the precision of float.
Eigen::Quaterniond rotation_of(const Eigen::Matrix3d& matrix, const std::string& view)
{
    constexpr double kRounding = 1e-4;
    const double off = (matrix * matrix.transpose() - Eigen::Matrix3d::Identity()).norm();
    if (!(off < kRounding) || !(matrix.determinant() > 0.0)) {
        throw UsageError(fmt::format("the pose of view {} has no valid rotation", view));
    }
    return Eigen::Quaterniond(matrix).normalized();
}

void add_view(Scene& scene, std::uint32_t camera, const std::string& name,
              const Eigen::Matrix3d& rotation, const Vector3d& center)
{
    if (!center.allFinite()) {
        throw UsageError(fmt::format("the center of view {} is not finite", name));
    }
    scene.views.push_back({.id = static_cast<std::uint32_t>(scene.views.size() + 1),
                           .camera = camera,
                           .name = name,
                           .cam_from_world = rotation_of(rotation, name),
                           .center = center});
}

/// Sets the tracks. The views of a row may have any order.
void set_tracks(Scene& scene, const py::object& begins, const py::object& views)
{
    const auto begin_of = rows_of<std::uint64_t>(begins, "track_begins");
    const auto all = rows_of<std::uint32_t>(views, "track_views");
    if (begin_of.size() != scene.num_points() + 1 || begin_of.front() != 0 ||
        begin_of.back() != all.size() || !std::ranges::is_sorted(begin_of)) {
        throw UsageError(fmt::format("the track_begins of {} points must be {} numbers in "
                                     "ascending order, from 0 to the number of track_views, {}",
                                     scene.num_points(), scene.num_points() + 1, all.size()));
    }
    Tracks tracks;
    tracks.begins.reserve(begin_of.size());
    tracks.views.reserve(all.size());
    std::vector<std::uint32_t> row;
    for (std::size_t i = 0; i + 1 < begin_of.size(); ++i) {
        row.assign(all.begin() + static_cast<std::ptrdiff_t>(begin_of[i]),
                   all.begin() + static_cast<std::ptrdiff_t>(begin_of[i + 1]));
        std::ranges::sort(row);
        row.erase(std::unique(row.begin(), row.end()), row.end());
        if (!row.empty() && row.back() >= scene.views.size()) {
            throw UsageError(fmt::format("the track of point {} has view {}, but there are {} "
                                         "views, counted from 0",
                                         i, row.back(), scene.views.size()));
        }
        tracks.push_back(row);
    }
    scene.tracks = std::move(tracks);
}

void take_nearest_views(Scene& scene, const py::object& listener)
{
    Tracks tracks;
    run_told(listener, [&](Log& log) {
        Stage stage(log, "rays");
        tracks = nearest_rays(scene, stage);
        stage.end({{counts::kCells.rays, size_of(tracks.views.size())}});
    });
    scene.tracks = std::move(tracks);
}

void place_scanners(Scene& scene, const py::object& places)
{
    const auto scanners = rows_of<Vector3d>(places, "scanners");
    if (scanners.size() != 1 && scanners.size() != scene.num_points()) {
        throw UsageError(fmt::format("found {} scanner positions, but expected one, or one for "
                                     "each of {} points",
                                     scanners.size(), scene.num_points()));
    }
    scene.tracks = {};
    add_scanner_views(scanners, scene);
}

void set_normals(Scene& scene, const py::object& normals)
{
    scene.normals = rows_of<Eigen::Vector3f>(normals, "normals");
}

py::array_t<double> centers(const Scene& scene)
{
    py::array_t<double> places({static_cast<py::ssize_t>(scene.views.size()), py::ssize_t{3}});
    auto rows = places.mutable_unchecked<2>();
    for (std::size_t i = 0; i < scene.views.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            rows(static_cast<py::ssize_t>(i), axis) = scene.views[i].center[axis];
        }
    }
    return places;
}

std::vector<std::string> names(const Scene& scene)
{
    std::vector<std::string> all;
    std::ranges::transform(scene.views, std::back_inserter(all), &View::name);
    return all;
}

auto arrays_of(Scene& scene)
{
    return std::tie(scene.positions, scene.colors, scene.errors_px, scene.point_ids, scene.normals,
                    scene.kinds, scene.tracks.begins, scene.tracks.views);
}

auto fields_of(Camera& camera)
{
    return std::tie(camera.id, camera.model, camera.width_px, camera.height_px, camera.params,
                    camera.measures_range);
}

auto fields_of(View& view)
{
    return std::tie(view.id, view.camera, view.name, view.cam_from_world.coeffs(), view.center);
}

using CameraValues =
    std::tuple<std::uint32_t, int, std::uint64_t, std::uint64_t, std::vector<double>, bool>;
using ViewValues = std::tuple<std::uint32_t, std::uint32_t, std::string, Eigen::Vector4d, Vector3d>;

py::tuple state_of(const std::shared_ptr<Scene>& scene)
{
    std::vector<CameraValues> cameras;
    for (Camera& camera : scene->cameras) {
        cameras.emplace_back(fields_of(camera));
    }
    std::vector<ViewValues> views;
    for (View& view : scene->views) {
        views.emplace_back(fields_of(view));
    }
    return py::make_tuple(tuple_of_arrays(arrays_of(*scene), scene), cameras, views,
                          std::pair(scene->is_dense, scene->offset));
}

std::shared_ptr<Scene> unpickled(const py::tuple& state)
{
    auto scene = std::make_shared<Scene>();
    set_arrays(arrays_of(*scene), state[0]);
    for (const auto& values : py::cast<std::vector<CameraValues>>(state[1])) {
        fields_of(scene->cameras.emplace_back()) = values;
    }
    for (const auto& values : py::cast<std::vector<ViewValues>>(state[2])) {
        fields_of(scene->views.emplace_back()) = values;
    }
    std::tie(scene->is_dense, scene->offset) = py::cast<std::pair<bool, Vector3d>>(state[3]);
    return scene;
}

/// A method that replaces arrays. It fails if NumPy arrays refer to them.
template <typename... Arguments>
auto replacing(void (*method)(Scene&, Arguments...))
{
    return [method](const std::shared_ptr<Scene>& scene, Arguments... given) {
        require_unseen(scene);
        method(*scene, given...);
    };
}

/// A property that returns a NumPy array at the address of the scene's array.
template <typename Entry>
auto array_of(std::vector<Entry> Scene::*field)
{
    return [field](const std::shared_ptr<Scene>& scene) { return view_of((*scene).*field, scene); };
}

} // namespace

void require_shape(const py::array& given, const std::string& name, py::ssize_t columns)
{
    const bool fits =
        columns == 0 ? given.ndim() == 1 : given.ndim() == 2 && given.shape(1) == columns;
    if (fits) return;
    std::string shape;
    for (py::ssize_t i = 0; i < given.ndim(); ++i) {
        shape += fmt::format("{}{}", i == 0 ? "" : ", ", given.shape(i));
    }
    throw UsageError(fmt::format("{} must be an array of shape (n{}), not ({})", name,
                                 columns == 0 ? "" : fmt::format(", {}", columns), shape));
}

void add_scene_class(py::module_& module)
{
    using Shared = std::shared_ptr<Scene>;
    const auto begins = [](const Shared& scene) { return view_of(scene->tracks.begins, scene); };
    const auto views = [](const Shared& scene) { return view_of(scene->tracks.views, scene); };
    py::class_<Scene, Shared>(module, "Scene")
        .def_static("empty", &empty_scene, py::arg("points"), py::arg("rays") = 0)
        .def_property_readonly("positions", array_of(&Scene::positions))
        .def_property_readonly("colors", array_of(&Scene::colors))
        .def_property_readonly("errors_px", array_of(&Scene::errors_px))
        .def_property_readonly("point_ids", array_of(&Scene::point_ids))
        .def_property_readonly("normals", array_of(&Scene::normals))
        .def_property_readonly("track_begins", begins)
        .def_property_readonly("track_views", views)
        .def_property_readonly("centers", &centers)
        .def_property_readonly("names", &names)
        .def_readwrite("is_dense", &Scene::is_dense)
        .def(py::pickle(&state_of, &unpickled))
        .def("add_camera", &add_camera)
        .def("add_view", &add_view)
        .def("set_tracks", replacing(&set_tracks))
        .def("set_normals", replacing(&set_normals))
        .def("place_scanners", replacing(&place_scanners))
        .def("take_nearest_views", replacing(&take_nearest_views));
}

} // namespace vcarve::python
