/* Files that a model names: are they in its own folder, and regular?
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_OUTSIDE_H
#define SIM_OUTSIDE_H

/* Begin a model. outside: flag, all folders are its own. model_file stays borrowed. */
void sim_outside_begin(const char *model_file, int outside);

/* May a path be read that the model names? Not where it is outside the folder that the model's file is in, by its
 * name or because a link leads out; nor where there is something that is no regular file. The first path for which
 * that is so is kept, but for folders. A path where there is nothing may be read: that fails. */
int sim_outside_allows(const char *path);

/* Forget the path that was kept, since another file was found in its place. */
void sim_outside_forget(void);

/* SIM_OK where none is kept; else SIM_REFUSED, said why. */
int sim_outside_check(void);

#endif
