/* patch IN.elf OUT.elf SYMBOL[+BYTES] WORD...: a copy of a firmware with other values in a const of 32-bit words.
 *
 * SPDX-License-Identifier: MIT
 */
#include <elf.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static unsigned char file[1 << 24];
static long size;

static const void *at(unsigned long offset, unsigned long bytes)
{
    if (offset + bytes > (unsigned long)size) {
        fprintf(stderr, "patch: not an ELF file of 32 bits\n");
        exit(1);
    }
    return file + offset;
}

static const Elf32_Shdr *section(unsigned i)
{
    const Elf32_Ehdr *head = at(0, sizeof *head);
    return i < head->e_shnum ? at(head->e_shoff + i * sizeof(Elf32_Shdr), sizeof(Elf32_Shdr)) : NULL;
}

/* Where its symbol table says that it is; 0: it has none of that name. */
static unsigned long address_of(const char *name)
{
    const Elf32_Shdr *s;
    for (unsigned i = 0; (s = section(i)); i++) {
        if (s->sh_type != SHT_SYMTAB)
            continue;
        for (unsigned long o = 0; o < s->sh_size; o += sizeof(Elf32_Sym)) {
            const Elf32_Sym *symbol = at(s->sh_offset + o, sizeof *symbol);
            if (!strcmp(at(section(s->sh_link)->sh_offset + symbol->st_name, 1), name))
                return symbol->st_value;
        }
    }
    return 0;
}

static unsigned char *words_at(unsigned long address, unsigned long bytes)
{
    const Elf32_Shdr *s;
    for (unsigned i = 0; address && (s = section(i)); i++)
        if (s->sh_type == SHT_PROGBITS && s->sh_flags & SHF_ALLOC && s->sh_addr <= address &&
            address + bytes <= s->sh_addr + s->sh_size)
            return file + s->sh_offset + address - s->sh_addr;
    return NULL;
}

int main(int n, char **a)
{
    FILE *f = n > 4 ? fopen(a[1], "rb") : NULL;
    if (!f || (size = (long)fread(file, 1, sizeof file - 1, f)) <= 0)
        return fprintf(stderr, "patch: %s cannot be read\n", n > 4 ? a[1] : "IN.elf OUT.elf SYMBOL WORD...: what"), 1;
    fclose(f);
    char *plus = strchr(a[3], '+');
    if (plus)
        *plus++ = 0;
    const unsigned long address = address_of(a[3]), skip = plus ? strtoul(plus, NULL, 0) : 0;
    unsigned char *to = words_at(address ? address + skip : 0, 4ul * (unsigned)(n - 4));
    if (!to)
        return fprintf(stderr, "patch: %s: no %s of %d words\n", a[1], a[3], n - 4), 1;
    for (int i = 4; i < n; i++, to += 4) {
        const unsigned long word = strtoul(a[i], NULL, 0);
        for (int k = 0; k < 4; k++)
            to[k] = (unsigned char)(word >> 8 * k);
    }
    f = fopen(a[2], "wb");
    if (!f || fwrite(file, 1, (size_t)size, f) != (size_t)size || fclose(f))
        return fprintf(stderr, "patch: %s cannot be written\n", a[2]), 1;
    return 0;
}
