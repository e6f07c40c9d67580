/* SPDX-License-Identifier: MIT */
/* Frame ranges and numbered paths. */
#include "cli/common/frames.h"

#include <assert.h>
#include <stdio.h>
#include <string.h>

static const char *const range_help = "allowed are A, A-B, A-B:STEP and lists of these, such as 0-59 or 0,8,16";

static_assert(FRAME_LIMIT == 99999999, "FRAME_LIMIT_TEXT");

/* Reads a number at *text. Returns NULL, or what is wrong. */
static const char *read_number(const char **text, uint32_t *number)
{
    const char *p = *text;
    uint32_t value = 0;
    for (; *p >= '0' && *p <= '9'; p++) {
        value = value * 10 + (uint32_t)(*p - '0');
        if (value > FRAME_LIMIT)
            return "frames and steps go up to " FRAME_LIMIT_TEXT;
    }
    if (p == *text)
        return range_help;
    *text = p;
    *number = value;
    return NULL;
}

const char *frame_list_parse(frame_list *list, const char *text)
{
    list->count = 0;
    for (;;) {
        frame_range range = {.step = 1};
        const char *wrong = read_number(&text, &range.first);
        range.last = range.first;
        if (!wrong && *text == '-')
            text++, wrong = read_number(&text, &range.last);
        if (!wrong && *text == ':')
            text++, wrong = read_number(&text, &range.step);
        if (wrong)
            return wrong;
        if (range.step == 0)
            return "the step must be at least 1";
        if (range.last < range.first)
            return "a range must not run backwards";
        range.last -= (range.last - range.first) % range.step;
        if (list->count > 0 && range.first <= list->ranges[list->count - 1].last)
            return "frames must increase and none may come twice";
        if (list->count == FRAME_RANGES)
            return "at most 256 ranges are allowed";
        list->ranges[list->count++] = range;
        if (!*text)
            return NULL;
        if (*text++ != ',')
            return range_help;
    }
}

void frame_list_span(frame_list *list, uint32_t first, uint32_t last)
{
    list->count = 1;
    list->ranges[0] = (frame_range){first, last, 1};
}

static uint32_t range_length(const frame_range *range) { return (range->last - range->first) / range->step + 1; }

uint64_t frame_list_length(const frame_list *list)
{
    uint64_t length = 0;
    for (size_t i = 0; i < list->count; i++)
        length += range_length(&list->ranges[i]);
    return length;
}

void frame_list_shard(frame_list *list, const work_shard *shard)
{
    size_t kept = 0;
    uint64_t before = 0; /* frames of the ranges before this one */
    for (size_t i = 0; i < list->count && shard->count; i++) {
        frame_range r = list->ranges[i];
        const uint32_t length = range_length(&r), skip = (uint32_t)((shard->index + shard->count - before % shard->count) % shard->count);
        before += length;
        if (skip >= length)
            continue;
        const uint32_t more = (length - 1 - skip) / shard->count;
        r.first += skip * r.step;
        r.step = more ? r.step * shard->count : 1;
        r.last = r.first + more * r.step;
        list->ranges[kept++] = r;
    }
    if (shard->count)
        list->count = kept;
}

uint32_t frame_list_at(const frame_list *list, uint64_t index)
{
    size_t i = 0;
    while (i + 1 < list->count && index >= range_length(&list->ranges[i]))
        index -= range_length(&list->ranges[i++]);
    return list->ranges[i].first + (uint32_t)index * list->ranges[i].step;
}

void frame_list_print(const frame_list *list, char *text, size_t size)
{
    size_t used = 0;
    text[0] = 0;
    for (size_t i = 0; i < list->count; i++) {
        const frame_range *r = &list->ranges[i];
        char one[64];
        int length = snprintf(one, sizeof one, "%s%u", i ? "," : "", r->first);
        if (r->last > r->first)
            length += snprintf(one + length, sizeof one - (size_t)length, "-%u", r->last);
        if (r->last > r->first && r->step > 1)
            length += snprintf(one + length, sizeof one - (size_t)length, ":%u", r->step);
        if (used + (size_t)length + sizeof "…" > size) {
            snprintf(text + used, size - used, "…");
            return;
        }
        memcpy(text + used, one, (size_t)length + 1);
        used += (size_t)length;
    }
}

/* Reads a mark for the frame number at `p`. Returns its length; 0: there is none, -1: it is malformed. */
static int read_mark(const char *p, int *digits)
{
    if (*p == '#') {
        *digits = (int)strspn(p, "#");
        return *digits <= 9 ? *digits : -1;
    }
    if (*p != '%')
        return 0;
    if (p[1] == 'd') {
        *digits = 1;
        return 2;
    }
    if (p[1] == '0' && p[2] >= '1' && p[2] <= '9' && p[3] == 'd') {
        *digits = p[2] - '0';
        return 4;
    }
    return -1;
}

const char *frame_path_parse(frame_path *path, const char *text)
{
    const char *slash = strrchr(text, '/');
    const size_t folder = slash ? (size_t)(slash - text) + 1 : 0;
    if (!text[folder])
        return "it names no file";
    if (strlen(text) >= sizeof path->before || strlen(text + folder) >= sizeof path->after)
        return "the path is too long";
    path->numbered = false;
    memcpy(path->before, text, folder);
    char *out = path->before + folder;
    for (const char *p = text + folder; *p;) {
        if (p[0] == '%' && p[1] == '%') {
            *out++ = '%';
            p += 2;
            continue;
        }
        int digits = 0;
        const int mark = read_mark(p, &digits);
        if (mark < 0)
            return "the frame number is written %d, %04d or ####, a percent sign %%";
        if (mark == 0) {
            *out++ = *p++;
            continue;
        }
        if (path->numbered)
            return "only one frame number is allowed";
        path->numbered = true;
        path->digits = digits;
        *out = 0;
        out = path->after;
        p += mark;
    }
    *out = 0;
    if (!path->numbered)
        path->after[0] = 0;
    return NULL;
}

bool frame_path_folder_is_marked(const frame_path *path)
{
    const char *end = strrchr(path->before, '/');
    int digits;
    for (const char *p = path->before; end && p < end; p++)
        if (read_mark(p, &digits) > 0)
            return true;
    return false;
}

bool frame_path_print(const frame_path *path, uint32_t frame, char *text, size_t size)
{
    const int length =
        path->numbered ? snprintf(text, size, "%s%0*u%s", path->before, path->digits, frame, path->after) : snprintf(text, size, "%s", path->before);
    return length >= 0 && (size_t)length < size;
}
