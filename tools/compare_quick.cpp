// compare_quick MODEL A.ply [B.ply ...] [--truth gt.ply] [--json out.json] [--centers cams.txt]
// Measures meshes until `colmap-vcarve compare` exists. Not installed.
#include "base/error.h"
#include "compare/report.h"
#include "io/colmap_model.h"
#include "io/find_model.h"
#include "io/ply.h"

#include <chrono>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

namespace {

double seconds()
{
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration<double>(now).count();
}

vcarve::NamedMesh named_mesh(const std::filesystem::path& path)
{
    return {path.filename().string(), vcarve::read_ply(path)};
}

/// Lines "name x y z": the centres of the images of those names.
void replace_views(vcarve::Scene& scene, const std::string& path)
{
    std::ifstream file(path);
    scene.views.clear();
    scene.tracks.views.assign(scene.tracks.views.size(), 0);
    vcarve::View view;
    while (file >> view.name >> view.center.x() >> view.center.y() >> view.center.z()) {
        scene.views.push_back(view);
    }
}

int run(const std::vector<std::string>& words)
{
    std::vector<std::string> meshes;
    std::string truth_path;
    std::string json_path;
    std::string centers_path;
    for (std::size_t i = 1; i < words.size(); ++i) {
        if (words[i] == "--truth")
            truth_path = words[++i];
        else if (words[i] == "--json")
            json_path = words[++i];
        else if (words[i] == "--centers")
            centers_path = words[++i];
        else
            meshes.push_back(words[i]);
    }
    const vcarve::FoundModel found = vcarve::find_model(words[0]);
    vcarve::Scene scene = vcarve::read_colmap_model(found.folder, found.format);
    if (!centers_path.empty()) replace_views(scene, centers_path);
    vcarve::NamedMesh truth;
    if (!truth_path.empty()) truth = named_mesh(truth_path);
    double start = seconds();
    const vcarve::Yardstick yardstick =
        vcarve::make_yardstick(scene, truth_path.empty() ? nullptr : &truth, {});
    std::fprintf(stderr, "yardstick %.2f s\n", seconds() - start);
    std::vector<vcarve::Comparison> comparisons;
    for (const std::string& path : meshes) {
        const vcarve::NamedMesh mesh = named_mesh(path);
        start = seconds();
        comparisons.push_back(vcarve::compare_mesh(mesh, yardstick));
        std::fprintf(stderr, "%s %.2f s\n", path.c_str(), seconds() - start);
    }
    std::fputs(vcarve::comparison_table(comparisons, yardstick).c_str(), stdout);
    if (!json_path.empty())
        std::ofstream(json_path) << vcarve::comparison_json(comparisons, yardstick);
    return 0;
}

} // namespace

int main(int argc, char** argv)
{
    if (argc < 3) {
        std::fputs("compare_quick MODEL A.ply [B.ply ...] [--truth gt.ply] [--json out.json]\n",
                   stderr);
        return 2;
    }
    try {
        return run(std::vector<std::string>(argv + 1, argv + argc));
    } catch (const vcarve::InputError& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 3;
    }
}
