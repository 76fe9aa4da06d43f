/* SDL2 by dlopen. Its pixels are those of the window's surface, in memory, without any graphics hardware.
 *
 * SPDX-License-Identifier: MIT
 */
#include "window.h"

#include "sim.h"

#ifndef VIEW_SDL
#if __has_include(<SDL2/SDL.h>)
#define VIEW_SDL 1
#else
#define VIEW_SDL 0
#endif
#endif

#if VIEW_SDL
#include <dlfcn.h>
#include <stdlib.h>
#include <string.h>

#include <SDL2/SDL.h>

#define STEP_MS 5 /* from one look at the events to the next */
#define LIBRARY "libSDL2-2.0.so.0"
#define FUNCTIONS(F)                                                                                                 \
    F(SDL_Init)                                                                                                      \
    F(SDL_Quit)                                                                                                      \
    F(SDL_GetCurrentVideoDriver)                                                                                     \
    F(SDL_GetError)                                                                                                  \
    F(SDL_SetHint)                                                                                                   \
    F(SDL_GetDisplayUsableBounds)                                                                                    \
    F(SDL_CreateWindow)                                                                                              \
    F(SDL_DestroyWindow)                                                                                             \
    F(SDL_SetWindowMinimumSize)                                                                                      \
    F(SDL_GetWindowSurface)                                                                                          \
    F(SDL_UpdateWindowSurface)                                                                                       \
    F(SDL_PumpEvents)                                                                                                \
    F(SDL_PeepEvents)                                                                                                \
    F(SDL_PollEvent)                                                                                                 \
    F(SDL_GetTicks)                                                                                                  \
    F(SDL_Delay)

#define FIELD(name) __typeof__(name) *name;
static struct {
    void *library;
    FUNCTIONS(FIELD)
} sdl;

struct view_window {
    SDL_Window *window;
};

/* ---- The library ------------------------------------------------------------------------------------- */

static int load(void)
{
#define NAMED(name) { #name, (void *)&sdl.name },
    const struct {
        const char *name;
        void *at;
    } all[] = { FUNCTIONS(NAMED) };
    if (sdl.library != NULL)
        return SIM_OK;
    sdl.library = dlopen(LIBRARY, RTLD_NOW | RTLD_LOCAL);
    if (sdl.library == NULL)
        return sim_refuse(NULL, 0, "a window needs %s, which is not there: install the package libsdl2-2.0-0", LIBRARY);
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        *(void **)all[i].at = dlsym(sdl.library, all[i].name);
        if (*(void **)all[i].at == NULL)
            return sim_refuse(NULL, 0, "%s has no %s: a newer package libsdl2-2.0-0 is needed", LIBRARY, all[i].name);
    }
    (void)sdl.SDL_SetHint(SDL_HINT_FRAMEBUFFER_ACCELERATION, "0");
    (void)sdl.SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");
    (void)sdl.SDL_SetHint(SDL_HINT_VIDEO_X11_NET_WM_BYPASS_COMPOSITOR, "0");
    (void)sdl.SDL_SetHint(SDL_HINT_VIDEO_ALLOW_SCREENSAVER, "1");
    /* without a desktop SDL would draw where nobody sees it */
    if (getenv("DISPLAY") == NULL && getenv("WAYLAND_DISPLAY") == NULL && getenv("SDL_VIDEODRIVER") == NULL)
        return sim_refuse(NULL, 0, "no window can be opened: there is no desktop, since neither DISPLAY nor "
                                   "WAYLAND_DISPLAY is set");
    if (sdl.SDL_Init(SDL_INIT_VIDEO) != 0)
        return sim_refuse(NULL, 0, "no window can be opened: %s; is there a desktop (DISPLAY or WAYLAND_DISPLAY)?",
                          sdl.SDL_GetError());
    const char *driver = sdl.SDL_GetCurrentVideoDriver(); /* where no server answers, SDL 2.26 takes "offscreen" */
    if (getenv("SDL_VIDEODRIVER") == NULL &&
        (driver == NULL || strcmp(driver, "offscreen") == 0 || strcmp(driver, "dummy") == 0))
        return sim_refuse(NULL, 0, "no window can be opened: no desktop answers (DISPLAY or WAYLAND_DISPLAY)");
    return SIM_OK;
}

int view_desktop_size(int *w, int *h)
{
    SDL_Rect all = { 0, 0, 1280, 1024 };
    const int status = load();
    if (status == SIM_OK)
        (void)sdl.SDL_GetDisplayUsableBounds(0, &all);
    *w = all.w;
    *h = all.h;
    return status;
}

/* ---- The window -------------------------------------------------------------------------------------- */

int view_window_open(struct view_window **out, const char *title, int w, int h, int least_w, int least_h)
{
    int most_w, most_h;
    *out = NULL;
    const int status = view_desktop_size(&most_w, &most_h);
    if (status != SIM_OK)
        return status;
    w = w > most_w ? most_w : w;
    h = h > most_h ? most_h : h;
    struct view_window *window = sim_alloc(1, sizeof *window);
    window->window = sdl.SDL_CreateWindow(title, SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED,
                                          w < least_w ? least_w : w, h < least_h ? least_h : h,
                                          SDL_WINDOW_RESIZABLE);
    if (window->window == NULL) {
        free(window);
        return sim_refuse(NULL, 0, "no window can be opened: %s", sdl.SDL_GetError());
    }
    if (view_window_pixels(window, &most_w, &most_h, &(int){ 0 }) == NULL) {
        view_window_close(window);
        return sim_refuse(NULL, 0, "no window can be opened: it takes a desktop of 24 or 32 bits a pixel");
    }
    sdl.SDL_SetWindowMinimumSize(window->window, least_w, least_h);
    *out = window;
    return SIM_OK;
}

void view_window_close(struct view_window *window)
{
    if (window == NULL)
        return;
    sdl.SDL_DestroyWindow(window->window);
    free(window);
    sdl.SDL_Quit();
}

uint32_t *view_window_pixels(struct view_window *window, int *w, int *h, int *pitch)
{
    SDL_Surface *s = sdl.SDL_GetWindowSurface(window->window);
    if (s == NULL || s->format->BytesPerPixel != 4 || s->format->Rmask != 0xff0000 || s->format->Gmask != 0xff00 ||
        s->format->Bmask != 0xff)
        return NULL;
    *w = s->w;
    *h = s->h;
    *pitch = s->pitch / 4;
    return s->pixels;
}

void view_window_show(struct view_window *window)
{
    (void)sdl.SDL_UpdateWindowSurface(window->window);
}

/* ---- Events ------------------------------------------------------------------------------------------ */

static int key_of(SDL_Keycode sym)
{
    static const struct {
        SDL_Keycode sym;
        int key;
    } others[] = {
        { SDLK_LEFT, VIEW_KEY_LEFT },   { SDLK_RIGHT, VIEW_KEY_RIGHT },     { SDLK_UP, VIEW_KEY_UP },
        { SDLK_DOWN, VIEW_KEY_DOWN },   { SDLK_F1, VIEW_KEY_F1 },           { SDLK_F5, VIEW_KEY_F5 },
        { SDLK_KP_PLUS, '+' },          { SDLK_KP_MINUS, '-' },             { SDLK_EQUALS, '+' },
        { SDLK_ESCAPE, VIEW_KEY_ESCAPE }, { SDLK_BACKSPACE, VIEW_KEY_BACK },
    };
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++)
        if (others[i].sym == sym)
            return others[i].key;
    return sym > 0 && sym < 128 ? (int)sym : 0;
}

static void take_drag(struct view_event *event, const SDL_MouseMotionEvent *motion)
{
    SDL_Event next;
    event->kind = VIEW_EVENT_DRAG;
    event->shift = (motion->state & SDL_BUTTON_LMASK) == 0;
    event->dx = motion->xrel;
    event->dy = motion->yrel;
    while (sdl.SDL_PeepEvents(&next, 1, SDL_PEEKEVENT, SDL_FIRSTEVENT, SDL_LASTEVENT) == 1 &&
           next.type == SDL_MOUSEMOTION && next.motion.state == motion->state) {
        event->dx += next.motion.xrel;
        event->dy += next.motion.yrel;
        (void)sdl.SDL_PollEvent(&next);
    }
}

static void take(struct view_event *event, const SDL_Event *from)
{
    switch (from->type) {
    case SDL_QUIT:
        event->kind = VIEW_EVENT_QUIT;
        break;
    case SDL_WINDOWEVENT:
        if (from->window.event == SDL_WINDOWEVENT_SIZE_CHANGED || from->window.event == SDL_WINDOWEVENT_EXPOSED ||
            from->window.event == SDL_WINDOWEVENT_SHOWN)
            event->kind = VIEW_EVENT_DRAW;
        break;
    case SDL_KEYDOWN:
        event->key = key_of(from->key.keysym.sym);
        event->shift = (from->key.keysym.mod & KMOD_SHIFT) != 0;
        if (event->key != 0)
            event->kind = VIEW_EVENT_KEY;
        break;
    case SDL_MOUSEMOTION:
        if ((from->motion.state & (SDL_BUTTON_LMASK | SDL_BUTTON_MMASK | SDL_BUTTON_RMASK)) != 0)
            take_drag(event, &from->motion);
        break;
    case SDL_MOUSEWHEEL:
        event->kind = VIEW_EVENT_WHEEL;
        event->dy = from->wheel.y;
        break;
    default:
        break;
    }
}

/* Not by SDL_WaitEventTimeout: SDL 2.26 sends the window an event of its own there, and where the window is closed
 * before that arrives, the X server's error ends the program. */
enum view_event_kind view_window_next(struct view_window *window, struct view_event *event, int ms)
{
    static const struct view_event none;
    const uint32_t begun = sdl.SDL_GetTicks();
    SDL_Event from;
    (void)window;
    *event = none;
    for (;;) {
        while (event->kind == VIEW_EVENT_NONE && sdl.SDL_PollEvent(&from))
            take(event, &from);
        if (event->kind != VIEW_EVENT_NONE || sdl.SDL_GetTicks() - begun >= (uint32_t)ms)
            return event->kind;
        sdl.SDL_Delay(STEP_MS);
    }
}

#else /* a zsim that was built without SDL2's headers */

static int missing(void)
{
    return sim_refuse(NULL, 0, "zsim was built without windows: the package libsdl2-dev is missing; make view installs "
                               "it and builds zsim anew");
}

int view_window_open(struct view_window **out, const char *title, int w, int h, int least_w, int least_h)
{
    (void)title, (void)w, (void)h, (void)least_w, (void)least_h;
    *out = NULL;
    return missing();
}

void view_window_close(struct view_window *window)
{
    (void)window;
}

int view_desktop_size(int *w, int *h)
{
    *w = *h = 0;
    return missing();
}

enum view_event_kind view_window_next(struct view_window *window, struct view_event *event, int ms)
{
    static const struct view_event quit = { .kind = VIEW_EVENT_QUIT };
    (void)window, (void)ms;
    *event = quit;
    return VIEW_EVENT_QUIT;
}

uint32_t *view_window_pixels(struct view_window *window, int *w, int *h, int *pitch)
{
    (void)window, (void)w, (void)h, (void)pitch;
    return NULL;
}

void view_window_show(struct view_window *window)
{
    (void)window;
}

#endif
