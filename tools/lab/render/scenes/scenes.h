#pragma once

#include "render/photo_scene.h"

namespace vcarve::render {

inline Eigen::Quaterniond turned(double angle_rad, const Eigen::Vector3d& axis)
{
    return Eigen::Quaterniond(Eigen::AngleAxisd(angle_rad, axis.normalized()));
}

PhotoScene fixture_scene(); ///< fixtures/scene: the still life from two rows before it
PhotoScene panels();        ///< thin boards that stand free, some with windows
PhotoScene clutter();       ///< a heap on a table, seen all round
PhotoScene facade();        ///< the front of a house, seen from the street
PhotoScene organic();       ///< a bumpy ball and a knot, seen all round
PhotoScene low_texture();   ///< half of the parts are nearly even in colour
PhotoScene noisy();         ///< pictures with strong noise and some blur
PhotoScene few_views();     ///< the still life from eight places
PhotoScene room();          ///< an interior, seen from within
PhotoScene city();          ///< houses with plain walls, seen from the air
PhotoScene hall();          ///< a high hall without a ceiling, in grainy pictures from within
PhotoScene cubicles();      ///< thin partitions, in part plain, with desks and chairs
PhotoScene smooth();        ///< a round figure and a vase with little texture, seen all round

} // namespace vcarve::render
