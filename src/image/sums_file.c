/* SPDX-License-Identifier: MIT */
/* Writer and reader of files of exact sums. */
#define _POSIX_C_SOURCE 200809L

#include "image/sums_file.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#include "base/exact_sum.h"
#include "image/metadata_json.h"

_Static_assert((int)SUMS_WORDS == 2 * (int)EXACT_COUNT, "two words a sum");

static const char magic[] = SUMS_MAGIC;
enum { MAGIC_BYTES = sizeof magic - 1, TEXT_MOST = 1 << 20, RANGE_TEXT = 42, ENTRIES_MOST = 64, BLOCK = 1 << 16 };

/* ---- ranges ---- */

sums_joined sums_ranges_join(sums_ranges *list, sums_range more, sums_range *overlap)
{
    size_t at = 0;
    while (at < list->count && list->items[at].first + list->items[at].count < more.first)
        at++;
    /* Those from `at` to `end` touch the new one, or overlap it. */
    size_t end = at;
    sums_range joined = more;
    for (; end < list->count && list->items[end].first <= more.first + more.count; end++) {
        const sums_range *r = &list->items[end];
        const uint64_t from = r->first > more.first ? r->first : more.first;
        const uint64_t to = r->first + r->count < more.first + more.count ? r->first + r->count : more.first + more.count;
        if (from < to) {
            *overlap = (sums_range){from, to - from};
            return SUMS_OVERLAP;
        }
        joined.first = r->first < joined.first ? r->first : joined.first;
        joined.count += r->count;
    }
    if (end == at && list->count == SUMS_RANGES_MOST)
        return SUMS_TOO_MANY;
    memmove(&list->items[at + 1], &list->items[end], (list->count - end) * sizeof list->items[0]);
    list->items[at] = joined;
    list->count = list->count - (end - at) + 1;
    return SUMS_JOINED;
}

sums_range sums_ranges_gap(const sums_ranges *list, sums_range all)
{
    const uint64_t last = all.first + all.count;
    uint64_t at = all.first;
    for (size_t i = 0; i < list->count; i++) {
        const sums_range *r = &list->items[i];
        if (r->first > at)
            return (sums_range){at, (r->first < last ? r->first : last) - at};
        at = r->first + r->count > at ? r->first + r->count : at;
        if (at >= last)
            return (sums_range){0};
    }
    return (sums_range){at, last - at};
}

/* "0,128 256,64"; the caller frees it. NULL: out of memory. */
static char *print_ranges(const sums_ranges *list)
{
    char *text = malloc(list->count * RANGE_TEXT + 1);
    size_t length = 0;
    if (!text)
        return NULL;
    text[0] = '\0';
    for (size_t i = 0; i < list->count; i++)
        length += (size_t)snprintf(text + length, RANGE_TEXT, "%s%" PRIu64 ",%" PRIu64, i ? " " : "", list->items[i].first, list->items[i].count);
    return text;
}

/* Digits alone, to below 2^62, so that the end of a range does not wrap around. */
static bool read_number(const char **text, uint64_t *number)
{
    const size_t digits = strspn(*text, "0123456789");
    if (digits < 1 || digits > 18)
        return false;
    *number = strtoull(*text, NULL, 10);
    *text += digits;
    return true;
}

static bool read_ranges(const char *text, sums_ranges *list)
{
    list->count = 0;
    while (text) {
        sums_range range, overlap;
        if (!read_number(&text, &range.first) || *text++ != ',' || !read_number(&text, &range.count) || range.count == 0 ||
            sums_ranges_join(list, range, &overlap) != SUMS_JOINED)
            return false;
        if (*text == '\0')
            return true;
        if (*text++ != ' ')
            return false;
    }
    return false;
}

static bool read_pixels(const char *text, uint32_t *width, uint32_t *height)
{
    uint64_t w, h;
    if (!text || !read_number(&text, &w) || *text++ != 'x' || !read_number(&text, &h) || *text || w < 1 || h < 1 || w > PICTURE_SIDE_MAX ||
        h > PICTURE_SIDE_MAX)
        return false;
    *width = (uint32_t)w;
    *height = (uint32_t)h;
    return true;
}

static void store_u32(unsigned char bytes[4], uint32_t value)
{
    for (int i = 0; i < 4; i++)
        bytes[i] = (unsigned char)(value >> (8 * i));
}

static uint32_t load_u32(const unsigned char bytes[4])
{
    return (uint32_t)bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;
}

/* ---- writing ---- */

typedef struct sums_writer {
    output_file *file;
    uint32_t crc;
} sums_writer;

static file_status put(sums_writer *writer, const void *bytes, size_t size, file_error *error)
{
    writer->crc = (uint32_t)crc32(writer->crc, bytes, (uInt)size);
    return output_file_write(writer->file, bytes, size, error);
}

/* One word of a row of pixels; `packed` holds 1 + 8 · width bytes. */
static file_status put_words(sums_writer *writer, const uint64_t *words, uint32_t width, unsigned char *packed, file_error *error)
{
    uint64_t used = 0;
    for (uint32_t x = 0; x < width; x++)
        used |= words[(size_t)x * SUMS_WORDS];
    const int from = used ? __builtin_ctzll(used) / 8 : 0, bytes = used ? 8 - __builtin_clzll(used) / 8 - from : 0;
    unsigned char *at = packed;
    *at++ = (unsigned char)(from << 4 | bytes);
    for (uint32_t x = 0; x < width && bytes > 0; x++) {
        const uint64_t word = words[(size_t)x * SUMS_WORDS] >> (8 * from);
        for (int i = 0; i < bytes; i++)
            *at++ = (unsigned char)(word >> (8 * i));
    }
    return put(writer, packed, (size_t)(at - packed), error);
}

static file_status put_head(sums_writer *writer, uint32_t width, uint32_t height, const sums_ranges *ranges, const metadata_list *metadata, const char *path,
                            file_error *error)
{
    char pixels[32];
    char *text = NULL, *list = print_ranges(ranges);
    metadata_entry entries[ENTRIES_MOST];
    const size_t count = metadata ? metadata->count : 0;
    file_status status = FILE_MEMORY;
    if (!list || count > ENTRIES_MOST - 2)
        goto done;
    if (count > 0)
        memcpy(entries, metadata->entries, count * sizeof entries[0]);
    snprintf(pixels, sizeof pixels, "%ux%u", width, height);
    entries[count] = (metadata_entry){"pixels", pixels};
    entries[count + 1] = (metadata_entry){"ranges", list};
    const metadata_list all = {entries, count + 2};
    status = metadata_check(&all, error);
    if (status != FILE_OK)
        goto done;
    text = metadata_json_text(&all);
    status = FILE_MEMORY;
    if (!text)
        goto done;
    unsigned char length[4];
    store_u32(length, (uint32_t)strlen(text));
    status = put(writer, magic, MAGIC_BYTES, error);
    if (status == FILE_OK)
        status = put(writer, length, sizeof length, error);
    if (status == FILE_OK)
        status = put(writer, text, strlen(text), error);
done:
    free(list);
    free(text);
    return status == FILE_MEMORY ? file_error_errno(error, FILE_MEMORY, path, NULL, ENOMEM) : status;
}

file_status sums_write(const char *path, uint32_t width, uint32_t height, const uint64_t *sums, const sums_ranges *ranges, const metadata_list *metadata,
                       const output_options *options, file_error *error)
{
    sums_writer writer = {.crc = (uint32_t)crc32(0, NULL, 0)};
    file_status status = picture_check_size(path, width, height, error);
    if (status != FILE_OK)
        return status;
    unsigned char *packed = malloc(1 + (size_t)width * 8);
    if (!packed)
        return file_error_errno(error, FILE_MEMORY, path, NULL, ENOMEM);
    status = output_file_open(&writer.file, path, options, error);
    if (status == FILE_OK)
        status = put_head(&writer, width, height, ranges, metadata, path, error);
    for (uint32_t y = 0; y < height && status == FILE_OK; y++)
        for (size_t word = 0; word < SUMS_WORDS && status == FILE_OK; word++)
            status = put_words(&writer, sums + (size_t)y * width * SUMS_WORDS + word, width, packed, error);
    free(packed);
    unsigned char crc[4];
    store_u32(crc, writer.crc);
    if (status == FILE_OK)
        status = output_file_write(writer.file, crc, sizeof crc, error);
    if (status == FILE_OK)
        return output_file_finish(writer.file, error);
    output_file_abort(writer.file);
    return status;
}

/* ---- reading ---- */

static file_status unsound(const input_file *input, const char *why, file_error *error)
{
    return file_error_set(error, FILE_BAD, "%s: is not a sound file of sums: %s", input->path, why);
}

static bool get(sums_file *file, void *bytes, size_t size)
{
    if (fread(bytes, 1, size, file->input.stream) != size)
        return false;
    file->crc = (uint32_t)crc32(file->crc, bytes, (uInt)size);
    return true;
}

/* All before the first row, of a file that is open at its start. */
static file_status read_head(sums_file *file, file_error *error)
{
    char start[MAGIC_BYTES];
    unsigned char length[4];
    const input_file *input = &file->input;
    file->crc = (uint32_t)crc32(0, NULL, 0);
    if (!get(file, start, MAGIC_BYTES) || memcmp(start, magic, MAGIC_BYTES) != 0)
        return file_error_set(error, FILE_BAD, "%s: is not a file of sums, as mangata render writes them into .sums", input->path);
    if (!get(file, length, sizeof length))
        return unsound(input, "it ends too early", error);
    const uint32_t size = load_u32(length);
    if (size > TEXT_MOST || size > input->size)
        return unsound(input, "its metadata are longer than the file or 1 MiB", error);
    char *text = malloc((size_t)size + 1);
    if (!text)
        return file_error_errno(error, FILE_MEMORY, input->path, NULL, ENOMEM);
    if (!get(file, text, size)) {
        free(text);
        return unsound(input, "it ends too early", error);
    }
    json_error_t json_error;
    file->metadata = json_loadb(text, size, JSON_REJECT_DUPLICATES, &json_error);
    free(text);
    if (!json_is_object(file->metadata))
        return unsound(input, "its metadata are not a JSON object", error);
    if (!read_pixels(sums_metadata(file, "pixels"), &file->width, &file->height))
        return unsound(input, "pixels is missing or not a size such as 64x36", error);
    if (!read_ranges(sums_metadata(file, "ranges"), &file->ranges))
        return unsound(input, "ranges is missing or not a list of samples such as 0,128 256,64", error);
    return FILE_OK;
}

file_status sums_open(sums_file *file, const char *path, file_error *error)
{
    memset(file, 0, sizeof *file);
    file_status status = input_file_open(&file->input, path, error);
    if (status == FILE_OK)
        status = read_head(file, error);
    if (status != FILE_OK)
        sums_close(file);
    return status;
}

void sums_close(sums_file *file)
{
    input_file_close(&file->input);
    json_decref(file->metadata);
    memset(file, 0, sizeof *file);
}

bool sums_are_begun(const char *path)
{
    char start[MAGIC_BYTES];
    input_file input;
    file_error error;
    if (input_file_open(&input, path, &error) != FILE_OK)
        return false;
    const size_t got = fread(start, 1, MAGIC_BYTES, input.stream);
    const bool begun = !ferror(input.stream) && memcmp(start, magic, got) == 0;
    input_file_close(&input);
    return begun;
}

const char *sums_metadata(const sums_file *file, const char *key) { return json_string_value(json_object_get(file->metadata, key)); }

/* One word of a row of pixels. False: the file ends, or holds what the writer does not write. */
static bool add_words(sums_file *file, unsigned char *packed, uint64_t *words)
{
    unsigned char code;
    if (!get(file, &code, 1))
        return false;
    const unsigned from = code >> 4, bytes = code & 15;
    if (from + bytes > 8 || !get(file, packed, (size_t)file->width * bytes))
        return false;
    for (uint32_t x = 0; x < file->width && bytes > 0; x++) {
        uint64_t word = 0;
        for (unsigned i = 0; i < bytes; i++)
            word |= (uint64_t)packed[(size_t)x * bytes + i] << (8 * i);
        words[(size_t)x * SUMS_WORDS] = word << (8 * from);
    }
    return true;
}

file_status sums_add(sums_file *file, uint32_t width, uint32_t height, uint64_t *sums, file_error *error)
{
    if (file->width != width || file->height != height)
        return file_error_set(error, FILE_BAD, "%s: it has %ux%u pixels instead of %ux%u", file->input.path, file->width, file->height, width, height);
    const size_t row = (size_t)file->width * SUMS_WORDS;
    unsigned char *packed = malloc((size_t)file->width * 8), crc[4];
    uint64_t *words = malloc(row * sizeof *words);
    file_status status = packed && words ? FILE_OK : file_error_errno(error, FILE_MEMORY, file->input.path, NULL, ENOMEM);
    uint64_t samples = 0;
    for (size_t i = 0; i < file->ranges.count; i++)
        samples += file->ranges.items[i].count;
    for (uint32_t y = 0; y < file->height && status == FILE_OK; y++, sums += row) {
        memset(words, 0, row * sizeof *words);
        for (size_t word = 0; word < SUMS_WORDS && status == FILE_OK; word++)
            if (!add_words(file, packed, words + word))
                status = unsound(&file->input, "its rows are damaged or it ends too early", error);
        for (size_t i = 0; i < row && status == FILE_OK; i += SUMS_WORDS)
            if (!exact_sums_fit(words + i, samples))
                status = unsound(&file->input, "it holds sums that its samples cannot have", error);
        for (size_t i = 0; i < row; i += 2)
            exact_add(sums + i, exact_load(words + i));
    }
    free(packed);
    free(words);
    const uint32_t wanted = file->crc;
    if (status == FILE_OK && (fread(crc, 1, sizeof crc, file->input.stream) != sizeof crc || load_u32(crc) != wanted || getc(file->input.stream) != EOF))
        status = unsound(&file->input, "its checksum is another", error);
    return status;
}

bool sums_are_whole(const input_file *input)
{
    unsigned char block[BLOCK], recorded[4];
    uint32_t crc = (uint32_t)crc32(0, NULL, 0);
    if (input->size < sizeof recorded || fseek(input->stream, 0, SEEK_SET) != 0)
        return false;
    for (uint64_t left = input->size - sizeof recorded; left > 0;) {
        const size_t got = fread(block, 1, left < BLOCK ? (size_t)left : BLOCK, input->stream);
        if (got == 0)
            return false;
        crc = (uint32_t)crc32(crc, block, (uInt)got);
        left -= got;
    }
    return fread(recorded, 1, sizeof recorded, input->stream) == sizeof recorded && load_u32(recorded) == crc;
}

file_status sums_metadata_read(const input_file *input, const char *key, char **value, file_error *error)
{
    sums_file file;
    memset(&file, 0, sizeof file);
    file.input = *input;
    file_status status = read_head(&file, error);
    const char *found = status == FILE_OK ? sums_metadata(&file, key) : NULL;
    if (found && !(*value = strdup(found)))
        status = file_error_errno(error, FILE_MEMORY, input->path, NULL, ENOMEM);
    json_decref(file.metadata);
    return status;
}
