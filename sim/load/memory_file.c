/* See memory_file.h.
 *
 * SPDX-License-Identifier: MIT
 */
#include "memory_file.h"

#include <stdlib.h>
#include <string.h>

#include "sim.h"

struct stream {
    struct aiFile file;
    const char *text;
    size_t at, bytes;
    char *own; /* the text, where it goes with the stream; else NULL */
};

static size_t stream_read(struct aiFile *file, char *out, size_t size, size_t n)
{
    struct stream *s = (struct stream *)file->UserData;
    const size_t left = size > 0 ? (s->bytes - s->at) / size : 0;
    n = n < left ? n : left;
    memcpy(out, s->text + s->at, n * size);
    s->at += n * size;
    return n;
}

static size_t stream_write(struct aiFile *file, const char *in, size_t size, size_t n)
{
    (void)file;
    (void)in;
    (void)size;
    (void)n;
    return 0;
}

static size_t stream_tell(struct aiFile *file)
{
    return ((struct stream *)file->UserData)->at;
}

static size_t stream_size(struct aiFile *file)
{
    return ((struct stream *)file->UserData)->bytes;
}

static enum aiReturn stream_seek(struct aiFile *file, size_t offset, enum aiOrigin origin)
{
    struct stream *s = (struct stream *)file->UserData;
    const size_t base = origin == aiOrigin_SET ? 0 : origin == aiOrigin_END ? s->bytes : s->at;
    const size_t to = base + offset; /* an offset below 0 wraps, and so does the sum */
    if (to > s->bytes)
        return aiReturn_FAILURE;
    s->at = to;
    return aiReturn_SUCCESS;
}

static void stream_flush(struct aiFile *file)
{
    (void)file;
}

struct aiFile *sim_memory_file(const char *text, size_t bytes, char *own)
{
    struct stream *s = sim_alloc(1, sizeof *s);
    *s = (struct stream){ .text = text, .bytes = bytes, .own = own };
    s->file = (struct aiFile){ stream_read, stream_write, stream_tell, stream_size,
                               stream_seek, stream_flush, (aiUserData)s };
    return &s->file;
}

void sim_memory_file_close(struct aiFile *file)
{
    struct stream *s = (struct stream *)file->UserData;
    free(s->own);
    free(s);
}
