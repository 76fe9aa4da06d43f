/* The panel of @NAME@: its size, and where strips of the picture go. */
#ifndef DISPLAY_H
#define DISPLAY_H

#include "zstrip.h"

#define W @W@
#define H @H@
#define ROWS @ROWS@ /* of a strip: memory, as TRIS is */
#define BUFFERS @BUFFERS@ /* 2: a strip is drawn while the one before it is sent */
#ifndef FRAMES
#define FRAMES 0 /* to draw; 0: for ever */
#endif

/* Start the board and the panel. Return 0, or an error for display_close. */
int display_open(void);
/* Sends strips, and puts the light on when the first picture is there. */
extern const struct zs_sink display_sink;
/* Say an error of display_open or the renderer, if there is one; the end of the program. */
void display_close(int err);

#endif
