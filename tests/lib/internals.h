/* Every stage's header, for tests that look inside.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef INTERNALS_H
#define INTERNALS_H

#include "core/assemble.h"
#include "core/bin.h"
#include "core/clip.h"
#include "core/cull.h"
#include "core/damage.h"
#include "core/depth.h"
#include "core/edges.h"
#include "core/fast.h"
#include "core/frame.h"
#include "core/fx.h"
#include "core/job.h"
#include "core/plane.h"
#include "core/raster.h"
#include "core/rows.h"
#include "zs_shader.h"
#include "core/view.h"
#include "core/walk.h"
#include "core/xform.h"
#include "fast/screen.h"
#include "fast/tiles.h"

#endif
