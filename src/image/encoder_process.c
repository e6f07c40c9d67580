/* SPDX-License-Identifier: MIT */
/* Running ffmpeg: start, feed, finish, kill. */
#define _GNU_SOURCE /* memfd_create, asprintf */

#include "image/encoder_process.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "base/child_process.h"
#include "image/picture.h"

enum { WAIT_STEP_MS = 100, FIXED_ARGUMENTS = 96 };

struct encoder_process {
    pid_t pid;    /* 0: reaped */
    int input;    /* our end of the socket that is ffmpeg's stdin */
    int messages; /* memory file that is ffmpeg's stderr */
    const char *path;
    const output_file *file;
};

/* ---- finding and starting ---- */

/* First executable regular file of that name on the PATH; empty parts (the current folder) are passed over. NULL: none. */
static char *find_program(const char *name)
{
    const char *paths = getenv("PATH");
    if (!paths)
        paths = "/usr/local/bin:/usr/bin:/bin";
    while (*paths) {
        size_t length = strcspn(paths, ":");
        char *candidate = NULL;
        struct stat info;
        if (length > 0 && asprintf(&candidate, "%.*s/%s", (int)length, paths, name) >= 0) {
            if (stat(candidate, &info) == 0 && S_ISREG(info.st_mode) && access(candidate, X_OK) == 0)
                return candidate;
            free(candidate);
        }
        paths += length + (paths[length] == ':');
    }
    return NULL;
}

/* A list of arguments that owns its strings; `failed` once any allocation did. */
typedef struct argument_list {
    char **items;
    size_t count, capacity;
    bool failed;
} argument_list;

static void add_argument(argument_list *list, char *owned)
{
    if (!owned || list->count + 1 >= list->capacity) {
        free(owned);
        list->failed = true;
        return;
    }
    list->items[list->count++] = owned;
}

static void free_arguments(argument_list *list)
{
    for (size_t i = 0; i < list->count; i++)
        free(list->items[i]);
    free(list->items);
    *list = (argument_list){0};
}

static char *format_text(const char *format, ...) __attribute__((format(printf, 1, 2)));
static char *format_text(const char *format, ...)
{
    char *text = NULL;
    va_list arguments;
    va_start(arguments, format);
    if (vasprintf(&text, format, arguments) < 0)
        text = NULL;
    va_end(arguments);
    return text;
}

/* ffmpeg's arguments for an encoder. Encoders' results depend on the number of threads, so that is fixed. */
typedef struct encoder_words {
    const char *input;     /* pixel format of the frames */
    const char *words[24]; /* ended by NULL; "CRF" is replaced by the quality */
} encoder_words;

static const encoder_words encoders[] = {
    [VIDEO_CODEC_H264] = {"yuv420p",
                          {"-c:v", "libx264", "-preset", "fast", "-crf", "CRF", "-pix_fmt", "yuv420p", "-threads", "4", "-x264-params", "lookahead-threads=1",
                           NULL}},
    [VIDEO_CODEC_HEVC] = {"yuv420p",
                          {"-c:v", "libx265", "-preset", "fast", "-crf", "CRF", "-pix_fmt", "yuv420p10le", "-tag:v", "hvc1", "-x265-params",
                           "log-level=error:info=0:pools=4:frame-threads=1", NULL}},
    [VIDEO_CODEC_PRORES] = {"yuv444p", {"-c:v", "prores_ks", "-profile:v", "hq", "-vendor", "apl0", "-pix_fmt", "yuv422p10le", "-threads", "4", NULL}},
};

static void add_words(argument_list *list, const char *const *words, int crf)
{
    for (; *words; words++)
        add_argument(list, strcmp(*words, "CRF") == 0 ? format_text("%d", crf) : strdup(*words));
}

/* bitexact keeps times and versions of the muxer out. */
static argument_list encoder_arguments(const encoder_desc *desc)
{
    static const char *const before[] = {"ffmpeg", "-nostdin", "-hide_banner", "-loglevel", "error", "-xerror", "-y", "-f", "rawvideo", NULL};
    /* Pixels are sRGB-encoded, which ProRes has no number for. */
    const char *const transfer = desc->codec == VIDEO_CODEC_PRORES ? "bt709" : "iec61966-2-1";
    const char *const tagged[] = {"-color_range", "tv", "-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", transfer, NULL};
    static const char *const input[] = {"-i", "pipe:0", "-map", "0:v:0", NULL};
    static const char *const after[] = {"-fflags", "+bitexact", "-flags:v", "+bitexact", "-map_metadata", "-1", "-movflags", "+faststart+use_metadata_tags",
                                        NULL};
    const encoder_words *encoder = &encoders[desc->codec];
    size_t tags = desc->metadata ? desc->metadata->count : 0;
    argument_list list = {.capacity = FIXED_ARGUMENTS + 2 * tags};
    list.items = calloc(list.capacity, sizeof *list.items);
    if (!list.items) {
        list.failed = true;
        return list;
    }
    add_words(&list, before, 0);
    add_argument(&list, strdup("-pix_fmt"));
    add_argument(&list, strdup(encoder->input));
    add_words(&list, tagged, 0);
    add_argument(&list, strdup("-video_size"));
    add_argument(&list, format_text("%ux%u", desc->width, desc->height));
    add_argument(&list, strdup("-framerate"));
    add_argument(&list, format_text("%u/%u", desc->rate_numerator, desc->rate_denominator));
    add_words(&list, input, 0);
    add_words(&list, encoder->words, desc->crf);
    add_words(&list, tagged, 0);
    add_words(&list, after, 0);
    add_argument(&list, strdup("-f"));
    add_argument(&list, strdup(picture_format_of(desc->path) == PICTURE_MOV ? "mov" : "mp4"));
    for (size_t i = 0; i < tags; i++) {
        add_argument(&list, strdup("-metadata"));
        add_argument(&list, format_text("%s=%s", desc->metadata->entries[i].key, desc->metadata->entries[i].value));
    }
    /* "file:" so that a colon in a folder's name is no protocol. */
    add_argument(&list, format_text("file:%s", output_file_temporary_path(desc->file)));
    return list;
}

file_status encoder_process_start(encoder_process **result, const encoder_desc *desc, file_error *error)
{
    *result = NULL;
    file_status status = FILE_OK;
    int ends[2] = {-1, -1};
    argument_list arguments = {0};
    char *program = find_program("ffmpeg");
    if (!program)
        return file_error_set(error, FILE_UNAVAILABLE, "%s: ffmpeg, which writes .mp4 and .mov, is not on the PATH; .y4m needs none", desc->path);
    encoder_process *process = calloc(1, sizeof *process);
    if (!process) {
        status = file_error_errno(error, FILE_MEMORY, desc->path, NULL, ENOMEM);
        goto fail;
    }
    process->input = process->messages = -1;
    process->path = desc->path;
    process->file = desc->file;
    arguments = encoder_arguments(desc);
    if (arguments.failed) {
        status = file_error_errno(error, FILE_MEMORY, desc->path, NULL, ENOMEM);
        goto fail;
    }
    /* A socket, not a pipe: send() can be told not to raise SIGPIPE, so that nobody's handlers are touched. */
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0 || (process->messages = memfd_create("ffmpeg", MFD_CLOEXEC)) < 0) {
        status = file_error_errno(error, FILE_WRITE, desc->path, "cannot start ffmpeg", errno);
        goto fail;
    }
    const child_descriptors descriptors = {.standard = {ends[1], -1, process->messages}, .extra = -1};
    const int code = child_process_start(&process->pid, program, arguments.items, &descriptors, true);
    if (code) {
        status = file_error_errno(error, FILE_UNAVAILABLE, desc->path, "cannot start ffmpeg", code);
        goto fail;
    }
    process->input = ends[0];
    ends[0] = -1;
    *result = process;
    process = NULL;

fail:
    if (ends[0] >= 0)
        close(ends[0]);
    if (ends[1] >= 0)
        close(ends[1]);
    encoder_process_abort(process);
    free_arguments(&arguments);
    free(program);
    return status;
}

/* ---- ending ---- */

/* Waits without end, but heeds the cancel flag. *exit_status is as waitpid gives it. */
static file_status wait_for_exit(encoder_process *process, int *exit_status, file_error *error)
{
    for (long wait_ms = 1;; wait_ms = wait_ms < WAIT_STEP_MS ? wait_ms * 2 : WAIT_STEP_MS) {
        pid_t reaped = waitpid(process->pid, exit_status, WNOHANG);
        if (reaped == process->pid) {
            process->pid = 0;
            return FILE_OK;
        }
        if (reaped < 0 && errno != EINTR)
            return file_error_errno(error, FILE_WRITE, process->path, "cannot wait for ffmpeg", errno);
        file_status status = output_file_check_cancel(process->file, error);
        if (status != FILE_OK)
            return status;
        struct timespec pause = {.tv_sec = 0, .tv_nsec = wait_ms * 1000000};
        nanosleep(&pause, NULL);
    }
}

/* The last lines that ffmpeg wrote to stderr, up to half the capacity, with "; " in between: the cause often stands before the last one. */
static void last_messages(const encoder_process *process, char *text, size_t capacity)
{
    struct stat info;
    text[0] = '\0';
    if (fstat(process->messages, &info) != 0)
        return;
    const off_t most = (off_t)capacity / 2 - 1, start = info.st_size > most ? info.st_size - most : 0;
    ssize_t length = pread(process->messages, text, (size_t)most, start);
    if (length < 0)
        length = 0;
    while (length > 0 && (text[length - 1] == '\n' || text[length - 1] == ' '))
        length--;
    text[length] = '\0';
    char *line = start > 0 ? strchr(text, '\n') : NULL;
    if (line) /* the line before it is not whole */
        memmove(text, line + 1, strlen(line + 1) + 1);
    while ((line = strchr(text, '\n')) != NULL) {
        memmove(line + 1, line, strlen(line) + 1);
        memcpy(line, "; ", 2);
    }
}

static file_status encoder_failure(encoder_process *process, int exit_status, file_error *error)
{
    char message[512];
    last_messages(process, message, sizeof message);
    if (message[0])
        return file_error_set(error, FILE_WRITE, "%s: ffmpeg failed: %s", process->path, message);
    if (WIFSIGNALED(exit_status))
        return file_error_set(error, FILE_WRITE, "%s: ffmpeg was ended by signal %d: %s", process->path, WTERMSIG(exit_status),
                              strsignal(WTERMSIG(exit_status)));
    return file_error_set(error, FILE_WRITE, "%s: ffmpeg failed with status %d", process->path, WEXITSTATUS(exit_status));
}

file_status encoder_process_write(encoder_process *process, const void *bytes, size_t size, file_error *error)
{
    const char *from = bytes;
    while (size > 0) {
        file_status status = output_file_check_cancel(process->file, error);
        if (status != FILE_OK)
            return status;
        ssize_t sent = send(process->input, from, size, MSG_NOSIGNAL | MSG_DONTWAIT);
        if (sent > 0) {
            from += sent;
            size -= (size_t)sent;
        } else if (sent < 0 && errno == EAGAIN) {
            struct pollfd ready = {.fd = process->input, .events = POLLOUT};
            poll(&ready, 1, WAIT_STEP_MS);
        } else if (sent < 0 && errno != EINTR) {
            /* It has closed its end: it is dead or dying. */
            int exit_status = 0;
            status = wait_for_exit(process, &exit_status, error);
            return status != FILE_OK ? status : encoder_failure(process, exit_status, error);
        }
    }
    return FILE_OK;
}

file_status encoder_process_finish(encoder_process *process, file_error *error)
{
    int exit_status = 0;
    close(process->input);
    process->input = -1;
    file_status status = wait_for_exit(process, &exit_status, error);
    if (status == FILE_OK && !(WIFEXITED(exit_status) && WEXITSTATUS(exit_status) == 0))
        status = encoder_failure(process, exit_status, error);
    encoder_process_abort(process);
    return status;
}

void encoder_process_abort(encoder_process *process)
{
    if (!process)
        return;
    if (process->pid > 0) {
        /* The whole group: a wrapper around ffmpeg may have children. */
        kill(-process->pid, SIGKILL);
        kill(process->pid, SIGKILL);
        while (waitpid(process->pid, NULL, 0) < 0 && errno == EINTR)
            continue;
    }
    if (process->input >= 0)
        close(process->input);
    if (process->messages >= 0)
        close(process->messages);
    free(process);
}

/* ---- checking the result ---- */

static uint64_t big_endian(const unsigned char *bytes, int count)
{
    uint64_t value = 0;
    for (int i = 0; i < count; i++)
        value = value << 8 | bytes[i];
    return value;
}

file_status encoder_check_mp4(int descriptor, const char *path, file_error *error)
{
    struct stat info;
    if (fstat(descriptor, &info) != 0)
        return file_error_errno(error, FILE_WRITE, path, "cannot write", errno);
    uint64_t size = (uint64_t)info.st_size, offset = 0;
    bool index = false, data = false, ordered = false;
    while (offset < size) {
        unsigned char header[16] = {0};
        ssize_t length = pread(descriptor, header, sizeof header, (off_t)offset);
        uint64_t box = length >= 8 ? big_endian(header, 4) : 0;
        if (box == 1 && length == 16)
            box = big_endian(header + 8, 8);
        if (box < 8 || box > size - offset)
            break;
        if (memcmp(header + 4, "moov", 4) == 0)
            index = true;
        if (memcmp(header + 4, "mdat", 4) == 0) {
            data = true;
            ordered = index;
        }
        offset += box;
    }
    if (size == 0 || offset != size || !index || !data || !ordered)
        return file_error_set(error, FILE_WRITE, "%s: ffmpeg left an incomplete file (is the disk full?)", path);
    return FILE_OK;
}
