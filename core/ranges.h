// Numbers that the language, options, settings, files and messages have in common: each is written here only.
//
// Thread safety: constant.
#ifndef GLINT_CORE_RANGES_H
#define GLINT_CORE_RANGES_H

#define RANGE_SIDE_MOST    16384      // pixels of a picture's width or height
#define RANGE_SAMPLES_MOST 4096       // rays through a pixel
#define RANGE_PIXELS_MOST  67108864   // of a picture, or of a part of one, that is held in memory as a whole
#define RANGE_CORNER_MOST  16777215   // number of a vertex of a mesh in the scene's file
#define RANGE_FRAMES_MOST  100000     // of an animation
#define RANGE_COPIES_MOST  1000000000 // values of one variable of copies
#define RANGE_RATE_LEAST   0.001      // frames per second
#define RANGE_RATE_MOST    1000
#define RANGE_BROKEN_MOST  1e9 // how many not-a-number pixels a bound may allow

// A number as text, for a message: RANGE_TEXT(RANGE_SIDE_MOST) is "16384".
#define RANGE_TEXT(number)    RANGE_TEXT_OF(number)
#define RANGE_TEXT_OF(digits) #digits

#endif
