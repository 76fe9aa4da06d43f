/* Where LeakSanitizer looks for pointers
 *
 * In every variable of the program and its libraries but the sanitizers' own: 12 MB of tables without a pointer into
 * the program's memory, which the search at the end would touch page by page. That is 50 of the 70 ms of a program that
 * does nothing, where a page fault is dear.
 *
 * A region that LeakSanitizer is told of costs it a look at the process's whole map of memory. So the program's own
 * variables are one, in which what libraries' variables hold is copied at exit, libraries that were loaded meanwhile
 * included.
 *
 * Linked by -u leak_roots (tests.mk).
 * SPDX-License-Identifier: MIT */
#define _GNU_SOURCE
#include <link.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

void leak_roots(void);
const char *__lsan_default_options(void);

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>

const char *__lsan_default_options(void) { return "use_globals=0"; }

static uintptr_t copied[1 << 13]; /* what may be pointers in libraries' variables */
static size_t n_copied;

/* Whether there was room */
__attribute__((no_sanitize("address"))) static int copy(const uintptr_t *from, const uintptr_t *end)
{
    for (; from < end; from++)
        if (*from >= 4096) {
            if (n_copied == sizeof copied / sizeof *copied)
                return 0;
            copied[n_copied++] = *from;
        }
    return 1;
}

static int roots_of(struct dl_phdr_info *library, size_t size, void *arg)
{
    const ElfW(Phdr) *sealed = NULL; /* what is read-only from the program's start holds nothing that it allocated */
    (void)size, (void)arg;
    if (strstr(library->dlpi_name, "libasan.so") || strstr(library->dlpi_name, "libubsan.so"))
        return 0;
    for (int i = 0; i < library->dlpi_phnum; i++)
        if (library->dlpi_phdr[i].p_type == PT_GNU_RELRO)
            sealed = &library->dlpi_phdr[i];
    for (int i = 0; i < library->dlpi_phnum; i++) {
        const ElfW(Phdr) *segment = &library->dlpi_phdr[i];
        if (segment->p_type != PT_LOAD || !(segment->p_flags & PF_W))
            continue;
        uintptr_t from = library->dlpi_addr + segment->p_vaddr;
        const uintptr_t end = from + segment->p_memsz;
        if (sealed && sealed->p_vaddr == segment->p_vaddr)
            from += sealed->p_memsz;
        from = (from + sizeof from - 1) & ~(sizeof from - 1);
        if (!*library->dlpi_name || !copy((const uintptr_t *)from, (const uintptr_t *)end))
            __lsan_register_root_region((const void *)from, end - from);
    }
    return 0;
}

void leak_roots(void) { dl_iterate_phdr(roots_of, NULL); }

/* The search is registered before any constructor of the program, so it comes after what is registered here. */
__attribute__((constructor)) static void at_exit(void) { atexit(leak_roots); }
#else
void leak_roots(void) {}
#endif
