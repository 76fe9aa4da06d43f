/* Smooth shading on an RP2040: rows of zs_fast_smooth with colours and keys in the interpolators,
 * which step all four of them, and pieces of rows of what is drawn piece by piece: triangles in two
 * octaves of the keys, and over pixels that are uncleared. A pixel takes 16 cycles in place of 24,
 * a row 57 in place of 115: 0.35 of 8.4 million cycles in scene teapot; set-up in assembler, and
 * pieces, 0.32 of 7.1. Small triangles go through all stages in one function, one triangle after
 * the other, which hands colours to the lanes without a record and leaves out rows without a pixel
 * at both ends: 0.41 of 6.38. 2,120 bytes.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/fast.h"
#include "core/fx.h"
#include "fast/lanes.h"
#include "fast/set_up_parts.h"
#include "shade/persp.h"
#include "shade/stages.h"

/* Lanes: red and green; blue and, above it, the key. */
#define RED ZS_LANES_FIELD(16u, 11u, 15u)
#define GREEN ZS_LANES_FIELD(21u, 5u, 10u)
#define BLUE ZS_LANES_FIELD(27u, 0u, 4u)
#define KEY ZS_LANES_FIELD(0u, 16u, 31u)

#if ZS_RP2040

ZS_NAKED uint32_t zs_lanes_call(struct zs_job *job __attribute__((unused)),
                                const struct zs_lanes_set *set __attribute__((unused)),
                                const struct zs_plane *third __attribute__((unused)),
                                zs_lanes_fn *rows __attribute__((unused)))
{
    __asm__ volatile(ZS_SAVED
                     "movs r7, r3\n\tldr r3, 9f\n\tadds r3, r0\n\tldr r4, [r0, %[row]]\n\t"
                     "ldr r5, [r0, %[end]]\n\tsubs r4, r5, r4\n\tlsls r4, #2\n\tadds r4, r3\n\t"
                     "blx r7\n\t" ZS_RESTORED ".align 2\n9:\n\t.word %c[cut]\n"
                     :
                     : [row] "i"(AT(row)), [end] "i"(AT(cut_end)), [cut] "i"(AT(cut)));
}

#define PIXEL                                                                                      \
    ZS_LANES_POP_1(r7)                                                                             \
    ZS_LANES_POP_0(r3)                                                                             \
    "orrs r3, r7\n\tlsrs r7, #16\n\t"                                                              \
    "ldrh r2, [r4, r5]\n\tcmp r7, r2\n\tbcs 4f\n\t"                                                \
    "rev16 r3, r3\n\tstrh r7, [r4, r5]\n\tstrh r3, [r6, r5]\n"

/* r1: the lanes; ctrl and base[2] of both. Uses r4 to r7. */
#define SHIFTS                                                                                     \
    "movs r1, #0xd0\n\tlsls r1, #24\n\tadds r1, #0x80\n\tadr r7, 8f\n\t"                           \
    "ldmia r7!, {r4, r5, r6}\n\tstr r4, [r1, #0x2c]\n\tstr r5, [r1, #0x30]\n\t"                    \
    "str r6, [r1, #0x6c]\n\tldr r4, [r7]\n\tstr r4, [r1, #0x70]\n\t"                               \
    "movs r4, #0\n\tstr r4, [r1, #0x10]\n\tstr r4, [r1, #0x50]\n\t"
#define SHIFTS_AT                                                                                  \
    ".align 2\n8:\n\t.word %c[red], %c[green], %c[blue], %c[all]\n"
#define SHIFTS_OF                                                                                  \
    [red] "i"(RED), [green] "i"(GREEN), [blue] "i"(BLUE), [all] "i"(KEY)

/* A plane from r7: lane to column r2 of the row r3. */
#define STEP_TO(accum, base)                                                                       \
    "ldmia r7!, {r4, r5, r6}\n\tstr r5, [r1, #" #base "]\n\tmuls r5, r2\n\tadds r4, r5\n\t"        \
    "muls r6, r3\n\tadds r4, r6\n\tstr r4, [r1, #" #accum "]\n\t"

ZS_NAKED void zs_lanes_smooth_span(
    struct zs_job *job __attribute__((unused)), const struct zs_row *row __attribute__((unused)),
    int32_t i0 __attribute__((unused)), int32_t i1 __attribute__((unused)),
    uint32_t sum __attribute__((unused)), uint32_t step __attribute__((unused)))
{
    __asm__ volatile(
        ".syntax unified\n\t"
        "mov r12, r4\n\tldrb r4, [r0, %[saturates]]\n\tcmp r4, #0\n\tbne 6f\n\t"
        "movs r4, %[sub]\n\tldr r4, [r0, r4]\n\tcmp r4, %[affine]\n\tbne 6f\n\t"
        "mov r4, r12\n\tpush {r4, r5, r6, r7, lr}\n\t"
        "ldr r4, [r1, %[at]]\n\tadds r4, r3\n\tlsls r4, #1\n\tsubs r3, r2, r3\n\tlsls r3, #1\n\t"
        "bge 7f\n\tmov r12, r4\n\tmov lr, r3\n\tldr r3, [r1]\n\t" SHIFTS
        "movs r7, r0\n\tadds r7, %[c]\n\t" STEP_TO(0, 8) STEP_TO(4, 12) STEP_TO(0x40, 0x48)
        "ldr r4, [sp, #20]\n\tstr r4, [r1, #0x44]\n\tldr r4, [sp, #24]\n\tstr r4, [r1, #0x4c]\n\t"
        "ldr r4, [r0, %[depth]]\n\tadd r4, r12\n\tldr r6, [r0, %[color]]\n\tadd r6, r12\n\t"
        "movs r0, r1\n\tmov r5, lr\n"
        "3:\n\t" PIXEL
        "4:\n\tadds r5, #2\n\tbmi 3b\n"
        "7:\n\tpop {r4, r5, r6, r7, pc}\n"
        "6:\n\tmov r4, r12\n\tpush {r0, r1}\n\tldr r0, 9f\n\tstr r0, [sp, #4]\n\tpop {r0, pc}\n\t"
        SHIFTS_AT
        "9:\n\t.word zs_fast_less\n"
        :
        : SHIFTS_OF, [saturates] "i"(AT(saturates)), [sub] "i"(AT(sub_log2)),
          [affine] "i"(ZS_AFFINE), [at] "i"(offsetof(struct zs_row, at)), [c] "i"(AT(c)),
          [depth] "i"(AT(depth)), [color] "i"(AT(color)));
}

#else

#define PIXEL pixel

static int pixel(struct zs_lanes *lanes, const struct zs_lanes_set *set, uint16_t *depth,
                 uint16_t *color)
{
    (void)set;
    const uint32_t key = zs_lanes_pop(&lanes[1]), red_green = zs_lanes_pop(&lanes[0]);
    if (key >> 16 >= *depth)
        return 0;
    *depth = (uint16_t)(key >> 16);
    *color = zs_wire16((uint16_t)(red_green | key));
    return 1;
}
#endif
ZS_LANES_ROWS(rows, PIXEL, "")

static const struct zs_lanes_set lanes_set = { { RED, GREEN, BLUE, KEY }, 0, 0, 0 };

void zs_lanes_smooth_rows(struct zs_job *job)
{
    zs_lanes_draw(job, &lanes_set, &job->c[2], rows);
}

#if ZS_LANES_USED && ZS_SET_UP

static __attribute__((used)) void go_on(struct zs_job *job)
{
    zs_smooth_start(job);
    zs_lanes_go_on(job, &lanes_set, &job->c[2], rows);
}

/* A triangle whose colours are not as zs_set_up_smooth has them. */
static __attribute__((used)) void otherwise(struct zs_job *job)
{
    zs_smooth_start(job);
    (void)job->rows(job);
}

/* Colour c to its lane, at the anchor's column of the row above the first. r0: lanes; r8: half, r9:
 * down, r10: ax, r11: ay, r12: the first vertex's colours, lr: half a code. */
#define LANE(c, at, most, up, accum, base, down)                                                   \
    ZS_COLOR(c, at, most, 24)                                                                      \
    "add r1, lr\n\tasrs r1, #5\n\t" ZS_CODE(c)                                                     \
    "lsls r1, #" #up "\n\tlsls r2, #" #up "\n\tlsls r3, #" #up "\n\t" LANE_AT(accum, base, down)
#define LANE_AT(accum, base, down)                                                                 \
    "str r2, [r0, #" #base "]\n\tstr r3, [sp, #" #down "]\n\tldr r4, [sp, #20]\n\tmuls r3, r4\n\t" \
    "adds r1, r3\n\tstr r1, [r0, #" #accum "]\n\t"

/* Draw the rows of the job r0 whose cuts are from r3 to r4, as zs_set_up_smooth and `rows`, which
 * hand nothing over in memory. Return how many pixels are tested; 0: declined. [sp]: what is added
 * a row, the end of the cuts, from the anchor to the row above the first, weights, differences, the
 * first cut, the job. */
static ZS_NAKED __attribute__((used)) void color_rows(void)
{
    __asm__ volatile(
        ".syntax unified\n\t"
        "push {r0, lr}\n\tsub sp, #68\n\tstr r4, [sp, #16]\n\tstr r3, [sp, #64]\n\t"
        ZS_WEIGHTS(40, 48, 56)
        "add r0, sp, #24\n\tstmia r0!, {r2, r3, r4, r5}\n\t"
        "mov r1, r9\n\tmovs r2, #1\n\tlsls r2, r1\n\tlsrs r2, #1\n\tmov r8, r2\n\t"
        "movs r2, #1\n\tlsls r2, #20\n\tadds r2, #16\n\tmov lr, r2\n\t" /* 32 halves of a code */
        "mov r7, r11\n\tldr r5, [sp, #64]\n\tldr r2, 6f\n\tadds r2, r7\n\tsubs r5, r2\n\t"
        "asrs r5, #2\n\t"
        "ldr r2, [r7, %[row]]\n\tadds r5, r2\n\tsubs r5, #1\n\t"
        "adds r7, %[ia]\n\tldmia r7!, {r1, r2, r3, r4}\n\tmov r10, r3\n\tmov r11, r4\n\t"
        "subs r5, r2\n\tstr r5, [sp, #20]\n\t"
        "movs r0, #0xd0\n\tlsls r0, #24\n\tadds r0, #0x80\n\t"
        /* the lanes' fields, unless they are these */
        "ldr r1, 6f + 4\n\tldr r2, [r0, #0x2c]\n\tcmp r1, r2\n\tbeq 2f\n\t"
        "adr r7, 6f + 4\n\tldmia r7!, {r1, r2, r3, r4}\n\tstr r1, [r0, #0x2c]\n\t"
        "str r2, [r0, #0x30]\n\t"
        "str r3, [r0, #0x6c]\n\tstr r4, [r0, #0x70]\n\tmovs r1, #0\n\tstr r1, [r0, #0x10]\n\t"
        "str r1, [r0, #0x50]\n"
        "2:\n\t" LANE(0, 40, 31, 11, 0, 8, 0) LANE(1, 48, 63, 10, 4, 12, 4)
        LANE(2, 56, 31, 11, 0x40, 0x48, 8)
        "ldr r7, [sp, #68]\n\tmovs r6, r7\n\tadds r6, %[key]\n\tldmia r6!, {r1, r2, r3}\n\t"
        LANE_AT(0x44, 0x4c, 12)
        "movs r6, r7\n\tadds r6, %[ia]\n\tldr r1, [r6]\n\tldr r2, [r6, #4]\n\tadds r2, r4\n\t"
        "adds r2, #1\n\t"
        "ldr r3, [r7, %[y0]]\n\tsubs r2, r3\n\tldr r3, [r7, %[pitch]]\n\tlsls r3, #1\n\t"
        "muls r2, r3\n\t"
        "ldr r5, [r7, %[depth]]\n\tadds r2, r5\n\tldr r6, [r7, %[color]]\n\tsubs r6, r5\n\t"
        "ldr r4, [r7, %[width]]\n\tmov r8, r2\n\tmov r9, r6\n\tmov r10, r3\n\tmov r11, r4\n\t"
        "ldr r2, [sp, #64]\n\tmov r12, r2\n\tmovs r2, #0\n\tmov lr, r2\n\t" ZS_LANES_LOOP(PIXEL)
        "mov r0, lr\n\trsbs r0, r0, #0\n"
        "7:\n\tadd sp, #72\n\tpop {pc}\n\t"
        ".align 2\n6:\n\t.word %c[cut], %c[red], %c[green], %c[blue], %c[all]\n"
        :
        : ZS_WEIGHTS_OF, [row] "i"(AT(row)), [ia] "i"(AT(geom.ia)), [key] "i"(AT(key)),
          [y0] "i"(AT(y0)), [pitch] "i"(AT(pitch)), [depth] "i"(AT(depth)), [color] "i"(AT(color)),
          [width] "i"(AT(width)), [cut] "i"(AT(cut)), SHIFTS_OF);
}

/* Stages of a small triangle one after the other, with all registers saved once. 8f: it is not for
 * them; nothing but the job has changed. */
ZS_NAKED int zs_lanes_smooth_draw(struct zs_job *job __attribute__((unused)))
{
    __asm__ volatile(
        ".syntax unified\n\t" ZS_SAVED
        "push {r0}\n9:\n\tldr r0, [sp]\n\tbl zs_set_up_rows_part\n\tcmp r0, %[rows]\n\t"
        "bcc 11f\n\tbhi 2f\n\t"
        "ldr r0, [sp]\n\tbl color_rows\n\tcmp r0, #0\n\tbeq 6f\n\tbmi 5f\n\tb 3f\n"
        "2:\n\tmovs r0, #0\n"
        ZS_DRAWN("9f + 4", "9f + 12", "4")
        "5:\n\tldr r0, [sp]\n\tbl zs_set_up_coarse_part\n\tcmp r0, #0\n\tbeq 6f\n\t"
        "ldr r0, [sp]\n\tldr r1, 9f + 8\n\tmovs r2, r0\n\tadds r2, %[third]\n\tldr r3, 9f\n\t"
        "adds r3, r0\n\tldr r5, [r0, %[row]]\n\tldr r4, [r0, %[end]]\n\tsubs r4, r5\n\t"
        "lsls r4, #2\n\tadds r4, r3\n\tbl rows\n\tb 3b\n"
        ZS_OTHERWISE("9f + 4")
        ".align 2\n9:\n\t.word %c[cut], %c[stats], lanes_set, %c[chain]\n"
        :
        : ZS_CHAIN_OF, ZS_DRAWN_OF, [chain] "i"(AT(chain)), [rows] "i"(ZS_SET_UP_ROWS),
          [row] "i"(AT(row)), [end] "i"(AT(cut_end)),
          [row_end] "i"(AT(row_end)), [r] "i"(AT(r)), [cut] "i"(AT(cut)),
          [third] "i"(AT(c[2])));
}

#endif
