/* A scene's own C file, of the form that APP_SCENE of `make firmware` takes (firmware/app/my_scene.c): compiled into a
 * library, loaded, and from then on a demo scene that is named by its file.
 *
 * Its code runs in this program. What is loaded has drawn each frame of its animation once in a process of its own, so
 * that a crash or an endless loop is a sentence; it is not kept from anything else that a program may do.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_SCENE_FILE_H
#define SIM_SCENE_FILE_H

#include <stddef.h>

/* Is that the name of a scene's file, or the names of several with blanks between? They end in .c. */
int sim_scene_file_is(const char *name);

/* Compile and load it; where that fails, what was loaded before stays. One scene at a time is loaded. SIM_OK;
 * SIM_REFUSED, said why: the compiler's first line that speaks of an error. */
int sim_scene_file_load(const char *name);

/* The same where no file of that name is loaded yet; names of other scenes are left alone. */
int sim_scene_file_need(const char *name);

/* The files that it was last compiled from, its headers as well, the last one NULL. Valid until the next load. */
const char *const *sim_scene_file_sources(void);

#endif
