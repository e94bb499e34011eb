// A font of our own, for labels: letters, figures and signs of one pen with round ends.
//
// Heights: capitals 700, small letters 505, those that rise 735, those that hang -200. The pen's middle is 45
// inside of them, and round letters are 8 higher and lower.
#include "tools/meshgen/generators.h"
#include "tools/meshgen/stroke.h"
#include "tools/meshgen/truetype.h"

#include <stdlib.h>

enum {
    FIGURE = 560, // width of each figure, so that columns of them line up
    STRAIGHT = 72,
    ROUND = 50,
    OPEN = 38,
    SLANTED = 22,
};

struct letter {
    int code;
    int before, after; // space on both sides; of a figure both are 0
    const char *strokes;
};

// By code.
static const struct letter LETTERS[] = {
    {'!', 90, 90, "M 0 655 L 0 245 M 0 58"},
    {'%', 45, 45,
     "M 0 525 v 105 663 h 210 525 v 105 387 h 0 525 z M 425 175 v 530 313 h 635 175 v 530 37 h 425 175 z "
     "M 530 655 L 105 45"},
    {'&', 45, 30,
     "M 470 45 L 120 440 C 85 480 75 515 75 550 C 75 620 125 663 190 663 C 255 663 302 622 302 560 "
     "C 302 480 235 440 165 400 C 70 345 0 290 0 190 C 0 95 75 37 180 37 C 320 37 415 140 430 310"},
    {'\'', 70, 70, "M 0 655 L 0 520"},
    {'(', 55, 30, "M 120 765 C 40 650 0 500 0 330 C 0 160 40 10 120 -105"},
    {')', 30, 55, "M 0 765 C 80 650 120 500 120 330 C 120 160 80 10 0 -105"},
    {'+', 60, 60, "M 0 330 L 370 330 M 185 515 L 185 145"},
    {',', 55, 70, "M 35 60 L 0 -75"},
    {'-', 55, 55, "M 0 270 L 205 270"},
    {'.', 65, 65, "M 0 58"},
    {'/', 20, 20, "M 0 -20 L 255 720"},
    {'0', 0, 0, "M 0 350 v 200 663 h 400 350 v 200 37 h 0 350 z"},
    {'1', 0, 0, "M 0 520 L 165 655 L 165 45"},
    {'2', 0, 0,
     "M 0 515 C 20 610 95 663 190 663 C 300 663 375 600 375 500 C 375 435 340 385 290 335 L 0 45 L 395 45"},
    {'3', 0, 0,
     "M 12 555 C 50 628 110 663 185 663 C 290 663 365 600 365 515 C 365 420 295 365 200 365 L 135 365 "
     "|M 200 365 C 315 365 392 300 392 200 C 392 100 310 37 195 37 C 105 37 38 78 0 150"},
    {'4', 0, 0, "M 300 45 L 300 655 L 0 190 L 420 190"},
    {'5', 0, 0,
     "M 350 655 L 62 655 L 32 365 C 75 405 130 423 190 423 C 310 423 392 345 392 230 C 392 112 310 37 190 37 "
     "C 105 37 38 75 0 145"},
    {'6', 0, 0, "M 0 232 v 200 430 h 400 232 v 200 37 h 0 232 z |M 0 240 C 0 460 110 630 295 658"},
    {'7', 0, 0, "M 0 655 L 390 655 L 140 45"},
    {'8', 0, 0,
     "M 30 508 v 200 663 h 370 508 v 200 353 h 30 508 z M 0 195 v 200 353 h 400 195 v 200 37 h 0 195 z"},
    {'9', 0, 0, "M 0 468 v 200 663 h 400 468 v 200 270 h 0 468 z |M 400 460 C 400 240 290 70 105 42"},
    {':', 75, 75, "M 0 58 M 0 400"},
    {'=', 60, 60, "M 0 425 L 370 425 M 0 235 L 370 235"},
    {'?', 45, 45,
     "M 0 540 C 20 618 85 663 165 663 C 265 663 330 605 330 525 C 330 400 165 405 165 245 M 165 58"},
    {'A', SLANTED, SLANTED, "M 0 45 L 255 655 L 510 45 |M 77 230 L 433 230|"},
    {'B', STRAIGHT, ROUND,
     "M 0 45 L 0 355 L 225 355 h 405 200 v 225 45 z |M 0 340 L 0 655 L 215 655 h 370 505 v 215 355 L 100 "
     "355|"},
    {'C', ROUND, OPEN, "M 455 565 C 405 628 335 663 260 663 h 0 350 v 260 37 C 335 37 405 72 455 135"},
    {'D', STRAIGHT, ROUND, "M 0 45 L 0 655 L 180 655 h 450 350 v 180 45 z"},
    {'E', STRAIGHT, OPEN, "M 360 655 L 0 655 L 0 45 L 360 45 |M 0 358 L 325 358"},
    {'F', STRAIGHT, OPEN, "M 350 655 L 0 655 L 0 45 |M 0 345 L 315 345"},
    {'G', ROUND, ROUND,
     "M 458 570 C 405 632 340 663 262 663 h 0 350 v 262 37 C 345 37 420 65 470 112 L 470 330 L 300 330"},
    {'H', STRAIGHT, STRAIGHT, "M 0 45 L 0 655 M 430 45 L 430 655 |M 0 352 L 430 352|"},
    {'I', STRAIGHT, STRAIGHT, "M 0 45 L 0 655"},
    {'J', OPEN, STRAIGHT, "M 275 655 L 275 215 v 130 37 C 70 37 25 75 0 130"},
    {'K', STRAIGHT, SLANTED, "M 0 45 L 0 655 M 395 655 L 0 255| |M 150 407 L 415 45"},
    {'L', STRAIGHT, OPEN, "M 0 655 L 0 45 L 345 45"},
    {'M', STRAIGHT, STRAIGHT, "M 0 45 L 0 655 L 265 225 L 530 655 L 530 45"},
    {'N', STRAIGHT, STRAIGHT, "M 0 45 L 0 655 L 440 45 L 440 655"},
    {'O', ROUND, ROUND, "M 0 350 v 265 663 h 530 350 v 265 37 h 0 350 z"},
    {'P', STRAIGHT, ROUND, "M 0 45 L 0 655 L 225 655 h 400 478 v 225 300 L 0 300|"},
    {'Q', ROUND, OPEN, "M 0 350 v 265 663 h 530 350 v 265 37 h 0 350 z M 355 190 L 530 5"},
    {'R', STRAIGHT, OPEN, "M 0 45 L 0 655 L 225 655 h 400 484 v 225 312 L 0 312| |M 225 312 L 405 45"},
    {'S', OPEN, OPEN,
     "M 395 560 C 355 630 290 663 210 663 C 100 663 20 605 20 510 C 20 400 120 380 210 357 C 310 332 412 305 "
     "412 190 "
     "C 412 95 325 37 212 37 C 125 37 42 75 0 148"},
    {'T', OPEN, OPEN, "M 0 655 L 450 655 |M 225 655 L 225 45"},
    {'U', STRAIGHT, STRAIGHT, "M 0 655 L 0 245 v 215 37 h 430 245 L 430 655"},
    {'V', SLANTED, SLANTED, "M 0 655 L 250 45 L 500 655"},
    {'W', SLANTED, SLANTED, "M 0 655 L 185 45 L 375 610 L 565 45 L 750 655"},
    {'X', SLANTED, SLANTED, "M 0 655 L 440 45 M 440 655 L 0 45"},
    {'Y', SLANTED, SLANTED, "M 0 655 L 230 320 L 460 655 |M 230 330 L 230 45"},
    {'Z', OPEN, OPEN, "M 0 655 L 415 655 L 0 45 L 425 45"},
    {'a', ROUND, 68, "M 0 252 v 195 468 h 375 252 v 195 37 h 0 252 z M 375 460 L 375 45"},
    {'b', 68, ROUND, "M 0 690 L 0 45 M 0 252 v 180 468 h 375 252 v 180 37 h 0 252 z"},
    {'c', ROUND, OPEN, "M 340 390 C 305 440 255 468 192 468 h 0 252 v 192 37 C 255 37 305 65 340 115"},
    {'d', ROUND, 68, "M 375 690 L 375 45 M 0 252 v 195 468 h 375 252 v 195 37 h 0 252 z"},
    {'e', ROUND, OPEN, "|M 5 252 L 375 252 v 192 468 h 0 252 v 192 37 C 260 37 315 62 352 108"},
    {'f', OPEN, OPEN, "M 255 680 C 150 710 90 660 90 560 L 90 45 M 0 460 L 225 460"},
    {'g', ROUND, 68,
     "M 0 252 v 195 468 h 375 252 v 195 37 h 0 252 z M 375 460 L 375 20 v 185 -155 C 120 -155 65 -135 25 "
     "-100"},
    {'h', 68, 68, "M 0 690 L 0 45 |M 8 270 v 185 468 h 345 285 L 345 45"},
    {'i', 60, 60, "M 0 460 L 0 45 M 0 645"},
    {'j', 10, 60, "M 85 460 L 85 -20 v -15 -150 M 85 645"},
    {'k', 68, SLANTED, "M 0 690 L 0 45 M 315 460 L 0 190| |M 115 289 L 335 45"},
    {'l', 68, OPEN, "M 0 690 L 0 150 v 105 45"},
    {'m', 68, 68,
     "M 0 460 L 0 45 |M 8 280 v 165 468 h 300 310 L 300 45 |M 308 280 v 465 468 h 600 310 L 600 45"},
    {'n', 68, 68, "M 0 460 L 0 45 |M 8 270 v 185 468 h 345 285 L 345 45"},
    {'o', ROUND, ROUND, "M 0 252 v 195 468 h 390 252 v 195 37 h 0 252 z"},
    {'p', 68, ROUND, "M 0 460 L 0 -155 M 0 252 v 180 468 h 375 252 v 180 37 h 0 252 z"},
    {'q', ROUND, 68, "M 375 460 L 375 -155 M 0 252 v 195 468 h 375 252 v 195 37 h 0 252 z"},
    {'r', 68, SLANTED, "M 0 460 L 0 45 |M 8 250 v 170 466 C 195 466 215 463 235 456"},
    {'s', OPEN, OPEN,
     "M 305 400 C 275 445 225 468 165 468 C 80 468 15 432 15 362 C 15 285 90 268 165 252 C 245 234 325 215 "
     "325 140 "
     "C 325 70 260 37 170 37 C 100 37 38 63 0 118"},
    {'t', OPEN, OPEN, "M 100 600 L 100 160 C 100 70 150 25 245 50 M 0 460 L 240 460"},
    {'u', 68, 68, "M 345 460 L 345 45 M 0 460 L 0 220 v 160 37 h 337 235|"},
    {'v', SLANTED, SLANTED, "M 0 460 L 187 45 L 375 460"},
    {'w', SLANTED, SLANTED, "M 0 460 L 145 45 L 290 430 L 435 45 L 580 460"},
    {'x', SLANTED, SLANTED, "M 0 460 L 335 45 M 335 460 L 0 45"},
    {'y', SLANTED, SLANTED, "M 0 460 L 195 45| M 390 460 L 99 -155"},
    {'z', OPEN, OPEN, "M 0 460 L 320 460 L 0 45 L 330 45"},
    {0xB0, 50, 50, "M 0 588 v 75 663 h 150 588 v 75 513 h 0 588 z"},
};

enum {
    LETTER_COUNT = sizeof LETTERS / sizeof LETTERS[0]
};

bool font_generate(struct strbuf *bytes) {
    static const struct truetype_names names = {"Glint Round", "Regular", "GlintRound-Regular"};
    struct truetype_letter *letters = calloc(LETTER_COUNT + 2, sizeof *letters);
    if (!letters)
        return false;
    letters[0].advance = FIGURE; // what the font lacks
    stroke_glyph("M 0 45 L 0 655 L 330 655 L 330 45 z", &letters[0].glyph);
    glyph_move(&letters[0].glyph, (FIGURE - 330) / 2);
    letters[1] = (struct truetype_letter){.code = ' ', .advance = 260};
    for (int i = 0; i < LETTER_COUNT; i++) {
        const struct letter *from = &LETTERS[i];
        struct truetype_letter *to = &letters[i + 2];
        to->code = from->code;
        stroke_glyph(from->strokes, &to->glyph);
        const int width = to->glyph.right - to->glyph.left;
        const int before = from->before > 0 ? from->before : (FIGURE - width) / 2;
        to->advance = from->before > 0 ? before + width + from->after : FIGURE;
        glyph_move(&to->glyph, before - to->glyph.left);
    }
    truetype_write(letters, LETTER_COUNT + 2, &names, bytes);
    free(letters);
    return !bytes->failed;
}
