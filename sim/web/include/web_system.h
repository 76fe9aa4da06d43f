/* Included before every file of the simulator that goes into engine.wasm: what its C library does not declare. Nothing
 * there calls these.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef WEB_SYSTEM_H
#define WEB_SYSTEM_H

#define F_DUPFD_CLOEXEC 1030
int dup2(int from, int to);

#endif
