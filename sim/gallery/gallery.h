/* `zsim gallery`: methods of hidden-surface removal side by side, on one page.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_GALLERY_H
#define SIM_GALLERY_H

/* argv: the arguments after "gallery". Return an exit code, enum sim_status. */
int sim_gallery(int argc, char **argv);

#endif
