// The planted errors of the data: each is a defect that a property must catch.
#pragma once

namespace quadrel::test {

enum class Planted {
    none,
    seam,           ///< a ramp added across the tile: its left and right sides differ
    eight_bits,     ///< heights rounded to c / 255 and then scaled by 0.999
    faces_swapped,  ///< two faces of the sky exchanged
    face_turned,    ///< one face of the sky mirrored
    dark_colour,    ///< colours stored as sRGB codes instead of linear light
};

}  // namespace quadrel::test
