/* Set-up of textures on Armv6-M, in assembler: it is zs_texture_start (shade/texture.c), bit for
 * bit, for tiny triangles that are affine, with light or without: 620 cycles in place of 1,250.
 * Scene china on an RP2040 takes 1.1 of 9.3 million cycles less. 1,200 bytes.
 *
 * Exact: tests/checks/set_up.c compares it with zs_texture_start on an emulated Cortex-M0.
 *
 * SPDX-License-Identifier: MIT
 */
#include "fast/set_up_parts.h"

#if ZS_SET_UP

#include "shade/persp.h"

#define OF(field) offsetof(struct zs_texture_set, field)
_Static_assert(ZS_SPAN_BOUND_LOG2 == 2 && ZS_PLANE_WIDE == 2 && AT(geom.exp) == AT(geom.rcp) + 4 &&
                   AT(geom.tiny) == AT(geom.rcp) + 8 && OF(bias[1]) == OF(bias) + 4,
               "as below");

/* Of a coordinate whose range is in r7: `both` of zs_texture_most. r1: the set. */
#define SPAN(log2) "movs r6, #1\n\torrs r7, r6\n\tldr r5, [r1, " log2 "]\n\tlsls r7, r5\n\t"

/* zs_texture_affine, and zs_texture_light_affine by a sufficient test. r12: both, lr: range of
 * light, r4: change, r6: least. r3: uv_bits. */
#define AFFINE                                                                                     \
    "mov r5, r12\n\tldr r7, 8f\n\tmovs r1, #32\n\tlsrs r3, r5, #24\n\tbne 2f\n\t"                  \
    "movs r1, #24\n\tlsrs r3, r5, #16\n\tbne 2f\n\tmovs r1, #16\n\tlsrs r3, r5, #8\n"              \
    "2:\n\tldrb r3, [r7, r3]\n\tsubs r1, r3\n\tldr r3, [sp, #4]\n\tldr r3, [r3, %[bits]]\n\t"      \
    "subs r1, r3\n\tbmi 3f\n\tcmp r1, #31\n\tbge 9f\n\t"                                           \
    "movs r5, r6\n\tlsrs r5, r1\n\tcmp r4, r5\n\tbhi 9f\n"                                         \
    "3:\n\tmov r5, lr\n\tlsrs r4, #16\n\tadds r4, #1\n\tmuls r4, r5\n\tlsrs r6, #7\n\t"            \
    "cmp r4, r6\n\tbhi 9f\n\t"

/* r3: the numerator of a gradient: stack d times geom at x, less stack e times
 * geom at y. r2: shift. Uses r3 to r7. */
#define NUMERATOR(d, x, e, y)                                                                      \
    "movs r7, r0\n\tadds r7, %[geom]\n\tldr r3, [sp, #" #d "]\n\tldr r4, [r7, #" #x "]\n\t"        \
    "muls r3, r4\n\tldr r5, [sp, #" #e "]\n\tldr r4, [r7, #" #y "]\n\tmuls r5, r4\n\t"             \
    "subs r3, r5\n\t"
#define QUOTIENT                                                                                   \
    "uxth r4, r3\n\tasrs r3, #16\n\tmov r5, r12\n\tmovs r6, r5\n\tmuls r5, r4\n\tmuls r6, r3\n\t"  \
    "mov r7, lr\n\tmuls r4, r7\n\tmuls r3, r7\n\t"                                                 \
    "lsls r7, r6, #16\n\tasrs r6, #16\n\tadds r5, r7\n\tadcs r3, r6\n\t"                           \
    "lsls r7, r4, #16\n\tlsrs r4, #16\n\tadds r5, r7\n\tadcs r3, r4\n\t"                           \
    "movs r6, #1\n\tlsls r6, r2\n\tlsrs r6, #1\n\tmovs r7, #0\n\tadds r5, r6\n\tadcs r3, r7\n\t"   \
    "lsrs r5, r2\n\tmovs r7, #32\n\tsubs r7, r2\n\tmovs r6, r3\n\tlsls r6, r7\n\torrs r5, r6\n\t"  \
    "asrs r3, r2\n\tasrs r6, r5, #31\n\tcmp r3, r6\n\tbeq 1f\n\tb 9b\n1:\n\t"

/* r1 = (gx x + gy y + 128) / 256, zs_plane_step. gx: r4, gy: r5, x: r6, y: r7. Uses r3, r6, r7. */
#define STEP                                                                                       \
    "asrs r1, r4, #8\n\tmuls r1, r6\n\tasrs r3, r5, #8\n\tmuls r3, r7\n\tadds r1, r3\n\t"          \
    "uxtb r3, r4\n\tmuls r6, r3\n\tuxtb r3, r5\n\tmuls r7, r3\n\tadds r6, r7\n\t"                  \
    "adds r6, #128\n\tasrs r6, #8\n\tadds r1, r6\n\t"

/* The plane of coordinate c, whose differences are on the stack at d1 and d2, to job->c[c]. */
#define PLANE(c, d1, d2, bias)                                                                     \
    NUMERATOR(d1, 12, d2, 8) QUOTIENT                                                              \
    "str r5, [sp, #32]\n\t" NUMERATOR(d2, 0, d1, 4) QUOTIENT                                       \
    "ldr r4, [sp, #32]\n\tldr r7, [r0, %[v]]\n\tldr r6, [r7]\n\tldr r7, [r7, #4]\n\t"              \
    "movs r1, #128\n\tsubs r6, r1, r6\n\tsubs r7, r1, r7\n\t" STEP                                 \
    "ldr r3, [sp]\n\tldrh r3, [r3, #2 * " #c "]\n\tlsls r3, #1\n\tldr r6, [sp, #4]\n\t"            \
    "ldr r7, [r6, %[later]]\n\tlsls r3, r7\n\tadds r1, r3\n\tldr r7, [r6, " bias "]\n\t"           \
    "adds r1, r7\n\tmovs r3, r0\n\tadds r3, %[c] + 12 * " #c "\n\tstmia r3!, {r1, r4, r5}\n\t"

/* Differences of light, uq1_31. */
#define LIGHT "ldr r3, [sp, #24]\n\tlsls r3, #15\n\tldr r4, [sp, #28]\n\tlsls r4, #15\n\t"

ZS_NAKED void zs_set_up_texture_part(void)
{
    __asm__ volatile(
        ".syntax unified\n\t"
        "push {lr}\n\tsub sp, #36\n\tstr r1, [sp, #4]\n\t"
        VALUES "str r2, [sp]\n\tldr r1, [sp, #4]\n\t"
        RANGE(0, 8) "lsrs r5, r7, #14\n\tbne 6f\n\t" SPAN("%[log2]") "mov r12, r7\n\t"
        RANGE(1, 16) "lsrs r5, r7, #14\n\tbne 6f\n\t" SPAN("%[log2] + 4")
        "mov r5, r12\n\torrs r7, r5\n\tmov r12, r7\n\t"
        "movs r7, #0\n\tldr r5, [r1, %[lit]]\n\tcmp r5, #0\n\tbeq 3f\n\t" RANGE(2, 24)
        "b 3f\n6:\tb 9f\n3:\n\tmov lr, r7\n\tmovs r1, r0\n\t" SLOW("9f") AFFINE
        /* r2: shift; halves of the reciprocal */
        "movs r7, r0\n\tadds r7, %[rcp]\n\tldmia r7!, {r4, r5, r6}\n\tcmp r6, #0\n\tbeq 9f\n\t"
        "adds r2, r5, r3\n\tadds r2, #23\n\tsubs r5, r2, #1\n\tcmp r5, #30\n\tbhi 9f\n\t"
        "uxth r5, r4\n\tmov r12, r5\n\tlsrs r4, #16\n\tmov lr, r4\n\tb 4f\n"
        "9:\n\tmovs r0, #0\n\tadd sp, #36\n\tpop {pc}\n"
        "4:\n\t" PLANE(0, 8, 12, "%[bias]") PLANE(1, 16, 20, "%[bias] + 4")
        "ldr r1, [sp, #4]\n\tldr r1, [r1, %[lit]]\n\tcmp r1, #0\n\tbne 1f\n\tb 7f\n"
        "1:\n\tmovs r7, r0\n\tadds r7, %[rcp]\n\tldr r7, [r7, #4]\n\trsbs r7, r7, #0\n\t"
        "movs r3, r0\n\tadds r3, %[geom] + 8\n\tldmia r3!, {r1, r2}\n\t"
        GRADIENT("0", LIGHT, "8f", "2", "9b") "str r3, [sp, #32]\n\t"
        "movs r3, r0\n\tadds r3, %[geom]\n\tldmia r3!, {r1, r2}\n\t"
        GRADIENT("1", LIGHT, "8f", "2", "9b") "rsbs r5, r3, #0\n\tldr r4, [sp, #32]\n\t"
        "movs r3, r0\n\tadds r3, %[ia]\n\tldmia r3!, {r1, r2, r6, r7}\n\t"
        "muls r1, r4\n\tmuls r2, r5\n\tadds r2, r1\n\t" STEP "subs r1, r2\n\t"
        "ldr r2, [sp]\n\tldrh r2, [r2, #4]\n\tlsls r2, #15\n\tadds r1, r2\n\t"
        "movs r3, r0\n\tadds r3, %[c] + 24\n\tstmia r3!, {r1, r4, r5}\n"
        "7:\n\tmovs r1, %[affine]\n\tmovs r2, %[sub]\n\tstr r1, [r0, r2]\n\tmovs r0, #1\n\t"
        "add sp, #36\n\tpop {pc}\n\t"
        ".align 2\n8:\n\t.word zs_clz8\n"
        :
        : [r] "i"(AT(r)), [tri] "i"(AT(tri)), [attr] "i"(offsetof(struct zs_renderer, attr)),
          [n] "i"(offsetof(struct zs_renderer, config.varyings)), [v] "i"(AT(v)),
          [slow] "i"(AT(key_slow) - AT(v) - 12), [geom] "i"(AT(geom)), [rcp] "i"(AT(geom.rcp)),
          [ia] "i"(AT(geom.ia)), [c] "i"(AT(c)), [affine] "i"(ZS_AFFINE), [sub] "i"(AT(sub_log2)),
          [log2] "i"(OF(log2)), [bits] "i"(OF(uv_bits)), [later] "i"(OF(later)),
          [bias] "i"(OF(bias)), [lit] "i"(OF(lit)));
}

ZS_NAKED int zs_set_up_texture(struct zs_job *job __attribute__((unused)),
                               const struct zs_texture_set *set __attribute__((unused)))
{
    __asm__ volatile(".syntax unified\n\tpush {r4, r5, r6, r7, lr}\n\tbl zs_set_up_texture_part\n\t"
                     "pop {r4, r5, r6, r7, pc}");
}

#endif
