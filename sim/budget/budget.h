/* What a display, a part, a strip height and a scene take, before there is a board: RAM by pool, stack, flash, time on
 * the wire and time to draw. Bytes are exact (sizes and flash of Cortex-M are on record: sim/budget/record_sizes.h);
 * times are estimates from costs by stage (costs.h).
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_BUDGET_H
#define SIM_BUDGET_H

#include "costs.h"
#include "demo_frame.h"
#include "method_names.h"
#include "render_options.h"

struct budget_request {
    /* panel, size, strip, buffers, pools, shading, depth, model and view: as of zsim render */
    struct sim_options o;
    const char *scene, *part, *fit, *check, *elf, *error; /* NULL: not given */
    long frame;                /* of a demo scene, ... */
    struct sim_orbit orbit;    /* ... seen from there */
    long instances, watch, track;
    long scene_tris, scene_verts;
    double coverage, complexity; /* percent of the picture; triangles at a covered pixel */
    double cpi, mhz, bar;
    int core;                  /* enum sim_core */
    long app_ram, app_flash;
    long buffer[2], color_bits, bits_of_depth, samples, accesses, access_bits; /* of a whole frame in RAM */
    double fragments;          /* depth complexity there */
    int has_tris, has_verts, has_strip, has_core, has_mhz, has_cpi, has_buffer, has_scene_tris, has_scene_verts;
    int state, textbook, csv, help; /* flags */
    int quiet;                      /* flag: nothing is said of code that is not in the flash */
    struct sim_kept_scene *kept;    /* of the model, in views that are asked for in turn; NULL: for this one alone */
    int methods, effects;           /* flags */
    long ram;                       /* --ram: bytes for --methods */
};

/* ---- Parts -------------------------------------------------------------------------------------- */

struct budget_part {
    const char *name; /* lower case */
    enum sim_core core;
    double mhz;
    double spi_mhz;      /* the fastest its SPI is as a master; 0: not known */
    uint32_t ram, flash; /* bytes that a program can use */
    const char *text;
};
extern const struct budget_part budget_parts[];
extern const uint32_t n_budget_parts;
/* Those that a short table names, for budget_part_named. */
#define BUDGET_USUAL_PARTS 3
extern const char *const budget_usual_parts[BUDGET_USUAL_PARTS];
/* By its name or how only that begins, in either case of letters. NULL: none, or several. */
const struct budget_part *budget_part_named(const char *name);
const char *budget_part_list(void); /* "a, b, c". Static storage */
/* Say that there is none, or several, and which there are. SIM_REFUSED. */
int budget_part_refuse(const char *option, const char *name);

/* ---- Figures ------------------------------------------------------------------------------------ */

enum budget_cpu { BUDGET_M0, BUDGET_M3, BUDGET_CPUS }; /* Armv6-M, Armv7-M and better: what bytes are on record for */

struct budget_ram {
    uint32_t color, depth, tiles, bins, tris, verts, numbers, attrs, arena; /* pools, and their sum */
    uint32_t shared;                                                        /* of tris: a method's own records */
    uint32_t renderer, scene, panel, scratch, watch, track;                 /* statics beside it */
    uint32_t fixed;                                                         /* the sum of those */
    uint32_t stack[BUDGET_CPUS], total[BUDGET_CPUS];
    uint32_t code, reserved; /* of the RP2040 besides, budget_ram_code: code in RAM, stack beyond the worst case */
};

struct budget_flash {
    /* code; of libgcc and the C library; the driver; meshes and textures */
    uint32_t zstrip, library, panel, data, total;
};

struct budget_wire {
    double bytes, pixel_bytes, windows, ms; /* of a frame */
};

struct budget {
    struct zs_config config;
    uint32_t n_instances;
    uint32_t shades; /* bits of record_flash */
    uint32_t texels; /* bits: 565, pal8, pal4 */
    uint32_t data;   /* bytes of meshes, textures, palettes */
    struct sim_counted counted;
    struct budget_ram ram;
    struct budget_flash flash[BUDGET_CPUS];
    struct budget_wire wire;
    int has_wire; /* flag: there is a panel */
    uint32_t samples; /* a pixel, 4; 0: one */
    int states;   /* flag: some instance has one */
    int guessed;  /* flag: counted is from numbers, not from a frame */
    int clusters; /* flag: ZS_FAST_CLUSTERS is listed, as of every converted model */
    int effects;  /* flag: some material has a shader of effect/ */
    const struct sim_method *method; /* how hidden surfaces are removed */
};

enum budget_cpu budget_cpu_of(enum sim_core core);
/* Are flash and stack of a core on record? Not of RISC-V, which takes more flash than the Cortex-M3; in the sums of its
 * RAM that one's stack stands in. */
int budget_bytes_known(enum sim_core core);
#define BUDGET_UNKNOWN_BYTES "flash and stack of RISC-V parts are not known"

/* Pools and statics of b->config. */
void budget_ram(struct budget_ram *ram, const struct budget_request *rq, const struct zs_config *config,
                uint32_t n_instances);
/* What the RP2040 has in RAM besides, of pools and statics that are known (firmware/boards/pico/pico.ld). */
void budget_ram_code(struct budget_ram *ram, const struct budget_request *rq, const struct budget *b);
/* All of it on a core. */
double budget_ram_on(const struct budget_ram *ram, enum sim_core core);
void budget_flash(struct budget_flash *flash, const struct budget_request *rq, const struct budget *b,
                  enum budget_cpu cpu);
/* SIM_OK; SIM_REFUSED. Needs rq->o.panel.name. */
int budget_wire(struct budget_wire *wire, const struct budget_request *rq, const struct zs_config *config);

/* All of these, of a scene that was counted; the wire where there is a panel. SIM_OK; SIM_REFUSED. */
int budget_take(struct budget *b, const struct budget_request *rq);

/* What a request says where nothing is said. */
void budget_defaults(struct budget_request *rq);

/* A model that is loaded, seen as rq->o says: the same as budget_scene. */
int budget_model(struct budget *b, const struct budget_request *rq, const struct sim_model *model);

/* Of a frame that has been drawn: its pools alone, as of scenes with effects, whose time is not known. */
void budget_frame(struct budget *b, const struct budget_request *rq, const struct zs_config *config,
                  const struct zs_stats *stats);

/* The scene of a request: config (its pools where none were asked for), counts, data. SIM_OK; SIM_REFUSED. */
int budget_scene(struct budget *b, const struct budget_request *rq);

/* Are all accelerators listed? Of other lists there are no figures of time and flash. */
int budget_of_all(const struct budget_request *rq);
/* Is there an estimate of time? Not of numbers alone by a method: what it sorts or compares is then not known. */
int budget_has_time(const struct budget *b);
/* The most that it is off by, percent of what the frames took that it was held against. */
double budget_error(const struct budget *b, enum sim_core core);
/* Cycles of a frame's drawing on a core. NAN: not known. */
double budget_cycles(const struct budget_request *rq, const struct budget *b, enum sim_core core);
/* Cycles of an instruction there: 1 where cycles were counted. */
double budget_cpi(const struct budget_request *rq, enum sim_core core);

/* Milliseconds of a frame on the wire of a part: at the clock that was asked for, or the fastest that the part has; 0
 * without a panel. part NULL: no part's limit. */
double budget_wire_ms(const struct budget_request *rq, const struct budget *b, const struct budget_part *part);

/* A core at a clock, 0: not known, with so long a wire. NAN: not known, such as the flash of RISC-V. */
struct budget_totals {
    double ram, flash, draw_ms, frame_ms, fps, fps_single, fps_double; /* the last two with one buffer and two */
};
void budget_totals(struct budget_totals *t, const struct budget_request *rq, const struct budget *b,
                   enum sim_core core, double mhz, double wire);

/* ---- Answers ------------------------------------------------------------------------------------ */

/* --fit: the largest strip, and the largest scene, that a part takes. */
int budget_fit(const struct budget_request *rq, const struct budget *b);
/* --methods: the largest scene in so many bytes, by each method. */
int budget_methods(const struct budget_request *rq, const struct budget *b);
/* Triangles of the scene that a pool of a method holds at once; the pool for so many. */
uint32_t budget_method_holds(const struct sim_method *method, uint32_t pool);
/* --effects: what a pixel and a vertex take by each, and RAM. */
int budget_effects(const struct budget_request *rq, const struct budget *b);
/* --check: SIM_OK; SIM_REFUSED, each limit that is exceeded said on standard output, the number of them as the message.
 * */
struct budget_figure {
    const char *key;
    double value;
    int at_least; /* flag: a limit is the least it may be, not the most */
    const char *needs; /* what is missing for it; NULL: nothing, value is known */
};
int budget_check(const char *file, const struct budget_figure *figure, size_t n);
/* Flash and RAM of a linked program, little-endian ELF32. */
int budget_elf(const char *file, double *flash, double *ram);
/* --buffer and --textbook. */
int budget_textbook(const struct budget_request *rq);

/* `zsim budget`: the arguments after the name. */
int sim_budget(int argc, char **argv);

#endif
