/* SPDX-License-Identifier: MIT */
/* Checksums of files, and reading them back. */
#define _POSIX_C_SOURCE 200809L

#include "image/file_whole.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include "image/exr_names.h"
#include "image/metadata.h"
#include "image/picture_formats.h"
#include "image/sums_file.h"

enum { CHECK_DIGITS = sizeof FILE_CHECK_NONE - 1, BLOCK_BYTES = 1 << 16, EXR_HEADER_MOST = 4 << 20 };

/* The CRC-32 of the first `size` bytes. The digits at `zeros` count as "0" (UINT64_MAX: there are none). False if they cannot be read. */
static bool checksum(int descriptor, uint64_t size, uint64_t zeros, uint32_t *crc)
{
    unsigned char block[BLOCK_BYTES];
    *crc = (uint32_t)crc32(0, NULL, 0);
    for (uint64_t at = 0; at < size;) {
        const size_t wanted = size - at < BLOCK_BYTES ? (size_t)(size - at) : BLOCK_BYTES;
        const ssize_t got = pread(descriptor, block, wanted, (off_t)at);
        if (got < 0 && errno == EINTR)
            continue;
        if (got <= 0)
            return false;
        for (uint64_t i = 0; zeros != UINT64_MAX && i < CHECK_DIGITS; i++)
            if (zeros + i >= at && zeros + i < at + (uint64_t)got)
                block[zeros + i - at] = '0';
        *crc = (uint32_t)crc32(*crc, block, (uInt)got);
        at += (uint64_t)got;
    }
    return true;
}

file_status file_check_of(int descriptor, uint64_t size, const char *path, char digits[9], file_error *error)
{
    uint32_t crc;
    if (!checksum(descriptor, size, UINT64_MAX, &crc))
        return file_error_set(error, FILE_WRITE, "%s: cannot be read back", path);
    snprintf(digits, CHECK_DIGITS + 1, "%08x", crc);
    return FILE_OK;
}

/* ---- EXR ---- */

/* Where an EXR's own checksum stands; UINT64_MAX: nowhere. */
static uint64_t exr_check_place(int descriptor)
{
    char name[EXR_ATTRIBUTE_NAME_SIZE + 16];
    uint64_t place = UINT64_MAX;
    exr_attribute_name(name, FILE_CHECK_KEY);
    /* An attribute: its name, its type, its length in four bytes, its value. */
    const size_t name_length = strlen(name) + 1, length = name_length + sizeof "string" + 4;
    memcpy(name + name_length, "string", sizeof "string");
    memcpy(name + name_length + sizeof "string", "\x08\0\0", 4);
    char *header = malloc(EXR_HEADER_MOST);
    const ssize_t got = header != NULL ? pread(descriptor, header, EXR_HEADER_MOST, 0) : -1;
    for (const char *at = header; got > 0 && (size_t)(header + got - at) >= length + CHECK_DIGITS; at++) {
        at = memchr(at, name[0], (size_t)(header + got - at) - length - CHECK_DIGITS + 1);
        if (at == NULL)
            break;
        if (memcmp(at, name, length) == 0) {
            place = (uint64_t)(at - header) + length;
            break;
        }
    }
    free(header);
    return place;
}

file_status file_check_seal_exr(output_file *file, const char *path, file_error *error)
{
    const int descriptor = output_file_descriptor(file);
    const uint64_t place = exr_check_place(descriptor);
    struct stat info;
    uint32_t crc;
    char digits[CHECK_DIGITS + 1];
    if (place == UINT64_MAX)
        return FILE_OK;
    if (fstat(descriptor, &info) != 0 || !checksum(descriptor, (uint64_t)info.st_size, place, &crc))
        return file_error_set(error, FILE_WRITE, "%s: cannot be read back", path);
    snprintf(digits, sizeof digits, "%08x", crc);
    return output_file_write_at(file, place, digits, CHECK_DIGITS, error);
}

static bool is_exr_whole(int descriptor, uint64_t size)
{
    const uint64_t place = exr_check_place(descriptor);
    char digits[CHECK_DIGITS + 1], found[CHECK_DIGITS + 1] = "";
    uint32_t crc;
    if (place == UINT64_MAX || pread(descriptor, found, CHECK_DIGITS, (off_t)place) != CHECK_DIGITS || !checksum(descriptor, size, place, &crc))
        return false;
    snprintf(digits, sizeof digits, "%08x", crc);
    return strcmp(digits, found) == 0;
}

/* ---- PNG ---- */

static uint32_t big_endian(const unsigned char *b) { return (uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 | (uint32_t)b[2] << 8 | b[3]; }

/* Every chunk by its own checksum, up to the end mark, which ends the file. */
static bool is_png_whole(FILE *stream, uint64_t size)
{
    unsigned char head[8], block[BLOCK_BYTES];
    uint64_t left = size < 8 ? 0 : size - 8;
    if (fseek(stream, 8, SEEK_SET) != 0)
        return false;
    while (left >= 12 && fread(head, 1, sizeof head, stream) == sizeof head) {
        const uint32_t length = big_endian(head);
        uint32_t crc = (uint32_t)crc32(crc32(0, NULL, 0), head + 4, 4);
        if (length > left - 12)
            return false;
        for (uint32_t at = 0; at < length;) {
            const size_t wanted = length - at < BLOCK_BYTES ? length - at : BLOCK_BYTES;
            if (fread(block, 1, wanted, stream) != wanted)
                return false;
            crc = (uint32_t)crc32(crc, block, (uInt)wanted);
            at += (uint32_t)wanted;
        }
        if (fread(block, 1, 4, stream) != 4 || big_endian(block) != crc)
            return false;
        left -= 12 + (uint64_t)length;
        if (memcmp(head + 4, "IEND", 4) == 0)
            return left == 0;
    }
    return false;
}

/* ---- any ---- */

static file_status is_whole(const input_file *input, picture_format format, bool *whole, file_error *error)
{
    char digits[CHECK_DIGITS + 1];
    char *recorded = NULL;
    file_status status = FILE_OK;
    if (format == PICTURE_PNG) {
        *whole = is_png_whole(input->stream, input->size);
    } else if (format == PICTURE_EXR) {
        *whole = is_exr_whole(fileno(input->stream), input->size);
    } else if (format == PICTURE_SUMS) {
        *whole = sums_are_whole(input);
    } else {
        status = metadata_read(input->path, FILE_CHECK_KEY, &recorded, error);
        if (status == FILE_OK && recorded != NULL)
            status = file_check_of(fileno(input->stream), input->size, input->path, digits, error);
        *whole = status == FILE_OK && recorded != NULL && strcmp(recorded, digits) == 0;
        free(recorded);
    }
    return status == FILE_MEMORY ? status : FILE_OK;
}

/* Whether a file without metadata begins as its format does: it may be a damaged file of ours. */
static bool begins_like(const input_file *input, picture_format format)
{
    char start[10] = "";
    rewind(input->stream);
    const size_t length = fread(start, 1, sizeof start, input->stream);
    const picture_format named = picture_format_of(input->path);
    return input->size == 0 || (format != PICTURE_UNKNOWN && format == named) || (named == PICTURE_Y4M && length >= 9 && memcmp(start, "YUV4MPEG2", 9) == 0) ||
           ((named == PICTURE_MP4 || named == PICTURE_MOV) && length >= 8 && memcmp(start + 4, "ftyp", 4) == 0);
}

file_status file_state_read(const char *path, const char *key, const char *value, bool whole, file_state *state, file_error *error)
{
    input_file input = {0};
    char *recorded = NULL;
    *state = FILE_STATE_OTHER;
    file_status status = input_file_open(&input, path, error);
    if (status != FILE_OK)
        return status;
    const picture_format format = input_file_format(&input);
    status = metadata_read(path, key, &recorded, error);
    bool sound = true;
    if (status == FILE_OK && recorded != NULL && strcmp(recorded, value) == 0) {
        status = whole ? is_whole(&input, format, &sound, error) : FILE_OK;
        *state = sound ? FILE_STATE_SAME : FILE_STATE_DAMAGED;
    } else if (status != FILE_MEMORY && begins_like(&input, format)) {
        /* Files of other formats do not show whether they are damaged or of another program. */
        const bool damaged =
            (format == PICTURE_PNG && !is_png_whole(input.stream, input.size)) ||
            (format == PICTURE_EXR && exr_check_place(fileno(input.stream)) != UINT64_MAX && !is_exr_whole(fileno(input.stream), input.size)) ||
            (format == PICTURE_SUMS && !sums_are_whole(&input));
        *state = status == FILE_BAD || input.size == 0 || damaged ? FILE_STATE_DAMAGED : FILE_STATE_OTHER;
    }
    free(recorded);
    input_file_close(&input);
    return status == FILE_MEMORY || status == FILE_MISSING ? status : FILE_OK;
}
