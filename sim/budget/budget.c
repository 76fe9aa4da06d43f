/* `zsim budget`: the command line and the report.
 *
 * SPDX-License-Identifier: MIT
 */
#include "budget.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "load_options.h"
#include "option_help.h"
#include "option_table.h"
#include "record_sizes.h"
#include "scene_file.h"
#include "sim.h"
#include "simplify.h"
#include "zs_damage.h"

#define AT(field) offsetof(struct budget_request, field)

static const struct sim_option table[] = {
    { "Display", SIM_OPTION_HEADING },
    SIM_PANEL_OPTIONS(struct budget_request, o.panel, "its bytes and time on the wire, its RAM. There are:"),
    { "--size", SIM_OPTION_SIZE, AT(o.size), AT(o.has_size), 1, ZS_SIZE_MAX,
      .help = "px, where there is no --panel (240x240; a demo scene's own)" },
    { "--spi", SIM_OPTION_COUNT, AT(o.spi_hz), AT(o.has_spi), 1000, 1e9, .value = "HZ",
      .help = "clock of the wire (st7789 and gc9a01 62500000, ssd1351 20000000, ili9341 and ssd1306 10000000, "
              "ssd0323 4000000)" },
    { "Memory", SIM_OPTION_HEADING },
    { "--strip", SIM_OPTION_COUNT, AT(o.strip), AT(has_strip), 1, ZS_SIZE_MAX, .value = "ROWS",
      .help = "rows to a strip (16)" },
    { "--buffers", SIM_OPTION_COUNT, AT(o.buffers), .words = "1|2", .help = "strip buffers (2)" },
    { "--tris", SIM_OPTION_COUNT, AT(o.tris), AT(has_tris), 1, ZS_POOL_MAX,
      .help = "triangles that memory has room for (1000; of a scene or model: what takes it in one pass)" },
    { "--verts", SIM_OPTION_COUNT, AT(o.verts), AT(has_verts), 3, ZS_POOL_MAX,
      .help = "vertices that it has room for (700; of a scene or model likewise)" },
    { "--instances", SIM_OPTION_COUNT, AT(instances), 0, 0, 65535, .help = "of the scene, where that is numbers (1)" },
    { "--watch", SIM_OPTION_COUNT, AT(watch), 0, 0, ZS_SIZE_MAX,
      .help = "columns that zs_damage_compare compares (0: not linked)" },
    { "--track", SIM_OPTION_COUNT, AT(track), 0, 0, 65535,
      .help = "instances that zs_damage_track compares (0: not linked)" },
    { "Scene: a demo scene or a model, drawn here and counted, or else numbers", SIM_OPTION_HEADING },
    { "--scene", SIM_OPTION_TEXT, AT(scene),
      .help = "a demo or bench scene; zsim demo --help lists them; or a scene's own file: my_scene.c, several in "
              "quotes: 'scene.c thing.c'" },
    { "--frame", SIM_OPTION_COUNT, AT(frame), 0, 0, 65535, .value = "T", .help = "frame of its animation (0)" },
    { "MODEL", SIM_OPTION_WORD, .help = "a file, as of zsim render, and for it:" },
    { "--eye", SIM_OPTION_VECTOR, AT(o.eye), AT(o.has_eye), .help = "" },
    { "--at", SIM_OPTION_VECTOR, AT(o.at), AT(o.has_at), .help = "" },
    { "--up", SIM_OPTION_VECTOR, AT(o.up), .help = "the camera: where it stands, looks at, and what is up (0,1,0)" },
    { "--fov", SIM_OPTION_NUMBER, AT(o.fov), 0, 0.001, 179.999, .value = "DEGREES",
      .help = "its field of view, vertical (45)" },
    { "--near", SIM_OPTION_NUMBER, AT(o.near_z), AT(o.has_near), .help = "" },
    { "--far", SIM_OPTION_NUMBER, AT(o.far_z), AT(o.has_far), .help = "distances along the view (around the model)" },
    { "--projection", SIM_OPTION_CHOICE, AT(o.projection), .words = "perspective|orthographic",
      .help = "does what is far look smaller? (perspective)" },
    { "--texture", SIM_OPTION_FILE, AT(o.texture), .value = "T.png",
      .help = "one picture for all faces in place of the model's own" },
    { "--precise", SIM_OPTION_FLAG, AT(o.precise), .help = "24 bits a coordinate instead of 16, as of zsim convert" },
    SIM_SIMPLIFY_OPTION(struct budget_request, o.simplify, 0),
    SIM_LOAD_OPTIONS(struct budget_request, o.limits),
    { "Numbers, where there is neither", SIM_OPTION_HEADING },
    { "--scene-tris", SIM_OPTION_COUNT, AT(scene_tris), AT(has_scene_tris), 1, 1e8,
      .help = "numbers: triangles of all of it (twice --tris, since half turns away)" },
    { "--scene-verts", SIM_OPTION_COUNT, AT(scene_verts), AT(has_scene_verts), 3, 1e8,
      .help = "numbers: vertices of all of it (--verts)" },
    { "--coverage", SIM_OPTION_NUMBER, AT(coverage), 0, 0, 100, .value = "PERCENT",
      .help = "numbers: of the picture, how much it covers (50)" },
    { "--complexity", SIM_OPTION_NUMBER, AT(complexity), 0, 0.01, 1000,
      .help = "numbers: triangles over each covered pixel (1.5)" },
    { "--shade", SIM_OPTION_CHOICE, AT(o.shade), .words = "id|flat|smooth|textured|textured-flat|unlit",
      .help = "how faces are drawn (flat; of a model: as zsim convert chooses)" },
    { "--texture-format", SIM_OPTION_CHOICE, AT(o.texel), AT(o.has_texel), .words = "565|pal8|pal4",
      .help = "how texels are stored (565; of a model: as zsim convert chooses)" },
    { "--depth", SIM_OPTION_CHOICE, AT(o.depth), .words = SIM_DEPTH_WORDS,
      .help = "mapping of depth keys (float)" },
    { "--method", SIM_OPTION_CHOICE, AT(o.method), .words = SIM_METHOD_WORDS,
      .help = "how hidden surfaces are removed; those without depth memory have a mapping of their own (zbuffer)" },
    { "--state", SIM_OPTION_FLAG, AT(state), .help = "some instance has a struct zs_depth_state: its code is linked" },
    { "Part", SIM_OPTION_HEADING },
    { "--part", SIM_OPTION_TEXT, AT(part), .help = "the figures of one part. There are:", .list = budget_part_list },
    { "--core", SIM_OPTION_CHOICE, AT(core), AT(has_core), .words = "M0|M3|M4|M7|rv32imc|RP2040",
      .help = "the core of another part; of M33 and M55 take M4, of M23 M0, of M85 M7" },
    { "--mhz", SIM_OPTION_NUMBER, AT(mhz), AT(has_mhz), 0.001, 10000, .help = "its clock, or another one for --part" },
    { "--cpi", SIM_OPTION_NUMBER, AT(cpi), AT(has_cpi), 0.01, 100,
      .help =
          "cycles an instruction, where only instructions are known (M0 as the RP2040's; assumed, not measured: M3, "
          "M4 1.4, M7 0.9, rv32imc 1.4)" },
    { "--app-ram", SIM_OPTION_COUNT, AT(app_ram), 0, 0, 1e9, .value = "BYTES", .help = "" },
    { "--app-flash", SIM_OPTION_COUNT, AT(app_flash), 0, 0, 1e9, .value = "BYTES",
      .help = "of the rest of the program (0)" },
    { "Answers", SIM_OPTION_HEADING },
    { "--fit", SIM_OPTION_TEXT, AT(fit), .value = "PART",
      .help = "the largest strip for these pools, and the largest pools for this strip" },
    { "--methods", SIM_OPTION_FLAG, AT(methods), .help = "the largest scene that --ram holds, by each method" },
    { "--effects", SIM_OPTION_FLAG, AT(effects), .help = "what a pixel and a vertex take by each effect, and its RAM" },
    { "--ram", SIM_OPTION_COUNT, AT(ram), 0, 1, 1e9, .value = "BYTES",
      .help = "all that --methods may take, with renderer, scene and stack (16384)" },
    { "--check", SIM_OPTION_FILE, AT(check),
      .help =
          "limits, one a line, `name = number`, # begins a comment: most for ram, arena, stack, flash, wire_ms, "
          "strip_ms, draw_ms, frame_ms, least for fps, ram_left, flash_left; exit status 1 where one is exceeded. "
          "Times need --part, or --core and --mhz" },
    { "--elf", SIM_OPTION_FILE, AT(elf), .value = "F.elf",
      .help = "flash and RAM of this build in place of the sums (--check, --part)" },
    { "--csv", SIM_OPTION_FLAG, AT(csv), .help = "figure,value,unit a line" },
    { "--error", SIM_OPTION_FILE, AT(error),
      .help = "how far estimates are from measured scenes: tests/records/bench.txt" },
    { "--bar", SIM_OPTION_NUMBER, AT(bar), 0, 0, 1000, .value = "PERCENT",
      .help = "with --error: exit status 1 where one is further off (15)" },
    { "A frame in RAM, as others keep it", SIM_OPTION_HEADING },
    { "--buffer", SIM_OPTION_SIZE, AT(buffer), AT(has_buffer), 1, 65535,
      .help = "px, {range} each way: the bytes that it takes" },
    { "--color", SIM_OPTION_COUNT, AT(color_bits), 0, 0, 1024, .value = "BITS",
      .help = "of a pixel's colour, RGBA together (32)" },
    { "--depth-bits", SIM_OPTION_COUNT, AT(bits_of_depth), 0, 0, 1024, .value = "BITS", .help = "of its depth (32)" },
    { "--samples", SIM_OPTION_COUNT, AT(samples), 0, 1, 1024, .help = "of a pixel (1)" },
    { "--fragments", SIM_OPTION_NUMBER, AT(fragments), 0, 0, 1e6, .help = "depth complexity, for bytes a frame (4)" },
    { "--accesses", SIM_OPTION_COUNT, AT(accesses), 0, 0, 1e6, .help = "accesses to memory a fragment (0)" },
    { "--access-bits", SIM_OPTION_COUNT, AT(access_bits), 0, 1, 1024, .value = "BITS", .help = "of an access (32)" },
    { "--textbook", SIM_OPTION_FLAG, AT(textbook), .help = "the classic ones" },
    { "Else", SIM_OPTION_HEADING },
    SIM_HELP_OPTIONS(AT(help)),
};

static const struct sim_help help = {
    "zsim budget [MODEL] [options]",
    "What a display, a strip height and a scene take on a part, before there is a board.",
    "Bytes are exact; a time is an estimate from costs by stage, and of numbers alone a rough one.\n"
    "Exit status: 0 done; 1 refused, or a limit exceeded; 2 the command line makes no sense.",
};

/* What the figures of one part, or of a core and a clock, are reckoned for. */
struct target {
    enum sim_core core;
    double mhz; /* 0: not known */
    const struct budget_part *part; /* NULL: none */
};

static struct target target_of(const struct budget_request *rq)
{
    const struct budget_part *part = rq->part ? budget_part_named(rq->part) : NULL;
    return (struct target){ part ? part->core : (enum sim_core)rq->core, rq->has_mhz ? rq->mhz : part ? part->mhz :
        0.0, part };
}

/* ---- Figures ------------------------------------------------------------------------------------ */

static void print_ram(const struct budget_request *rq, const struct budget *b)
{
    const struct budget_ram *r = &b->ram;
    const struct zs_config *c = &b->config;
    printf("RAM, bytes (pools are the same on every machine; the rest as on a Cortex-M)\n");
    printf("  strip buffers   %8u  %u x %u x %u px of 2 bytes\n", r->color, c->buffers, c->width, c->strip_h);
    printf("  depth keys      %8u%s\n", r->depth, r->depth ? "" : "  this method needs none");
    printf("  hidden tiles    %8u\n", r->tiles);
    printf("  bins            %8u  %u strips\n", r->bins, (unsigned)ZS_STRIPS(c->height, c->strip_h));
    printf("  triangles       %8u  %u of 12\n", r->tris, c->max_tris);
    if (r->shared)
        printf("    of these      %8u  for the method's own records\n", r->shared);
    printf("  vertices        %8u  %u of 12\n", r->verts, c->max_verts);
    printf("  their numbers   %8u\n", r->numbers);
    printf("  attributes      %8u  %u words each\n", r->attrs, c->varyings);
    printf("  arena           %8u  ZS_ARENA_BYTES of these\n", r->arena);
    printf("  renderer        %8u\n", r->renderer);
    printf("  scene state     %8u  scene, camera, zs_config, %u instance%s\n", r->scene, b->n_instances,
           b->n_instances == 1 ? "" : "s");
    if (r->panel)
        printf("  panel           %8u  and %u to convert pixels in\n", r->panel, r->scratch);
    if (r->watch)
        printf("  changed strips  %8u  zs_damage_compare, %ld columns\n", r->watch, rq->watch);
    if (r->track)
        printf("  moved instances %8u  zs_damage_track, %ld of them\n", r->track, rq->track);
    printf("  stack           %8u  Cortex-M3; M0+ %u: the worst case, without sink and interrupts\n",
           r->stack[BUDGET_M3],
           r->stack[BUDGET_M0]);
    if (rq->app_ram)
        printf("  the program     %8ld\n", rq->app_ram);
    printf("  together        %8.0f  M0+ %.0f\n", r->total[BUDGET_M3] + (double)rq->app_ram,
           r->total[BUDGET_M0] + (double)rq->app_ram);
    if (target_of(rq).core != SIM_CORE_RP2040)
        return;
    printf("  code in RAM     %8u  the RP2040's: what draws, HAL, a line of text, libgcc and libc are copied there\n",
           r->code);
    printf("  stack, reserved %8u  more than the worst case, up to the 4096 of pico.ld\n", r->reserved);
    printf("  on the RP2040   %8.0f\n", budget_ram_on(r, SIM_CORE_RP2040) + (double)rq->app_ram);
}

static void print_flash(const struct budget_request *rq, const struct budget *b)
{
    const struct budget_flash *m3 = &b->flash[BUDGET_M3], *m0 = &b->flash[BUDGET_M0];
    const int method = b->method->method != NULL;
    printf("\nFlash, bytes, -O2      Cortex-M3      M0+%s\n",
           method && b->effects ? "   without the method's and the effects' own"
           : method             ? "   without the method's own"
           : b->effects         ? "   without the effects' own"
                                : "");
    printf("  renderer        %8u %8u\n", m3->zstrip, m0->zstrip);
    printf("  libgcc, libc    %8u %8u\n", m3->library, m0->library);
    if (m3->panel)
        printf("  panel           %8u %8u\n", m3->panel, m0->panel);
    printf("  scene data      %8u %8u  %s\n", m3->data, m0->data,
           b->guessed ? "meshes of the numbers given, no textures" : "meshes and textures");
    if (rq->app_flash)
        printf("  the program     %8ld %8ld\n", rq->app_flash, rq->app_flash);
    printf("  together        %8.0f %8.0f\n", m3->total + (double)rq->app_flash, m0->total + (double)rq->app_flash);
}

static void print_wire(const struct budget_request *rq, const struct budget *b)
{
    if (!b->has_wire)
        return;
    printf("\nOn the wire of %s, a frame\n", rq->o.panel.name);
    printf("  %.0f bytes, %.0f of them pixels; %.0f windows of %.0f bytes; %.2f ms at %.1f MHz\n", b->wire.bytes,
           b->wire.pixel_bytes, b->wire.windows, (b->wire.bytes - b->wire.pixel_bytes) / b->wire.windows, b->wire.ms,
           (double)rq->o.spi_hz / 1e6);
}

/* Numbers alone do not say what a method sorts or compares. */
static void print_no_time(const struct budget *b)
{
    printf("\nDrawing a frame by %s\n  not estimated from numbers alone; --scene or a model is drawn and counted\n",
           b->method->name);
}

/* While the slowest strip is drawn, the wire has sent the one before it and waits. */
static void print_worst(const struct budget_request *rq, const struct budget *b)
{
    const struct target to = target_of(rq);
    const double worst = b->counted.worst[to.core];
    if (!(worst > 0.0) || b->counted.has_effects) /* the strip would be without its effects */
        return;
    printf("  The slowest of %u strips takes %.2f M", b->counted.stats.strips, worst / 1e6);
    if (to.mhz > 0.0)
        printf(", %.1f ms", worst * budget_cpi(rq, to.core) / (to.mhz * 1e3));
    if (b->has_wire)
        printf("; a strip is %.1f ms on the wire", budget_wire_ms(rq, b, to.part) / b->counted.stats.strips);
    printf(".\n");
}

static void print_drawing(const struct budget_request *rq, const struct budget *b)
{
    const int method = b->method->method != NULL;
    if (!budget_has_time(b)) {
        print_no_time(b);
        return;
    }
    printf("\nDrawing a frame%s%s, estimated%s: instructions, cycles on the RP2040\n ", method ? " by " : "",
           method ? b->method->name : "", b->guessed ? " from numbers alone" : "");
    for (int c = 0; c < SIM_CORES; c++)
        printf(" %s %.2f M%s", sim_core_names[c], sim_costs_sum((enum sim_core)c, &b->counted) / 1e6, c + 1 < SIM_CORES
               ? "," : "\n ");
    const struct target to = target_of(rq);
    const double all = sim_costs_sum(to.core, &b->counted);
    double part[SIM_COST_N] = { 0.0 }; /* of a stage, at the first cost of its name */
    const char *comma = "";
    for (int k = 0; k < SIM_COST_N; k++) {
        int first = 0;
        while (strcmp(sim_cost_names[first].stage, sim_cost_names[k].stage) != 0)
            first++;
        part[first] += b->counted.n[k] * sim_cost_of(to.core, (enum sim_cost)k) / all;
    }
    printf(" of it on %s:", sim_core_names[to.core]);
    for (int k = 0; k < SIM_COST_N; k++)
        if (part[k] >= 0.005) {
            printf("%s %s %.0f %%", comma, sim_cost_names[k].stage, 100.0 * part[k]);
            comma = ",";
        }
    if (b->counted.effects[to.core] > 0.0)
        printf("%s effects %.0f %%", comma, 100.0 * b->counted.effects[to.core] / all);
    printf("\n");
    if (method)
        printf("  %u triangles sorted, %u pairs compared, %u splits, %u rays\n", b->counted.stats.sorted,
               b->counted.stats.pairs, b->counted.stats.splits, b->counted.stats.rays);
    if (b->guessed)
        printf(
            "  Numbers alone may be off by a third. A scene that is drawn and counted (--scene, a model) is at most\n"
            "  %.0f %% off on this core, of the demo and bench scenes, none of which is in the fit.\n",
            ceil(sim_cost_error(to.core)));
    else if (b->counted.has_effects)
        printf("  Of frames with effects on an emulated RP2040 (make effects-error), none is more than %.0f %% off.\n",
               ceil(sim_effects_error()));
    else
        printf("  Of %s, none of which is in the fit, none is more than %.0f %% off on %s.\n",
               method ? "four scenes by five methods" : "the demo and bench scenes", ceil(budget_error(b, to.core)),
               method ? "M0, M3 and RP2040" : "this core");
    print_worst(rq, b);
}

static void print_left(const struct budget_part *p, const struct budget_totals *t)
{
    if (p->ram && isnan(t->flash))
        printf(" %9.0f %9s", p->ram - t->ram, "-");
    else if (p->ram)
        printf(" %9.0f %9.0f", p->ram - t->ram, p->flash - t->flash);
    else /* of --core */
        printf(" %9s %9s", "-", "-");
}

/* Of --part its row alone; of --core and --mhz one more, without memory. */
static void print_parts(const struct budget_request *rq, const struct budget *b, const double elf[2])
{
    const struct target to = target_of(rq);
    const struct budget_part own = { .name = "--core", .core = to.core, .mhz = to.mhz };
    struct budget_totals t;
    int unknown = 0;
    printf("\n%-12s %-8s %5s %9s %9s %8s %8s %8s %8s   left of it; frames a second with one buffer and two\n", "part",
           "core", "MHz", "RAM", "flash", "draw ms", "wire ms", "1 buffer", "2");
    for (uint32_t i = 0; i <= n_budget_parts; i++) {
        const struct budget_part *p = i < n_budget_parts ? &budget_parts[i] : &own;
        struct budget_request with = *rq;
        if (rq->part ? p != to.part : p == &own && !(rq->has_core && rq->has_mhz))
            continue;
        const double wire = budget_wire_ms(rq, b, p);
        budget_totals(&t, &with, b, p->core, rq->part && rq->has_mhz ? rq->mhz : p->mhz, wire);
        printf("%-12s %-8s %5.0f", p->name, sim_core_names[p->core], rq->part && rq->has_mhz ? rq->mhz : p->mhz);
        if (rq->part && rq->elf) {
            t.flash = elf[0];
            t.ram = elf[1];
        }
        print_left(p, &t);
        unknown |= isnan(t.flash) && p->ram;
        const double least = isnan(t.flash) ? b->flash[BUDGET_M3].total + (double)rq->app_flash : t.flash;
        const char *const too = p->ram && (t.ram > p->ram || least > p->flash) ? "   too small" : "";
        if (isnan(t.draw_ms))
            printf(" %8s %8.1f %8s %8s%s\n", "-", wire, "-", "-", too);
        else
            printf(" %8.1f %8.1f %8.1f %8.1f%s\n", t.draw_ms, wire, t.fps_single, t.fps_double, too);
    }
    if (unknown)
        printf("-: " BUDGET_UNKNOWN_BYTES "; what is left of their RAM is with the Cortex-M3's stack.\n");
    printf("Cycles: the RP2040's as the emulator counts them, which M0 takes too; else instructions times\n"
           "%s: M3 and M4 %g, M7 %g, rv32imc %g. Flash without wait states. With two buffers\n"
           "a strip is drawn while the one before is on the wire, which waits for slow strips.%s\n",
           rq->has_cpi ? "--cpi" : "an assumed rate, not measured", budget_cpi(rq, SIM_CORE_M3),
               budget_cpi(rq, SIM_CORE_M7),
           budget_cpi(rq, SIM_CORE_RV32),
           b->has_wire && !(rq->part && rq->o.has_spi) ? " The wire is no faster than the part's SPI." : "");
}

static void print_head(const struct budget_request *rq, const struct budget *b)
{
    const struct zs_stats *s = &b->counted.stats;
    printf("%s, %ux%u in strips of %u rows", rq->scene ? rq->scene : rq->o.model ? rq->o.model : "numbers",
           b->config.width,
           b->config.height, b->config.strip_h);
    if (b->guessed)
        printf(": %u of %ld triangles seen, %ld vertices, %g %% covered %g times\n\n", b->config.max_tris,
               rq->scene_tris,
               rq->scene_verts, rq->coverage, rq->complexity);
    else
        printf(": %u of %u triangles seen, %u pass%s, %u pixels tested\n\n", s->tris_drawn, s->tris_in, s->passes,
               s->passes == 1 ? "" : "es", s->pixels_tested);
}

#define FIGURES_MAX 32

/* What --check and --csv know; with what is missing for those that are not known here. */
static size_t figures_of(struct budget_figure figure[FIGURES_MAX], const struct budget_request *rq,
                         const struct budget *b,
                         const double elf[2])
{
    const struct target to = target_of(rq);
    const enum budget_cpu cpu = budget_cpu_of(to.core);
    struct budget_totals t;
    size_t n = 0;
    budget_totals(&t, rq, b, to.core, to.mhz, budget_wire_ms(rq, b, to.part));
    if (rq->elf) {
        t.flash = elf[0];
        t.ram = elf[1];
    }
    const char *const core = budget_bytes_known(to.core) ? NULL : "a Cortex-M: " BUDGET_UNKNOWN_BYTES;
    const char *const sum = core == NULL || rq->elf ? NULL : "an --elf: " BUDGET_UNKNOWN_BYTES;
    figure[n++] = (struct budget_figure){ "ram", t.ram, 0, sum };
    figure[n++] = (struct budget_figure){ "arena", b->ram.arena, 0, NULL };
    figure[n++] = (struct budget_figure){ "stack", b->ram.stack[cpu], 0, core };
    figure[n++] = (struct budget_figure){ "flash", t.flash, 0, sum };
    figure[n++] = (struct budget_figure){ "wire_ms", b->wire.ms, 0, b->has_wire ? NULL : "a --panel" };
    const char *const clock = to.mhz > 0.0 ? NULL : "a clock: give --part, or --core and --mhz";
    const char *const time = clock || !isnan(t.draw_ms) ? clock
                             : budget_has_time(b) ? "costs that were measured; those of this scene's effects were not"
                                                  : "more than numbers with this method: give --scene or a model";
    const char *const strip = time || b->counted.worst[to.core] > 0.0 ? time
                              : "a frame that is counted: give --scene or a model";
    const char *const part = to.part ? sum : "a --part";
    const double worst = clock ? 0.0 : b->counted.worst[to.core] * budget_cpi(rq, to.core) / (to.mhz * 1e3);
    figure[n++] = (struct budget_figure){ "draw_ms", t.draw_ms, 0, time };
    figure[n++] = (struct budget_figure){ "strip_ms", worst, 0, strip };
    figure[n++] = (struct budget_figure){ "frame_ms", t.frame_ms, 0, time };
    figure[n++] = (struct budget_figure){ "fps", t.fps, 1, time };
    figure[n++] = (struct budget_figure){ "ram_left", part ? 0.0 : to.part->ram - t.ram, 1, part };
    figure[n++] = (struct budget_figure){ "flash_left", part ? 0.0 : to.part->flash - t.flash, 1, part };
    return n;
}

static void print_csv(const struct budget_request *rq, const struct budget *b, const double elf[2])
{
    const struct budget_ram *r = &b->ram;
    const struct target to = target_of(rq);
    const enum budget_cpu cpu = budget_cpu_of(to.core);
    const struct budget_flash *f = &b->flash[cpu];
    const struct {
        const char *key;
        uint32_t value;
    } bytes[] = {
        { "color", r->color },       { "depth", r->depth },     { "tiles", r->tiles },       { "bins", r->bins },
        { "tris", r->tris },         { "verts", r->verts },     { "numbers", r->numbers },   { "attrs", r->attrs },
        { "renderer", r->renderer }, { "scene", r->scene },     { "panel", r->panel },       { "scratch", r->scratch },
        { "watch", r->watch },       { "track", r->track },     { "flash_zstrip", f->zstrip },
            { "flash_library", f->library },
        { "flash_panel", f->panel }, { "flash_data", f->data },
        { "code_in_ram", to.core == SIM_CORE_RP2040 ? r->code : 0u },
        { "stack_reserved", to.core == SIM_CORE_RP2040 ? r->reserved : 0u },
    };
    struct budget_figure figure[FIGURES_MAX];
    const size_t n = figures_of(figure, rq, b, elf);
    puts("figure,value,unit");
    for (size_t i = 0; i < sizeof bytes / sizeof bytes[0]; i++)
        if (budget_bytes_known(to.core) || strncmp(bytes[i].key, "flash_", 6) != 0 ||
            strcmp(bytes[i].key, "flash_data") == 0)
            printf("%s,%u,bytes\n", bytes[i].key, bytes[i].value);
    for (size_t i = 0; i < n; i++) {
        if (figure[i].needs)
            continue;
        const int ms = strstr(figure[i].key, "_ms") != NULL, fps = strcmp(figure[i].key, "fps") == 0;
        printf("%s,%.*f,%s\n", figure[i].key, ms ? 3 : fps ? 1 : 0, figure[i].value, ms ? "ms" : fps ? "1/s" : "bytes");
    }
    if (b->has_wire)
        printf("wire_bytes,%.0f,bytes\nwire_windows,%.0f,windows\n", b->wire.bytes, b->wire.windows);
    for (int c = 0; c < SIM_CORES; c++) {
        if (budget_has_time(b))
            printf("draw_%s,%.0f,%s\n", sim_core_names[c], sim_costs_sum((enum sim_core)c, &b->counted),
                   c == SIM_CORE_RP2040 ? "cycles" : "instructions");
    }
}

/* ---- Command line
 * -------------------------------------------------------------------------------------------------------- */

static int is_source(const char *name)
{
    const size_t n = strlen(name);
    return n > 2 && strcmp(name + n - 2, ".c") == 0;
}

/* Of cores that costs do not know the nearest one is named. */
static int know_core(const char *option, const char *next)
{
    static const struct {
        const char *core, *nearest;
    } like[] = { { "M0+", "M0" }, { "M23", "M0" }, { "M33", "M4" }, { "M55", "M4" }, { "M85", "M7" } };
    const char *const core = strcmp(option, "--core") == 0           ? next
                             : strncmp(option, "--core=", 7) == 0 ? option + 7
                                                                  : NULL;
    for (size_t i = 0; core && i < sizeof like / sizeof like[0]; i++)
        if (strcmp(core, like[i].core) == 0)
            return sim_usage("--core wants %s, not '%s'; take %s", sim_option_find(table, N_TABLE, "--core")->words,
                             core, like[i].nearest);
    return SIM_OK;
}

static int take(struct budget_request *rq, char seen[N_TABLE], int argc, char **argv)
{
    int status = SIM_OK;
    for (int i = 0; status == SIM_OK && i < argc; i++) {
        if (argv[i][0] == '-' && argv[i][1] != '\0') {
            status = know_core(argv[i], i + 1 < argc ? argv[i + 1] : NULL);
            if (status == SIM_OK)
                status = sim_option_take(table, N_TABLE, rq, seen, argc, argv, &i);
        } else if (rq->scene != NULL && is_source(rq->scene) && is_source(argv[i]))
            status = sim_usage("%s: files of one scene are in quotes, as in --scene \"%s %s\"", argv[i], rq->scene,
                               argv[i]);
        else if (rq->o.model != NULL)
            status = sim_usage("one model at a time: '%s' is one too many", argv[i]);
        else
            rq->o.model = argv[i];
    }
    return status;
}

static int given(const char seen[N_TABLE], const char *name)
{
    const struct sim_option *option = sim_option_find(table, N_TABLE, name);
    return option && seen[option - table];
}

/* One answer at a time, and what only some of them take. */
static int one_answer(const char seen[N_TABLE])
{
    static const char *const answers[] = { "--fit", "--methods", "--effects", "--check", "--error", "--buffer",
                                           "--textbook" };
    static const struct {
        const char *option, *of;
    } takes[] = { { "--ram", "--methods" },     { "--bar", "--error" },         { "--color", "--buffer" },
                  { "--depth-bits", "--buffer" }, { "--samples", "--buffer" },    { "--fragments", "--buffer" },
                  { "--accesses", "--buffer" }, { "--access-bits", "--buffer" } };
    static const char *const no_csv[] = { "--check", "--error", "--textbook" };
    const char *first = NULL;
    for (size_t i = 0; i < sizeof answers / sizeof answers[0]; i++)
        if (given(seen, answers[i])) {
            if (first)
                return sim_usage("%s and %s are two answers: ask for one of them", first, answers[i]);
            first = answers[i];
        }
    for (size_t i = 0; i < sizeof takes / sizeof takes[0]; i++)
        if (given(seen, takes[i].option) && !given(seen, takes[i].of))
            return sim_usage("%s is for %s, which is missing", takes[i].option, takes[i].of);
    for (size_t i = 0; i < sizeof no_csv / sizeof no_csv[0]; i++)
        if (given(seen, "--csv") && given(seen, no_csv[i]))
            return sim_usage("--csv: %s has none; leave one of them out", no_csv[i]);
    if (given(seen, "--elf") && first && strcmp(first, "--check") != 0)
        return sim_usage("--elf is for the report, --csv and --check: leave it or %s out", first);
    return SIM_OK;
}

/* Options that a demo scene, a model or numbers do not take. */
static int for_what_is_drawn(const struct budget_request *rq, const char seen[N_TABLE])
{
    enum { SCENE = 1, MODEL = 2, NUMBERS = 4 };
    static const struct {
        const char *option;
        int of;
    } takes[] = { { "--frame", SCENE },
                  { "--eye", MODEL }, { "--at", MODEL }, { "--up", MODEL }, { "--fov", MODEL }, { "--near", MODEL },
                  { "--far", MODEL }, { "--projection", MODEL }, { "--texture", MODEL }, { "--precise", MODEL },
                  { "--simplify", MODEL }, { "--allow-outside", MODEL }, { "--load-memory", MODEL },
                  { "--load-seconds", MODEL },
                  { "--instances", NUMBERS }, { "--scene-tris", NUMBERS }, { "--scene-verts", NUMBERS },
                  { "--coverage", NUMBERS }, { "--complexity", NUMBERS },
                  { "--shade", MODEL | NUMBERS }, { "--texture-format", MODEL | NUMBERS },
                  { "--depth", MODEL | NUMBERS } };
    const int drawn = rq->scene ? SCENE : rq->o.model ? MODEL : NUMBERS;
    for (size_t i = 0; i < sizeof takes / sizeof takes[0]; i++) {
        const char *const name = takes[i].option;
        if (!given(seen, name) || (takes[i].of & drawn))
            continue;
        if (takes[i].of == SCENE || takes[i].of == MODEL)
            return sim_usage("%s is for %s, which is missing", name, takes[i].of == SCENE ? "a --scene" : "a model");
        return takes[i].of == NUMBERS ?
            sim_usage("%s is for numbers alone: leave --scene and the model out", name) :
            sim_usage("%s is for a model or numbers: a demo scene has its own", name);
    }
    if (given(seen, "--depth") && sim_methods[rq->o.method].depth)
        return sim_usage("--method %s brings its depth mapping: leave --depth out", sim_methods[rq->o.method].name);
    if (given(seen, "--texture-format") && !sim_options_textured(&rq->o) &&
        (drawn == NUMBERS || given(seen, "--shade")))
        return sim_usage("--texture-format is for a --shade with textures: textured, textured-flat or unlit");
    return SIM_OK;
}

/* What must not be together, and what follows from what. */
static int settle(struct budget_request *rq, const char seen[N_TABLE])
{
    struct pm_glass glass;
    if (sim_simplify_check(rq->o.simplify) != SIM_OK)
        return SIM_USAGE;
    if (rq->scene && rq->o.model)
        return sim_usage("--scene and a model: one of them");
    if (for_what_is_drawn(rq, seen) != SIM_OK)
        return SIM_USAGE;
    if (rq->scene && sim_scene_file_need(rq->scene) != SIM_OK)
        return SIM_REFUSED;
    if (rq->o.panel.name == NULL && rq->o.has_spi)
        return sim_usage("--spi is for a --panel, which is missing");
    if (rq->part && budget_part_named(rq->part) == NULL)
        return budget_part_refuse("--part", rq->part);
    if (rq->part && rq->has_core)
        return sim_usage("--core is the part's own: leave it or --part out");
    if (rq->has_mhz && !rq->part && !rq->has_core)
        return sim_usage("--mhz is for a --part or a --core, which is missing");
    const int status = sim_panel_take(&rq->o.panel, NULL, rq->o.has_size, rq->o.size, rq->o.strip, &glass);
    if (status != SIM_OK)
        return status;
    if (rq->o.panel.name != NULL && !rq->o.has_spi) {
        const struct budget_part *part = rq->part ? budget_part_named(rq->part) : NULL;
        rq->o.spi_hz = sim_panel_hz(rq->o.panel.name, SIM_PANEL_HZ);
        if (part && part->spi_mhz > 0.0 && part->spi_mhz * 1e6 < (double)rq->o.spi_hz)
            rq->o.spi_hz = (long)(part->spi_mhz * 1e6);
    }
    if (!rq->scene && !rq->o.model) {
        rq->o.tris = rq->has_tris ? rq->o.tris : 1000;
        rq->o.verts = rq->has_verts ? rq->o.verts : 700;
        rq->has_tris = rq->has_verts = 1;
        rq->scene_tris = rq->has_scene_tris ? rq->scene_tris : 2 * rq->o.tris;
        rq->scene_verts = rq->has_scene_verts ? rq->scene_verts : rq->o.verts;
        if (rq->scene_tris < rq->o.tris)
            return sim_refuse(NULL, 0, "--scene-tris %ld is less than the %ld of --tris, which are those that are seen",
                              rq->scene_tris, rq->o.tris);
    }
    return SIM_OK;
}

static int report(const struct budget_request *rq)
{
    static struct budget b;
    struct budget_figure figure[FIGURES_MAX];
    double elf[2] = { 0.0, 0.0 };
    int status = budget_scene(&b, rq);
    if (status == SIM_OK && rq->elf)
        status = budget_elf(rq->elf, &elf[0], &elf[1]);
    if (status != SIM_OK)
        return status;
    if (rq->methods)
        return budget_methods(rq, &b);
    if (rq->effects)
        return budget_effects(rq, &b);
    if (rq->fit)
        return budget_fit(rq, &b);
    status = budget_take(&b, rq);
    if (status != SIM_OK)
        return status;
    if (rq->check)
        return budget_check(rq->check, figure, figures_of(figure, rq, &b, elf));
    if (rq->csv) {
        print_csv(rq, &b, elf);
        return SIM_OK;
    }
    print_head(rq, &b);
    print_ram(rq, &b);
    print_flash(rq, &b);
    if (rq->elf)
        printf("  %s: flash %.0f, RAM %.0f\n", rq->elf, elf[0], elf[1]);
    print_wire(rq, &b);
    print_drawing(rq, &b);
    print_parts(rq, &b, elf);
    return SIM_OK;
}

int sim_budget(int argc, char **argv)
{
    static struct budget_request rq;
    char seen[N_TABLE] = { 0 };
    budget_defaults(&rq);
    int status = take(&rq, seen, argc, argv);
    if (status == SIM_OK && rq.help) {
        sim_option_help(table, N_TABLE, &help);
        return SIM_OK;
    }
    if (status == SIM_OK)
        status = sim_options_in_range(table, N_TABLE, &rq, seen, NULL);
    if (status == SIM_OK)
        status = one_answer(seen);
    if (status != SIM_OK)
        return status;
    if (rq.textbook || rq.has_buffer)
        return budget_textbook(&rq);
    if (rq.error)
        return sim_costs_error(rq.error, rq.bar);
    status = settle(&rq, seen);
    return status == SIM_OK ? report(&rq) : status;
}
