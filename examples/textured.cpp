// example_textured MODEL OUT.glb: dense points and a texture, from the photographs in the folder
// `images` beside the model.
#include <vcarve/vcarve.h>

#include <iostream>

int main(int count, char** words)
{
    if (count != 3) return 2;
    try {
        vcarve::Options options;
        options.dense = {.dense = true, .size_px = 320};
        options.texture.texture = true;
        vcarve::Log silent;
        const auto made = vcarve::reconstruct(words[1], {}, options, silent);
        vcarve::write_mesh(words[2], made.mesh,
                           {.comments = made.comments, .texture = &made.texture, .up = made.up});
    } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
        return 1;
    }
}
