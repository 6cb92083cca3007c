#ifndef OBSCURA_SRC_LIGHTING_LIGHT_IO_H_
#define OBSCURA_SRC_LIGHTING_LIGHT_IO_H_

#include "gpu/io.h"

IO_BEGIN(light_io)
IO_THREADS(8, 8);
IO_CONSTANT(0, int, kTechnique, 2);  // LightingTechnique
IO_CONSTANT(1, bool, kGeometricTerm, false);
IO_CONSTANT(2, bool, kPaper, false);           // normalisation
IO_CONSTANT(3, bool, kUniformWeights, false);  // of the visibility
IO_CONSTANT(4, bool, kUnsigned, false);        // Directions
IO_CONSTANT(5, bool, kAlbedo, false);
IO_CONSTANT(6, int, kCells, 32);
IO_IMAGE(0, VisibilityImage, visibility_image);
IO_IMAGE(1, NormalImage, normal_image);  // of the whole size, guard band included
IO_IMAGE(2, DirectionImage, direction_image);
IO_IMAGE(3, AlbedoImage, albedo_image);
IO_READS(4, Table, vec4, light_table);  // eight per vertex
IO_LIGHT(5);
// Rows of the rotation from eye to world space; the sun in eye space, irradiance / pi.
IO_PUSH(float xx; float xy; float xz; float yx; float yy; float yz; float zx; float zy; float zz;
        float sun_x; float sun_y; float sun_z; float sun_red; float sun_green; float sun_blue;
        float sun_radius;);
IO_END

#endif  // OBSCURA_SRC_LIGHTING_LIGHT_IO_H_
