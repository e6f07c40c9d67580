/* SPDX-License-Identifier: MIT
 *
 * Runs a fuzz target where the compiler has no libFuzzer: its seeds, then RUNS (2000) inputs made from them, the same ones every time.
 *
 *     fuzz_TARGET FOLDER [RUNS [SEED]]
 */
#include <dirent.h>
#include <unistd.h>

#include "fuzz.h"
#include "unit/random_numbers.h"

enum { MOST_SEEDS = 4096, MOST_BYTES = 1 << 16 };

typedef struct seed {
    uint8_t *bytes;
    size_t size;
} seed;

typedef struct seeds {
    seed items[MOST_SEEDS];
    size_t count;
} seeds;

static uint32_t below(random_state *r, size_t limit) { return limit > 0 ? (uint32_t)(random_unit(r) * (double)limit) : 0; }

static void load(seeds *s, const char *folder)
{
    DIR *directory = opendir(folder);
    fuzz_require(directory != NULL, "no such folder");
    for (struct dirent *entry; (entry = readdir(directory)) != NULL && s->count < MOST_SEEDS;) {
        char path[4096];
        snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
        FILE *file = entry->d_name[0] != '.' ? fopen(path, "rb") : NULL;
        if (file == NULL)
            continue;
        seed *item = &s->items[s->count++];
        item->bytes = malloc(MOST_BYTES);
        fuzz_require(item->bytes != NULL, "out of memory");
        item->size = fread(item->bytes, 1, MOST_BYTES, file);
        fclose(file);
    }
    closedir(directory);
    fuzz_require(s->count > 0, "no seeds");
}

static int by_bytes(const void *left, const void *right)
{
    const seed *a = left, *b = right;
    const int order = memcmp(a->bytes, b->bytes, a->size < b->size ? a->size : b->size);
    return order != 0 ? order : (a->size > b->size) - (a->size < b->size);
}

/* Puts `length` bytes in place of `removed` ones at `at`. */
static void replace(uint8_t *bytes, size_t *size, size_t at, size_t removed, const void *with, size_t length)
{
    removed = removed < *size - at ? removed : *size - at;
    if (*size - removed + length > MOST_BYTES)
        return;
    memmove(bytes + at + length, bytes + at + removed, *size - at - removed);
    memcpy(bytes + at, with, length);
    *size = *size - removed + length;
}

static void mutate(random_state *r, const seeds *s, uint8_t *bytes, size_t *size)
{
    static const char *const words[] = {"0",      "-1",   "1e308", "nan", ".inf",       "4294967295", "4294967296", "9223372036854775808",
                                        "1e-320", "\n",   "{",     "}",   "[",          "]",          ":",          "\"",
                                        "\\",     "\t",   "%",     "-",   "null",       "true",       ",",          "#",
                                        "..",     "\xff", "99999", "''",  "2147483648", "0.5"};
    uint8_t other[64];
    const size_t at = below(r, *size + 1), span = 1 + below(r, 32);
    switch (below(r, 7)) {
    case 0:
        if (at < *size)
            bytes[at] ^= (uint8_t)(1u << below(r, 8));
        break;
    case 1:
        if (at < *size)
            bytes[at] = (uint8_t)below(r, 256);
        break;
    case 2:
        replace(bytes, size, at, span, other, 0);
        break;
    case 3: {
        const char *word = words[below(r, sizeof words / sizeof *words)];
        replace(bytes, size, at, below(r, 8), word, strlen(word));
        break;
    }
    case 4: {
        const seed *from = &s->items[below(r, s->count)];
        const size_t start = below(r, from->size), length = from->size - start < sizeof other ? from->size - start : sizeof other;
        memcpy(other, from->bytes + start, length);
        replace(bytes, size, at, 0, other, length);
        break;
    }
    case 5: {
        const size_t length = *size - at < span ? *size - at : span;
        memcpy(other, bytes + at, length);
        replace(bytes, size, below(r, *size + 1), 0, other, length);
        break;
    }
    default:
        *size = below(r, 4) == 0 ? at : *size;
        break;
    }
}

/* Copies the input to memory of exactly its size, so that a sanitizer sees each byte read beyond it. */
static void run(const uint8_t *bytes, size_t size)
{
    uint8_t *copy = malloc(size > 0 ? size : 1);
    fuzz_require(copy != NULL, "out of memory");
    memcpy(copy, bytes, size);
    LLVMFuzzerTestOneInput(copy, size);
    free(copy);
}

int main(int argc, char **argv)
{
    static seeds s;
    static uint8_t bytes[MOST_BYTES];
    fuzz_require(argc >= 2, "no folder of seeds is given");
    load(&s, argv[1]);
    qsort(s.items, s.count, sizeof *s.items, by_bytes);
    const unsigned long runs = argc > 2 ? strtoul(argv[2], NULL, 10) : 2000;
    random_state r = {argc > 3 ? strtoull(argv[3], NULL, 10) : 1};
    for (size_t i = 0; i < s.count; i++)
        run(s.items[i].bytes, s.items[i].size);
    for (unsigned long i = 0; i < runs; i++) {
        const seed *from = &s.items[below(&r, s.count)];
        size_t size = from->size;
        memcpy(bytes, from->bytes, size);
        for (uint32_t k = 1 + below(&r, 6); k > 0; k--)
            mutate(&r, &s, bytes, &size);
        FILE *last = fopen("last_input", "wb");
        if (last != NULL) {
            fwrite(bytes, 1, size, last);
            fclose(last);
        }
        run(bytes, size);
    }
    unlink("last_input");
    for (size_t i = 0; i < s.count; i++)
        free(s.items[i].bytes);
    printf("%zu seeds and %lu inputs from them: no failure\n", s.count, runs);
    return 0;
}
