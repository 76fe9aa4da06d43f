/* MP4 by ffmpeg, where that is installed: frames go to it as raw RGB from a file without a name.
 *
 * SPDX-License-Identifier: MIT
 */
#include "moving_picture.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "run_program.h"
#include "sim.h"

/* All frames; NULL: they could not be written. */
static FILE *raw_frames(const struct sim_moving *m)
{
    const size_t size = (size_t)m->width * m->height * 3u;
    FILE *f = tmpfile();
    for (uint32_t k = 0; f != NULL && k < m->n_frames; k++)
        (void)fwrite(m->frame[k], 1, size, f);
    if (f != NULL && (fflush(f) != 0 || ferror(f) || lseek(fileno(f), 0, SEEK_SET) != 0)) {
        (void)fclose(f);
        return NULL;
    }
    return f;
}

/* The first line of what it said, without its end. */
static void first_line(char *line, int room, FILE *said)
{
    rewind(said);
    if (fgets(line, room, said) == NULL)
        (void)snprintf(line, (size_t)room, "it says nothing");
    line[strcspn(line, "\n")] = '\0';
}

int sim_moving_mp4(const char *path, const char *name, const struct sim_moving *m)
{
    char size[32], rate[32], line[256];
    (void)snprintf(size, sizeof size, "%ux%u", m->width, m->height);
    (void)snprintf(rate, sizeof rate, "1000/%u", m->delay_ms);
    /* Half the colour resolution, which all players know, wants even sides: black is added. */
    const char *const words[] = { "ffmpeg", "-nostdin", "-loglevel", "error", "-f", "rawvideo", "-pix_fmt", "rgb24",
                                  "-s", size, "-framerate", rate, "-i", "/dev/fd/0",
                                  "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p",
                                  "-movflags", "+faststart", "-f", "mp4", "-y", path, NULL };
    FILE *frames = raw_frames(m), *said = tmpfile();
    posix_spawn_file_actions_t files;
    int result = SIM_OK;
    if (frames == NULL || said == NULL) {
        result = sim_refuse(name, 0, "cannot be written: there is no room for its frames in TMPDIR");
    } else {
        (void)posix_spawn_file_actions_init(&files);
        (void)posix_spawn_file_actions_adddup2(&files, fileno(frames), STDIN_FILENO);
        (void)posix_spawn_file_actions_adddup2(&files, fileno(said), STDERR_FILENO);
        const int status = sim_run_program(words, &files);
        if (status < 0)
            result = sim_refuse(name, 0, "is written by ffmpeg, which is not installed; name it .gif or .png instead");
        else if (status != 0) {
            first_line(line, sizeof line, said);
            result = sim_refuse(name, 0, "cannot be written by ffmpeg: %s", line);
        }
    }
    if (frames != NULL)
        (void)fclose(frames);
    if (said != NULL)
        (void)fclose(said);
    return result;
}
