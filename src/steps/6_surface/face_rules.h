#pragma once

#include "mesh/vertex_faces.h"
#include "region/region.h"
#include "steps/6_surface/face_evidence.h"
#include "steps/6_surface/removals.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <cstdint>

namespace vcarve {

// The rule book: which faces of the boundary between inside and outside are surface.
//
// The cut closes whatever it is given. So the boundary has faces that no view could have seen,
// behind walls and under floors, and faces that views do see though nothing is there: they close
// what was looked at where no points were found, as a lid over a hall without a ceiling, skirts
// around the ground, sheets between far things. The first row that applies to a face decides;
// `FaceRules` has the thresholds, FaceEvidence says what is asked.
//
//   | what is known of a face                                              | verdict |
//   |----------------------------------------------------------------------|-----------------------|
//   | a corner lies outside the region that is wanted                      | dropped | | no view
//   sees it                                                      | dropped, unless small | | | and
//   beside a kept one | | were it away, a view would look onto the back of a kept face         |
//   kept                  | | the surface ends at it, and it is hardly seen | dropped | | it is
//   long, and hardly seen                                          | dropped               | | it
//   is long, turns off the surface around, and is not even half seen  | dropped               | |
//   it is twice as long, turns off, and the surface ends at it           | dropped               |
//   | it is half as long, and seen in part                                 | trimmed (trim.h) | |
//   else                                                                 | kept                  |
//
// Small unseen faces beside kept ones stay so that a surface that bends out of sight ends behind
// its bend, not in view, and gaps a face or two wide close. What a face hides comes before what it
// is: nothing may come to light that is plainly wrong.

/// Which faces a view sees: each corner was seen from the front by some view of its point, or some
/// view sees a part of the face, more than by a graze. Nothing that a view sees is dropped for lack
/// of points. Cost: O(faces + sights), and walks (FaceVisibility::is_seen) for the faces that the
/// sights of their corners do not speak for; in parallel.
FaceFlags seen_faces(const Boundary& boundary);

/// From which length of its longest edge on a face is long: `max_closing` times the diameter of the
/// region of interest. Cost: as region_of_interest().
double closing_length(const Scene& scene, const FaceRules& rules);

/// Takes the flags off faces that close what was looked at without support, round by round, since
/// what is dropped makes ends of the surface and lets views see farther: the rows in the middle of
/// the table. None where `max_closing` is 0. Returns how many there are. Cost: O(faces), and some
/// walks a view for each long face and each at an end of the surface; mostly in parallel.
std::int64_t drop_unsupported(const Boundary& boundary, const FaceRules& rules, FaceFlags& keep);

/// The faces that are kept before large ones are trimmed.
struct ChosenFaces {
    FaceFlags keep;
    FaceFlags seen;                 ///< kept or not
    std::int64_t unseen = 0;        ///< how many were dropped for not being seen
    std::int64_t closing = 0;       ///< for closing something without support
    std::int64_t out_of_region = 0; ///< for having a corner there
};

/// Goes through all faces by the rules above. `region` is null for all of space. Where the surface
/// is to be closed, only what lies outside the region is dropped. Cost: that of seen_faces() and
/// drop_unsupported().
ChosenFaces choose_faces(const Boundary& boundary, const Region* region,
                         const SurfaceOptions& options, Removals& removals);

/// The faces with a flag; vertices stay.
TriMesh with_faces(TriMesh mesh, const FaceFlags& keep);

} // namespace vcarve
