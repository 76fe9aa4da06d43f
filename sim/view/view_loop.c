/* Words change by keys and the mouse; what they draw is shown, if it is not refused.
 *
 * SPDX-License-Identifier: MIT
 */
#include "view_loop.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "demo_frame.h"
#include "desk.h"
#include "files.h"
#include "listen.h"
#include "output_file.h"
#include "scene_file.h"
#include "sim.h"
#include "window.h"

#define DEGREES_PX 0.5     /* that a drag turns by */
#define DEGREES_KEY 5.0    /* that an arrow turns by */
#define DEGREES_S 40.0     /* that it turns by in a second */
#define FRAMES_S 12.5      /* of an animation */
#define ZOOM 0.9           /* of the distance, by a notch of the wheel */
#define LOOK_S 0.1         /* from one look at the files to the next */
#define COUNT_S 0.5        /* from one count to the next while pictures change */
#define WAIT_MS 50

struct view {
    struct view_words first, wish; /* as at the start; as asked for now */
    struct view_shot shot;         /* what is seen */
    struct view_figures figures;
    struct view_files files;
    struct view_canvas canvas;
    struct view_window *window;
    char said[VIEW_SAID_MAX]; /* of the last picture */
    char broken[VIEW_SAID_MAX]; /* of the file, while it cannot be loaded */
    char *line;               /* the command that draws the shot */
    uint32_t counted;         /* serial of the shot that figures are of */
    double now, moved, looked, count_due; /* seconds */
    double scene_frame;       /* of the animation that is played */
    int refused;              /* flag: said is why */
    int turning, keys, quit, redraw, reload, repaint; /* flags */
    int written;              /* pictures so far */
};

static double clock_s(void)
{
    struct timespec t;
    (void)clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int of_model(const struct view *v)
{
    return v->wish.model != NULL;
}

/* Is a scene's own file shown, which is compiled again when it changes? */
static int is_file(const struct view *v)
{
    return !of_model(v) && sim_scene_file_is(view_words_get(&v->wish, "--scene"));
}

/* ---- Pictures ---------------------------------------------------------------------------------------- */

/* The sentence without the program's name. */
static void keep_sentence(char to[VIEW_SAID_MAX], const char *said)
{
    const size_t n = strlen(sim_program);
    const int named = strncmp(said, sim_program, n) == 0 && strncmp(said + n, ": ", 2) == 0;
    (void)snprintf(to, VIEW_SAID_MAX, "%s", named ? said + n + 2 : said);
}

static char *line_of(const struct view *v)
{
    static const char *const none[] = { NULL };
    return view_words_line(&v->shot.words, of_model(v) ? "zsim render" : "zsim demo", none);
}

/* The scene's own file again. An animation that has become shorter begins anew. */
static int recompile(struct view *v)
{
    const char *scene = view_words_get(&v->wish, "--scene");
    const int status = sim_scene_file_load(scene);
    (void)view_files_changed(&v->files, &v->wish); /* it may include other files now */
    if (status == SIM_OK && atol(view_words_get(&v->wish, "--start")) >= (long)sim_demo_named(scene)->frames) {
        view_words_set(&v->wish, "--start", "0");
        v->scene_frame = 0.0;
    }
    return status;
}

static int take_shot(struct view *v)
{
    char said[VIEW_SAID_MAX];
    const int reload = v->reload;
    view_listen_begin();
    int status = reload && is_file(v) ? recompile(v) : SIM_OK;
    if (status == SIM_OK)
        status = view_shot_take(&v->shot, &v->wish, reload);
    view_listen_end(said);
    v->redraw = v->reload = 0;
    v->repaint = 1;
    v->refused = status != SIM_OK;
    if (reload)
        v->broken[0] = '\0';
    keep_sentence(reload && status != SIM_OK ? v->broken : v->said, said);
    if (status == SIM_OK) {
        free(v->line);
        v->line = line_of(v);
    }
    return status;
}

static void paint(struct view *v)
{
    int w, h, pitch;
    uint32_t *to = view_window_pixels(v->window, &w, &h, &pitch);
    if (to == NULL)
        return;
    const struct view_desk desk = {
        .shot = &v->shot, .wish = &v->wish, .figures = &v->figures, .said = v->broken[0] != '\0' ? v->broken : v->said,
        .refused = v->broken[0] != '\0' || v->refused, .line = v->line, .keys = v->keys
    };
    view_desk_draw(&desk, &v->canvas, to, w, h, pitch);
    view_window_show(v->window);
    v->repaint = 0;
}

/* Figures take as long as some pictures: while it turns, only now and then. */
static void count(struct view *v, int at_once)
{
    const int busy = v->turning || v->now - v->moved < COUNT_S;
    if (v->counted == v->shot.serial || (!at_once && busy && v->now < v->count_due))
        return;
    view_figures_count(&v->figures, &v->shot);
    v->counted = v->shot.serial;
    v->count_due = clock_s() + COUNT_S;
    v->repaint = 1;
}

/* ---- Files ------------------------------------------------------------------------------------------- */

/* Where the picture goes: --out of a model, and of a scene a file in that folder. */
static void name_picture(const struct view *v, char path[4096])
{
    const char *out = view_words_get(&v->shot.words, "--out"), *start = view_words_get(&v->shot.words, "--start");
    if (of_model(v))
        (void)snprintf(path, 4096, "%s", out);
    else
        (void)snprintf(path, 4096, "%s/%s_%03ld.png", out,
                       sim_demo_named(view_words_get(&v->shot.words, "--scene"))->name,
                       start != NULL ? atol(start) : 0L);
}

static void print_figures(const struct view_figures *f)
{
    if (!f->known)
        return;
    (void)printf("# RAM %u bytes; frames a second, estimated%s:", f->ram.total[BUDGET_M3],
                 f->plain ? " of plain faces" : "");
    for (int i = 0; i < BUDGET_USUAL_PARTS; i++)
        if (isfinite(f->fps[i]))
            (void)printf(" %s %.1f", budget_usual_parts[i], f->fps[i]);
        else
            (void)printf(" %s unknown", budget_usual_parts[i]);
    (void)printf("\n");
}

/* The picture into its file, and the command and what it takes to standard output. */
static void write_picture(struct view *v)
{
    char path[4096], said[VIEW_SAID_MAX];
    const struct sim_picture *p = &v->shot.seen.shown;
    int status = SIM_OK;
    name_picture(v, path);
    view_listen_begin();
    if (!of_model(v))
        status = sim_output_folder(view_words_get(&v->shot.words, "--out"), 4096 - 64);
    if (status == SIM_OK)
        status = sim_output_check(path, v->shot.words.model);
    if (status == SIM_OK)
        status = sim_png_save(path, p->width, p->height, p->rgb);
    view_listen_end(said);
    if (status == SIM_OK) {
        (void)snprintf(said, sizeof said, "%s is written", path);
        count(v, 1);
        (void)printf("%s\n", v->line);
        print_figures(&v->figures);
        (void)fflush(stdout);
    }
    keep_sentence(v->said, said);
    v->refused = status != SIM_OK;
    v->repaint = 1;
}

/* ---- Keys and the mouse ------------------------------------------------------------------------------ */

static void step_frame(struct view *v, double by)
{
    char text[32];
    const double n = v->shot.n_frames;
    v->scene_frame += by;
    while (v->scene_frame < 0.0)
        v->scene_frame += n;
    while (v->scene_frame >= n)
        v->scene_frame -= n;
    (void)snprintf(text, sizeof text, "%d", (int)v->scene_frame);
    if (strcmp(text, view_words_get(&v->wish, "--start")) == 0)
        return;
    view_words_set(&v->wish, "--start", text);
    v->redraw = 1;
}

static void turn(struct view *v, double degrees, double rise, double factor)
{
    if (of_model(v))
        view_shot_orbit(&v->shot, &v->wish, degrees, rise, factor);
    else
        view_scene_turn(&v->wish, degrees, rise, factor);
    v->redraw = 1;
}

static void home(struct view *v)
{
    static const char *const place[] = { "--eye", "--at", "--orbit" };
    for (int i = 0; i < 3; i++)
        view_words_set(&v->wish, place[i], NULL);
    v->redraw = 1;
}

static void set(struct view *v, const struct view_event *e)
{
    for (int i = 0; i < n_view_settings; i++)
        if (view_settings[i].key == e->key && view_setting_there(&view_settings[i], &v->wish)) {
            view_setting_step(&view_settings[i], &v->wish, &v->shot, e->shift);
            v->redraw = 1;
        }
}

static void press(struct view *v, const struct view_event *e)
{
    switch (e->key) {
    case 'q':
    case VIEW_KEY_ESCAPE:
        v->quit = 1;
        break;
    case 'h':
    case VIEW_KEY_F1:
        v->keys = !v->keys;
        v->repaint = 1;
        break;
    case 'p':
        write_picture(v);
        break;
    case ' ':
        v->turning = !v->turning;
        break;
    case '+':
    case '-':
        turn(v, 0.0, 0.0, e->key == '+' ? ZOOM : 1.0 / ZOOM);
        break;
    case '0':
        home(v);
        break;
    case VIEW_KEY_F5:
        v->redraw = v->reload = 1;
        break;
    case VIEW_KEY_BACK:
        view_words_copy(&v->wish, &v->first);
        v->scene_frame = of_model(v) ? 0.0 : atof(view_words_get(&v->wish, "--start"));
        v->redraw = 1;
        break;
    case VIEW_KEY_LEFT:
    case VIEW_KEY_RIGHT:
        if (of_model(v) || e->shift)
            turn(v, e->key == VIEW_KEY_LEFT ? -DEGREES_KEY : DEGREES_KEY, 0.0, 1.0);
        else
            step_frame(v, e->key == VIEW_KEY_LEFT ? -1.0 : 1.0);
        break;
    case VIEW_KEY_UP:
    case VIEW_KEY_DOWN:
        turn(v, 0.0, e->key == VIEW_KEY_DOWN ? -DEGREES_KEY : DEGREES_KEY, 1.0);
        break;
    default:
        set(v, e);
        break;
    }
}

static void drag(struct view *v, const struct view_event *e)
{
    int w, h, pitch;
    if (!e->shift || !of_model(v)) {
        turn(v, -DEGREES_PX * e->dx, DEGREES_PX * e->dy, 1.0);
    } else if (view_window_pixels(v->window, &w, &h, &pitch) != NULL) {
        const double scale = view_desk_scale(&v->shot.seen.shown, w, h);
        view_shot_pan(&v->shot, &v->wish, e->dx / scale, e->dy / scale);
        v->redraw = 1;
    }
}

static void handle(struct view *v, const struct view_event *e)
{
    switch (e->kind) {
    case VIEW_EVENT_QUIT:
        v->quit = 1;
        break;
    case VIEW_EVENT_DRAW:
        v->repaint = 1;
        break;
    case VIEW_EVENT_KEY:
        press(v, e);
        break;
    case VIEW_EVENT_DRAG:
        drag(v, e);
        break;
    case VIEW_EVENT_WHEEL:
        for (int i = 0; i < abs(e->dy); i++)
            turn(v, 0.0, 0.0, e->dy > 0 ? ZOOM : 1.0 / ZOOM);
        break;
    case VIEW_EVENT_NONE:
        break;
    }
    if (v->redraw)
        v->moved = v->now;
}

/* ---- The loop ---------------------------------------------------------------------------------------- */

static void look_at_files(struct view *v)
{
    if ((!of_model(v) && !is_file(v)) || v->now < v->looked + LOOK_S)
        return;
    v->looked = v->now;
    if (view_files_changed(&v->files, &v->wish))
        v->redraw = v->reload = 1;
}

static void run(struct view *v)
{
    struct view_event event;
    while (!v->quit) {
        const double before = v->now;
        const int waits = !v->turning && !v->redraw && !v->repaint;
        (void)view_window_next(v->window, &event, waits ? WAIT_MS : 1);
        v->now = clock_s();
        handle(v, &event);
        if (v->turning && of_model(v))
            turn(v, DEGREES_S * (v->now - before), 0.0, 1.0);
        else if (v->turning)
            step_frame(v, FRAMES_S * (v->now - before));
        look_at_files(v);
        if (v->redraw)
            (void)take_shot(v);
        count(v, 0);
        if (v->repaint)
            paint(v);
    }
}

static int open_window(struct view *v)
{
    char title[256];
    int w, h;
    const struct sim_picture *p = &v->shot.seen.shown;
    const char *what = of_model(v) ? v->wish.model : view_words_get(&v->wish, "--scene");
    const char *slash = strrchr(what, '/');
    int status = view_desktop_size(&w, &h);
    if (status != SIM_OK)
        return status;
    h -= 2 * VIEW_PITCH; /* the window has a title */
    int scale = view_desk_scale(p, w, h);
    const int least = h >= VIEW_LEAST_H ? VIEW_LEAST_H : h < VIEW_LOWEST_H ? VIEW_LOWEST_H : h;
    while (scale > 1 && (int)p->height * scale > VIEW_LEAST_H)
        scale--;
    w = VIEW_SIDE_W + (int)p->width * scale;
    h = VIEW_BAR_H + (int)p->height * scale;
    (void)snprintf(title, sizeof title, "%s: %s", sim_program, slash != NULL ? slash + 1 : what);
    return view_window_open(&v->window, title, w > h ? w : h, h < least ? least : h, VIEW_LEAST_W, least);
}

int view_loop(const struct view_words *words)
{
    struct view *v = sim_alloc(1, sizeof *v);
    view_words_copy(&v->first, words);
    view_words_copy(&v->wish, words);
    (void)view_files_changed(&v->files, words);
    v->now = clock_s();
    int status = take_shot(v);
    if (status == SIM_OK && !of_model(v))
        v->scene_frame = atof(view_words_get(words, "--start"));
    if (status == SIM_OK)
        status = open_window(v);
    if (status == SIM_OK)
        run(v);
    view_window_close(v->window);
    view_shot_free(&v->shot);
    view_words_free(&v->first);
    view_words_free(&v->wish);
    view_canvas_free(&v->canvas);
    free(v->line);
    free(v);
    return status;
}
