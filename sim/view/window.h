/* A window on the desktop: pixels into it, keys and the mouse out of it. By SDL2, whose library is loaded when a window
 * is opened: no other command needs it.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_VIEW_WINDOW_H
#define SIM_VIEW_WINDOW_H

#include <stdint.h>

enum view_event_kind {
    VIEW_EVENT_NONE,  /* nothing within the time */
    VIEW_EVENT_QUIT,  /* the window's button */
    VIEW_EVENT_DRAW,  /* its size changed, or what is in it was lost */
    VIEW_EVENT_KEY,   /* key, shift */
    VIEW_EVENT_DRAG,  /* dx, dy; shift: with another button than the left one */
    VIEW_EVENT_WHEEL  /* dy: notches, up is more than 0 */
};

/* Keys are the characters on them, letters in lower case; others are these. */
enum view_key { VIEW_KEY_LEFT = 256, VIEW_KEY_RIGHT, VIEW_KEY_UP, VIEW_KEY_DOWN, VIEW_KEY_F1, VIEW_KEY_F5 };
#define VIEW_KEY_ESCAPE 27
#define VIEW_KEY_BACK 8

struct view_event {
    enum view_event_kind kind;
    int key, shift;
    int dx, dy; /* px */
};

struct view_window;

/* Open a window of w x h px, or, where the desktop is smaller, as large as that allows, but no smaller than least_w x
 * least_h. SIM_OK; SIM_REFUSED, said why. */
int view_window_open(struct view_window **out, const char *title, int w, int h, int least_w, int least_h);
void view_window_close(struct view_window *window);

/* What the desktop leaves for a window, px. Before the first is opened. SIM_OK; SIM_REFUSED, said why. */
int view_desktop_size(int *w, int *h);

/* The next event; waits for one up to `ms` milliseconds. Return its kind. Drags that have piled up are one. */
enum view_event_kind view_window_next(struct view_window *window, struct view_event *event, int ms);

/* Its pixels, w x h of 0x00rrggbb, row by row, *pitch pixels apart; until the next event. NULL: it has none now. */
uint32_t *view_window_pixels(struct view_window *window, int *w, int *h, int *pitch);
/* Show them. */
void view_window_show(struct view_window *window);

#endif
