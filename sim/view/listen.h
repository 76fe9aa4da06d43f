/* What is said on standard error meanwhile, by this process and its children, and passed on there.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_VIEW_LISTEN_H
#define SIM_VIEW_LISTEN_H

#define VIEW_SAID_MAX 4608

void view_listen_begin(void);
/* What was said since, without the last line feed; cut to what there is room for. */
void view_listen_end(char said[VIEW_SAID_MAX]);

#endif
