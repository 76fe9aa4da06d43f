/* Memory for the buffer of assimp's OBJ importer: 16 MB at each file, however short, and each byte is set
 * (IOStreamBuffer, assimp 5.2). By pages of 4 KB that is 4,096 faults: `zsim render` of an OBJ took 95 ms, 55 of them
 * these. By pages of 2 MB, where the system has them for who asks, it takes 40.
 *
 * operator new and delete are the C++ library's for all else. One such block at a time: assimp has no more.
 *
 * SPDX-License-Identifier: MIT
 */
#define _GNU_SOURCE
#if defined __has_feature
#define CLANG_ASAN __has_feature(address_sanitizer) /* brings an operator new into the program itself */
#else
#define CLANG_ASAN 0
#endif
#if defined __linux__ && defined __LP64__ && !CLANG_ASAN
#include <dlfcn.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/mman.h>

#define BUFFER ((size_t)16 << 20) /* IOStreamBuffer's: 4096 * 4096 bytes */
#define PAGE ((size_t)2 << 20)

void *sim_new(size_t bytes) __asm__("_Znwm");
void sim_delete(void *block) __asm__("_ZdlPv");
void sim_delete_sized(void *block, size_t bytes) __asm__("_ZdlPvm");

static void *mapped, *buffer; /* buffer: what is in use of it; NULL: none */

static void *buffer_new(void)
{
    mapped = mmap(NULL, BUFFER + PAGE, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (mapped == MAP_FAILED)
        return NULL;
    buffer = (void *)(((uintptr_t)mapped + PAGE - 1) & ~(uintptr_t)(PAGE - 1));
    (void)madvise(buffer, BUFFER, MADV_HUGEPAGE);
#ifdef __SANITIZE_ADDRESS__ /* the bytes that say what of it may be read: 512 faults of 4,100 */
    const uintptr_t shadow = (((uintptr_t)buffer >> 3) + 0x7fff8000u) & ~(uintptr_t)(PAGE - 1);
    (void)madvise((void *)shadow, BUFFER / 8 + PAGE, MADV_HUGEPAGE);
#endif
    return buffer;
}

void *sim_new(size_t bytes)
{
    static void *(*library_new)(size_t);
    if (bytes == BUFFER && buffer == NULL && buffer_new() != NULL)
        return buffer;
    if (library_new == NULL)
        *(void **)&library_new = dlsym(RTLD_NEXT, "_Znwm");
    return library_new(bytes);
}

void sim_delete(void *block)
{
    static void (*library_delete)(void *);
    if (block != NULL && block == buffer) {
        buffer = NULL;
        (void)munmap(mapped, BUFFER + PAGE);
        return;
    }
    if (library_delete == NULL)
        *(void **)&library_delete = dlsym(RTLD_NEXT, "_ZdlPv");
    library_delete(block);
}

void sim_delete_sized(void *block, size_t bytes)
{
    (void)bytes;
    sim_delete(block);
}

#endif
