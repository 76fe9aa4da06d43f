/* The font: 5x7 letters in cells of 6x8, drawn in this file.
 *
 * SPDX-License-Identifier: MIT
 */
#include "overlay/items.h"

/* A row of a glyph is written as it looks: l, then five pixels. The leftmost has the value 16. */
/* clang-format off */
enum {
    l_____ = 0, l____X, l___X_, l___XX, l__X__, l__X_X, l__XX_, l__XXX,
    l_X___, l_X__X, l_X_X_, l_X_XX, l_XX__, l_XX_X, l_XXX_, l_XXXX,
    lX____, lX___X, lX__X_, lX__XX, lX_X__, lX_X_X, lX_XX_, lX_XXX,
    lXX___, lXX__X, lXX_X_, lXX_XX, lXXX__, lXXX_X, lXXXX_, lXXXXX
};
/* clang-format on */

#define ACROSS 11u /* glyphs side by side in this file */
#define ROWS ZS_GLYPH_H

/* [block][row][glyph] */
/* clang-format off */
static const uint8_t glyphs[][ROWS][ACROSS] = {
    /*    !  "  #  $  %  &  '  (  )  * */
    {
        { l_____, l__X__, l_X_X_, l_X_X_, l__X__, lXX__X, l_XX__, l__X__, l___X_, l_X___, l_____ },
        { l_____, l__X__, l_X_X_, l_X_X_, l_XXXX, lXX__X, lX__X_, l__X__, l__X__, l__X__, l__X__ },
        { l_____, l__X__, l_X_X_, lXXXXX, lX_X__, l___X_, lX_X__, l_X___, l_X___, l___X_, lX_X_X },
        { l_____, l__X__, l_____, l_X_X_, l_XXX_, l__X__, l_X___, l_____, l_X___, l___X_, l_XXX_ },
        { l_____, l__X__, l_____, lXXXXX, l__X_X, l_X___, lX_X_X, l_____, l_X___, l___X_, lX_X_X },
        { l_____, l_____, l_____, l_X_X_, lXXXX_, lX__XX, lX__X_, l_____, l__X__, l__X__, l__X__ },
        { l_____, l__X__, l_____, l_X_X_, l__X__, lX__XX, l_XX_X, l_____, l___X_, l_X___, l_____ },
        { l_____, l_____, l_____, l_____, l_____, l_____, l_____, l_____, l_____, l_____, l_____ },
    },
    /* +  ,  -  .  /  0  1  2  3  4  5 */
    {
        { l_____, l_____, l_____, l_____, l____X, l_XXX_, l__X__, l_XXX_, lXXXXX, l___X_, lXXXXX },
        { l__X__, l_____, l_____, l_____, l____X, lX___X, l_XX__, lX___X, l___X_, l__XX_, lX____ },
        { l__X__, l_____, l_____, l_____, l___X_, lX__XX, lX_X__, l____X, l__X__, l_X_X_, lXXXX_ },
        { lXXXXX, l_____, lXXXXX, l_____, l__X__, lX_X_X, l__X__, l__XX_, l___X_, lX__X_, l____X },
        { l__X__, l_____, l_____, l_____, l_X___, lXX__X, l__X__, l_X___, l____X, lXXXXX, l____X },
        { l__X__, l__XX_, l_____, l__XX_, lX____, lX___X, l__X__, lX____, lX___X, l___X_, lX___X },
        { l_____, l___X_, l_____, l__XX_, lX____, l_XXX_, lXXXXX, lXXXXX, l_XXX_, l___X_, l_XXX_ },
        { l_____, l__X__, l_____, l_____, l_____, l_____, l_____, l_____, l_____, l_____, l_____ },
    },
    /* 6  7  8  9  :  ;  <  =  >  ?  @ */
    {
        { l__XX_, lXXXXX, l_XXX_, l_XXX_, l_____, l_____, l___X_, l_____, l_X___, l_XXX_, l_XXX_ },
        { l_X___, l____X, lX___X, lX___X, l__XX_, l__XX_, l__X__, l_____, l__X__, lX___X, lX___X },
        { lX____, l___X_, lX___X, lX___X, l__XX_, l__XX_, l_X___, lXXXXX, l___X_, l____X, lX_XXX },
        { lXXXX_, l___X_, l_XXX_, l_XXXX, l_____, l_____, lX____, l_____, l____X, l__XX_, lX_X_X },
        { lX___X, l__X__, lX___X, l____X, l__XX_, l__XX_, l_X___, lXXXXX, l___X_, l__X__, lX_XX_ },
        { lX___X, l__X__, lX___X, l___X_, l__XX_, l___X_, l__X__, l_____, l__X__, l_____, lX____ },
        { l_XXX_, l__X__, l_XXX_, l_XX__, l_____, l__X__, l___X_, l_____, l_X___, l__X__, l_XXXX },
        { l_____, l_____, l_____, l_____, l_____, l_____, l_____, l_____, l_____, l_____, l_____ },
    },
    /* A  B  C  D  E  F  G  H  I  J  K */
    {
        { l_XXX_, lXXXX_, l_XXX_, lXXX__, lXXXXX, lXXXXX, l_XXX_, lX___X, l_XXX_, l__XXX, lX___X },
        { lX___X, lX___X, lX___X, lX__X_, lX____, lX____, lX___X, lX___X, l__X__, l___X_, lX__X_ },
        { lX___X, lX___X, lX____, lX___X, lX____, lX____, lX____, lX___X, l__X__, l___X_, lX_X__ },
        { lX___X, lXXXX_, lX____, lX___X, lXXXX_, lXXXX_, lX__XX, lXXXXX, l__X__, l___X_, lXX___ },
        { lXXXXX, lX___X, lX____, lX___X, lX____, lX____, lX___X, lX___X, l__X__, l___X_, lX_X__ },
        { lX___X, lX___X, lX___X, lX__X_, lX____, lX____, lX___X, lX___X, l__X__, lX__X_, lX__X_ },
        { lX___X, lXXXX_, l_XXX_, lXXX__, lXXXXX, lX____, l_XXXX, lX___X, l_XXX_, l_XX__, lX___X },
        { l_____, l_____, l_____, l_____, l_____, l_____, l_____, l_____, l_____, l_____, l_____ },
    },
    /* L  M  N  O  P  Q  R  S  T  U  V */
    {
        { lX____, lX___X, lX___X, l_XXX_, lXXXX_, l_XXX_, lXXXX_, l_XXXX, lXXXXX, lX___X, lX___X },
        { lX____, lXX_XX, lXX__X, lX___X, lX___X, lX___X, lX___X, lX____, l__X__, lX___X, lX___X },
        { lX____, lX_X_X, lXX__X, lX___X, lX___X, lX___X, lX___X, lX____, l__X__, lX___X, lX___X },
        { lX____, lX_X_X, lX_X_X, lX___X, lXXXX_, lX___X, lXXXX_, l_XXX_, l__X__, lX___X, lX___X },
        { lX____, lX___X, lX__XX, lX___X, lX____, lX_X_X, lX_X__, l____X, l__X__, lX___X, l_X_X_ },
        { lX____, lX___X, lX__XX, lX___X, lX____, lX__X_, lX__X_, l____X, l__X__, lX___X, l_X_X_ },
        { lXXXXX, lX___X, lX___X, l_XXX_, lX____, l_XX_X, lX___X, lXXXX_, l__X__, l_XXX_, l__X__ },
        { l_____, l_____, l_____, l_____, l_____, l_____, l_____, l_____, l_____, l_____, l_____ },
    },
    /* W  X  Y  Z  [  backslash  ]  ^  _  `  a */
    {
        { lX___X, lX___X, lX___X, lXXXXX, l_XXX_, lX____, l_XXX_, l__X__, l_____, l_X___, l_____ },
        { lX___X, lX___X, lX___X, l____X, l_X___, lX____, l___X_, l_X_X_, l_____, l__X__, l_____ },
        { lX___X, l_X_X_, l_X_X_, l___X_, l_X___, l_X___, l___X_, lX___X, l_____, l___X_, l_XXX_ },
        { lX_X_X, l__X__, l__X__, l__X__, l_X___, l__X__, l___X_, l_____, l_____, l_____, l____X },
        { lX_X_X, l_X_X_, l__X__, l_X___, l_X___, l___X_, l___X_, l_____, l_____, l_____, l_XXXX },
        { lXX_XX, lX___X, l__X__, lX____, l_X___, l____X, l___X_, l_____, l_____, l_____, lX___X },
        { lX___X, lX___X, l__X__, lXXXXX, l_XXX_, l____X, l_XXX_, l_____, l_____, l_____, l_XXXX },
        { l_____, l_____, l_____, l_____, l_____, l_____, l_____, l_____, lXXXXX, l_____, l_____ },
    },
    /* b  c  d  e  f  g  h  i  j  k  l */
    {
        { lX____, l_____, l____X, l_____, l__XX_, l_____, lX____, l__X__, l___X_, lX____, l_XX__ },
        { lX____, l_____, l____X, l_____, l_X__X, l_____, lX____, l_____, l_____, lX____, l__X__ },
        { lX_XX_, l_XXX_, l_XX_X, l_XXX_, l_X___, l_XXXX, lX_XX_, l_XX__, l__XX_, lX__X_, l__X__ },
        { lXX__X, lX____, lX__XX, lX___X, lXXX__, lX___X, lXX__X, l__X__, l___X_, lX_X__, l__X__ },
        { lX___X, lX____, lX___X, lXXXXX, l_X___, lX___X, lX___X, l__X__, l___X_, lXX___, l__X__ },
        { lX___X, lX___X, lX___X, lX____, l_X___, l_XXXX, lX___X, l__X__, l___X_, lX_X__, l__X__ },
        { lXXXX_, l_XXX_, l_XXXX, l_XXX_, l_X___, l____X, lX___X, l_XXX_, lX__X_, lX__X_, l_XXX_ },
        { l_____, l_____, l_____, l_____, l_____, l_XXX_, l_____, l_____, l_XX__, l_____, l_____ },
    },
    /* m  n  o  p  q  r  s  t  u  v  w */
    {
        { l_____, l_____, l_____, l_____, l_____, l_____, l_____, l_X___, l_____, l_____, l_____ },
        { l_____, l_____, l_____, l_____, l_____, l_____, l_____, l_X___, l_____, l_____, l_____ },
        { lXX_X_, lX_XX_, l_XXX_, lXXXX_, l_XXXX, lX_XX_, l_XXXX, lXXX__, lX___X, lX___X, lX___X },
        { lX_X_X, lXX__X, lX___X, lX___X, lX___X, lXX__X, lX____, l_X___, lX___X, lX___X, lX___X },
        { lX_X_X, lX___X, lX___X, lX___X, lX___X, lX____, l_XXX_, l_X___, lX___X, lX___X, lX_X_X },
        { lX___X, lX___X, lX___X, lXXXX_, l_XXXX, lX____, l____X, l_X__X, lX__XX, l_X_X_, lX_X_X },
        { lX___X, lX___X, l_XXX_, lX____, l____X, lX____, lXXXX_, l__XX_, l_XX_X, l__X__, l_X_X_ },
        { l_____, l_____, l_____, lX____, l____X, l_____, l_____, l_____, l_____, l_____, l_____ },
    },
    /* x  y  z  {  |  }  ~  none  small A  small C  small D */
    {
        { l_____, l_____, l_____, l___X_, l__X__, l_X___, l_____, lXXXXX, l_____, l_____, l_____ },
        { l_____, l_____, l_____, l__X__, l__X__, l__X__, l_____, lX___X, l_____, l_____, l_____ },
        { lX___X, lX___X, lXXXXX, l__X__, l__X__, l__X__, l_X___, lX_X_X, l_XXX_, l_XXX_, lXXX__ },
        { l_X_X_, lX___X, l___X_, l_X___, l__X__, l___X_, lX_X_X, lX___X, lX___X, lX___X, lX__X_ },
        { l__X__, lX___X, l__X__, l__X__, l__X__, l__X__, l___X_, lX_X_X, lXXXXX, lX____, lX___X },
        { l_X_X_, l_XXXX, l_X___, l__X__, l__X__, l__X__, l_____, lX___X, lX___X, lX___X, lX__X_ },
        { lX___X, l____X, lXXXXX, l___X_, l__X__, l_X___, l_____, lXXXXX, lX___X, l_XXX_, lXXX__ },
        { l_____, l_XXX_, l_____, l_____, l_____, l_____, l_____, l_____, l_____, l_____, l_____ },
    },
    /* small E G I L N O R S T U W */
    {
        { l_____, l_____, l_____, l_____, l_____, l_____, l_____, l_____, l_____, l_____, l_____ },
        { l_____, l_____, l_____, l_____, l_____, l_____, l_____, l_____, l_____, l_____, l_____ },
        { lXXXXX, l_XXXX, l_XXX_, lX____, lX___X, lXXXXX, lXXXX_, lXXXXX, lXXXXX, lX___X, lX___X },
        { lX____, lX____, l__X__, lX____, lXX__X, lX___X, lX___X, lX____, l__X__, lX___X, lX_X_X },
        { lXXXX_, lX__XX, l__X__, lX____, lX_X_X, lX___X, lXXXX_, lXXXXX, l__X__, lX___X, lX_X_X },
        { lX____, lX___X, l__X__, lX____, lX__XX, lX___X, lX__X_, l____X, l__X__, lX___X, lXX_XX },
        { lXXXXX, l_XXXX, l_XXX_, lXXXXX, lX___X, lXXXXX, lX___X, lXXXXX, l__X__, l_XXX_, lX___X },
        { l_____, l_____, l_____, l_____, l_____, l_____, l_____, l_____, l_____, l_____, l_____ },
    },
    /* small Y  small Z  dotless i  ¡  £  §  «  °  ±  ²  ³ */
    {
        { l_____, l_____, l_____, l__X__, l__XX_, l_XXX_, l_____, l_XX__, l_____, l_XX__, l_XXX_ },
        { l_____, l_____, l_____, l_____, l_X__X, lX____, l_____, lX__X_, l__X__, l___X_, l__XX_ },
        { lX___X, lXXXXX, l_XX__, l__X__, l_X___, l_XX__, l__X_X, lX__X_, l_XXX_, l__X__, l___X_ },
        { l_X_X_, l___XX, l__X__, l__X__, lXXX__, lX__X_, l_X_X_, l_XX__, l__X__, l_XXX_, l_XX__ },
        { l__X__, l__X__, l__X__, l__X__, l_X___, l_XX__, lX_X__, l_____, l_____, l_____, l_____ },
        { l__X__, lXX___, l__X__, l__X__, l_X___, l___X_, l_X_X_, l_____, l_XXX_, l_____, l_____ },
        { l__X__, lXXXXX, l_XXX_, l__X__, lXXXXX, lXXX__, l__X_X, l_____, l_____, l_____, l_____ },
        { l_____, l_____, l_____, l_____, l_____, l_____, l_____, l_____, l_____, l_____, l_____ },
    },
    /* µ  ·  »  ½  ¿  Æ  Ð  ×  Ø  Þ  ß */
    {
        { l_____, l_____, l_____, lX____, l__X__, l_XXXX, l_XXX_, l_____, l_XXXX, lX____, l_XX__ },
        { l_____, l_____, l_____, lX___X, l_____, lX_X__, l_X__X, lX___X, lX___X, lX____, lX__X_ },
        { lX___X, l_____, lX_X__, lX__X_, l__X__, lX_X__, l_X__X, l_X_X_, lX__XX, lXXXX_, lX__X_ },
        { lX___X, l__X__, l_X_X_, l__X__, l_XX__, lXXXX_, lXXX_X, l__X__, lX_X_X, lX___X, lX_XX_ },
        { lX___X, l_____, l__X_X, l_X_XX, lX____, lX_X__, l_X__X, l_X_X_, lXX__X, lXXXX_, lX___X },
        { lXX_XX, l_____, l_X_X_, lX___X, lX___X, lX_X__, l_X__X, lX___X, lX___X, lX____, lX___X },
        { lX_X__, l_____, lX_X__, l___X_, l_XXX_, lX_XXX, l_XXX_, l_____, lXXXX_, lX____, lX_XX_ },
        { lX____, l_____, l_____, l___XX, l_____, l_____, l_____, l_____, l_____, l_____, lX____ },
    },
    /* æ  ð  ÷  ø  þ  ď  đ  Ħ  ħ  ĺ  Ł */
    {
        { l_____, l_X_X_, l_____, l_____, l_____, l__X_X, l___X_, lX___X, l_X___, l_XX_X, l_X___ },
        { l_____, l__X__, l__X__, l____X, lX____, l__X_X, l__XXX, lXXXXX, lXXX__, l__XX_, l_X___ },
        { lXX_X_, l_X_X_, l_____, l_XXX_, lXXXX_, l_XX__, l_XXX_, lX___X, l_XXX_, l__X__, l_XX__ },
        { l__X_X, l___X_, lXXXXX, lX__XX, lX___X, lX_X__, lX__X_, lXXXXX, l_X__X, l__X__, lXX___ },
        { l_XXXX, l_XXXX, l_____, lX_X_X, lX___X, lX_X__, lX__X_, lX___X, l_X__X, l__X__, l_X___ },
        { lX_X__, lX___X, l__X__, lXX__X, lXXXX_, lX_X__, lX__X_, lX___X, l_X__X, l__X__, l_X___ },
        { l_X_XX, l_XXX_, l_____, l_XXX_, lX____, l_XX__, l_XXX_, lX___X, l_X__X, l_XXX_, l_XXXX },
        { l_____, l_____, l_____, lX____, lX____, l_____, l_____, l_____, l_____, l_____, l_____ },
    },
    /* ł  Ŋ  ŋ  Œ  œ  Ω  “  ”  „  •  … */
    {
        { l_XX__, lX___X, l_____, l_XXXX, l_____, l_____, l_X_X_, l_X_X_, l_____, l_____, l_____ },
        { l__X__, lXX__X, l_____, lX_X__, l_____, l_XXX_, lX_X__, l_X_X_, l_____, l_____, l_____ },
        { l__XX_, lXX__X, lX_XX_, lX_X__, l_X_X_, lX___X, lX_X__, lX_X__, l_____, l_XXX_, l_____ },
        { l__X__, lX_X_X, lXX__X, lX_XX_, lX_X_X, lX___X, l_____, l_____, l_____, l_XXX_, l_____ },
        { l_XX__, lX__XX, lX___X, lX_X__, lX_XXX, l_X_X_, l_____, l_____, l_____, l_XXX_, l_____ },
        { l__X__, lX__XX, lX___X, lX_X__, lX_X__, lXX_XX, l_____, l_____, l_X_X_, l_____, l_____ },
        { l_XXX_, lX___X, l____X, l_XXXX, l_X_XX, l_____, l_____, l_____, l_X_X_, l_____, lX_X_X },
        { l_____, l__XX_, l__XX_, l_____, l_____, l_____, l_____, l_____, lX_X__, l_____, l_____ },
    },
    /* €  ←  ↑  →  ↓  ■                */
    {
        { l__XXX, l_____, l__X__, l_____, l__X__, l_____, l_____, l_____, l_____, l_____, l_____ },
        { l_X___, l__X__, l_XXX_, l__X__, l__X__, lXXXXX, l_____, l_____, l_____, l_____, l_____ },
        { lXXXX_, l_X___, lX_X_X, l___X_, l__X__, lXXXXX, l_____, l_____, l_____, l_____, l_____ },
        { l_X___, lXXXXX, l__X__, lXXXXX, l__X__, lXXXXX, l_____, l_____, l_____, l_____, l_____ },
        { lXXXX_, l_X___, l__X__, l___X_, lX_X_X, lXXXXX, l_____, l_____, l_____, l_____, l_____ },
        { l_X___, l__X__, l__X__, l__X__, l_XXX_, lXXXXX, l_____, l_____, l_____, l_____, l_____ },
        { l__XXX, l_____, l__X__, l_____, l__X__, l_____, l_____, l_____, l_____, l_____, l_____ },
        { l_____, l_____, l_____, l_____, l_____, l_____, l_____, l_____, l_____, l_____, l_____ },
    },
};
/* clang-format on */

#define FALLBACK 95u                            /* the glyph of what the font has not */
#define SMALL 96u                               /* capitals of five rows, to go under a mark: */
static const char small[] = "ACDEGILNORSTUWYZ"; /* and then the i without a dot */
#define DOTLESS (SMALL + sizeof small - 1u)
#define OWN (DOTLESS + 1u) /* glyphs of these code points: */
static const uint16_t own[] = { 0xa1,   0xa3,   0xa7,   0xab,   0xb0,   0xb1,   0xb2,   0xb3,
                                0xb5,   0xb7,   0xbb,   0xbd,   0xbf,   0xc6,   0xd0,   0xd7,
                                0xd8,   0xde,   0xdf,   0xe6,   0xf0,   0xf7,   0xf8,   0xfe,
                                0x10f,  0x111,  0x126,  0x127,  0x13a,  0x141,  0x142,  0x14a,
                                0x14b,  0x152,  0x153,  0x3a9,  0x201c, 0x201d, 0x201e, 0x2022,
                                0x2026, 0x20ac, 0x2190, 0x2191, 0x2192, 0x2193, 0x25a0 };

/* Code points that look like others. */
static const struct {
    uint16_t code, as;
} alike[] = { { 0xa0, ' ' },    { 0xa6, '|' },    { 0xad, '-' },     { 0xb4, '\'' },
              { 0xba, 0xb0 },   { 0x110, 0xd0 },  { 0x218, 0x15e },  { 0x219, 0x15f },
              { 0x21a, 0x162 }, { 0x21b, 0x163 }, { 0x3bc, 0xb5 },   { 0x1e9e, 0xdf },
              { 0x2010, '-' },  { 0x2013, '-' },  { 0x2014, '-' },   { 0x2018, '`' },
              { 0x2019, '\'' }, { 0x201a, ',' },  { 0x2126, 0x3a9 }, { 0x2212, '-' } };

/* Marks over and under letters: rows 0 and 1, and row 7. */
static const struct {
    char name;
    uint8_t top[2], bottom;
} marks[] = { { '`', { l_X___, l__X__ }, l_____ }, { '\'', { l___X_, l__X__ }, l_____ },
              { '^', { l__X__, l_X_X_ }, l_____ }, { '~', { l_X__X, lX_XX_ }, l_____ },
              { ':', { l_X_X_, l_____ }, l_____ }, { 'o', { l__XX_, l__XX_ }, l_____ },
              { 'v', { l_X_X_, l__X__ }, l_____ }, { 'u', { lX___X, l_XXX_ }, l_____ },
              { '-', { l_XXX_, l_____ }, l_____ }, { '.', { l__X__, l_____ }, l_____ },
              { '=', { l__X_X, l_X_X_ }, l_____ }, { ',', { l_____, l_____ }, l_XX__ },
              { ';', { l_____, l_____ }, l___XX }, { '|', { l____X, l____X }, l_____ } };

/* From U+00C0 on, two characters each: a letter and its mark; blanks: it has a glyph of its own, or
 * none. Capitals are small ones where the mark is over them. */
#define COMPOSED 0xc0u
static const char composed[] = "A`A'A^A~A:Ao  C,E`E'E^E:I`I'I^I:"
                               "  N~O`O'O^O~O:    U`U'U^U:Y'    "
                               "a`a'a^a~a:ao  c,e`e'e^e:i`i'i^i:"
                               "  n~o`o'o^o~o:    u`u'u^u:y'  y:"
                               "A-a-AuauA;a;C'c'C^c^C.c.CvcvDv  "
                               "    E-e-EueuE.e.E;e;EvevG^g^Gugu"
                               "G.g.G,g'        I~i~I-i-IuiuI;i;"
                               "I.          K,k,  L'  L,l,L|l|  "
                               "      N'n'N,n,Nvnv      O-o-Ouou"
                               "O=o=    R'r'R,r,RvrvS's'S^s^S,s,"
                               "SvsvT,t,Tvt|    U~u~U-u-UuuuUouo"
                               "U=u=U;u;W^w^Y^y^Y:Z'z'Z.z.Zvzv  ";

static void copy(uint8_t rows[ROWS], uint32_t glyph)
{
    for (uint32_t y = 0; y < ROWS; y++)
        rows[y] = glyphs[glyph / ACROSS][y][glyph % ACROSS];
}

/* Compose letter `base` and mark `name`. */
static void compose(uint8_t rows[ROWS], char base, char name)
{
    uint32_t glyph = (uint32_t)base - 0x20u, k = 0;
    while (marks[k].name != name) /* each name of composed[] is there */
        k++;
    if (marks[k].top[0] && name != '|') {
        for (uint32_t s = 0; s + 1u < sizeof small; s++)
            glyph = small[s] == base ? SMALL + s : glyph;
        glyph = base == 'i' ? DOTLESS : glyph;
    }
    copy(rows, glyph);
    rows[0] |= marks[k].top[0];
    rows[1] |= marks[k].top[1];
    rows[ROWS - 1] |= marks[k].bottom;
}

void zs_font_glyph(uint8_t rows[ROWS], uint32_t code)
{
    uint32_t glyph = FALLBACK;
    if (code - 0x20u < FALLBACK) {
        copy(rows, code - 0x20u);
        return;
    }
    for (uint32_t k = 0; k < sizeof alike / sizeof alike[0]; k++)
        code = alike[k].code == code ? alike[k].as : code;
    const uint32_t at = (code - COMPOSED) * 2u; /* code < 2^21 */
    if (code >= COMPOSED && at + 2u < sizeof composed && composed[at] != ' ') {
        compose(rows, composed[at], composed[at + 1u]);
        return;
    }
    if (code - 0x20u < FALLBACK)
        glyph = code - 0x20u;
    if (code == 0x131u)
        glyph = DOTLESS;
    for (uint32_t k = 0; k < sizeof own / sizeof own[0]; k++)
        glyph = own[k] == code ? OWN + k : glyph;
    copy(rows, glyph);
}
