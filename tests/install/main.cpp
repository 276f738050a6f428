#include "base/error.h"
#include "base/validate.h"
#include "base/version.h"
#include "io/colmap/find_model.h"
#include "io/ply/ply.h"
#include "pipeline/reconstruct.h"

#include <iostream>
#include <utility>

/// consumer MODEL OUT.ply: what the program does, through the library.
int main(int count, char** words)
{
    if (count != 3) return 2;
    try {
        const vcarve::FoundModel found = vcarve::find_model(words[1]);
        vcarve::Scene scene = vcarve::read_colmap_model(found.folder, found.format);
        vcarve::Options options;
        options.points.min_views = 2;
        vcarve::validate(options);
        vcarve::Log silent;
        const vcarve::TriMesh mesh = vcarve::reconstruct(std::move(scene), options, silent).mesh;
        vcarve::write_ply(words[2], mesh, {});
        std::cout << "vcarve " << vcarve::versions().program << ": " << mesh.faces.size()
                  << " faces\n";
    } catch (const vcarve::Error& error) {
        std::cerr << error.what() << '\n';
        return 1;
    }
}
