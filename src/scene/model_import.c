/* SPDX-License-Identifier: MIT */
#define _GNU_SOURCE /* memfd_create, pipe2, dladdr */

#include "scene/model_import.h"

#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "base/child_process.h"
#include "scene/model_wire.h"

enum { BASE_MEGABYTES = 256, PER_BYTE = 160, BASE_SECONDS = 4, SECONDS_PER_MEGABYTE = 2, WALL_PER_SECOND = 10, WALL_SECONDS = 30 };

#ifdef MGT_SANITIZED_READER
enum { SLOWER = 10 };
#else
enum { SLOWER = 1 };
#endif

static bool refuse(model_fault *fault, const char *path, const char *what)
{
    return model_fault_set(fault, SCENE_ERROR_BAD_SCENE, "%s: %s; allowed: triangles or polygons in a sound .gltf, .glb, .obj or .ply file of at most 8 GiB",
                           scene_file_name(path).text, what);
}

/* ---- finding the program ------------------------------------------------------------------------------------------ */

/* Beside `file`, or where programs for programs alone stand from the folder of programs and from that of libraries. */
static bool is_beside(const char *file, char program[PATH_MAX])
{
    static const char *const places[] = {"mangata-import", MGT_LIBEXEC_FROM_PROGRAMS "/mangata-import", MGT_LIBEXEC_FROM_LIBRARIES "/mangata-import"};
    const char *slash = strrchr(file, '/');
    for (size_t i = 0; slash != NULL && i < sizeof places / sizeof *places; i++)
        if (snprintf(program, PATH_MAX, "%.*s/%s", (int)(slash - file), file, places[i]) < PATH_MAX && access(program, X_OK) == 0)
            return true;
    return false;
}

/* A library takes that of its own installation, not one which is beside the program that loads it, such as Python's. */
static bool find_program(char program[PATH_MAX])
{
    char self[PATH_MAX];
    const ssize_t length = readlink("/proc/self/exe", self, sizeof self - 1);
    Dl_info library;
    self[length > 0 ? length : 0] = '\0';
    if (dladdr((const void *)(uintptr_t)find_program, &library) == 0 || library.dli_fname == NULL)
        library.dli_fname = "";
    if (is_beside(library.dli_fname, program) || is_beside(self, program))
        return true;
    snprintf(program, PATH_MAX, "%s", MGT_LIBEXEC "/mangata-import");
    return access(program, X_OK) == 0;
}

/* ---- one run ------------------------------------------------------------------------------------------------------ */

typedef struct import_process {
    pid_t pid;  /* 0: none, or reaped */
    int output; /* memory file that is its standard output */
    int life;   /* our end of a pipe that nobody writes to: it ends when the process does */
    int status; /* as waitpid() gives it; -1: someone else has it */
} import_process;

/* Moves a descriptor above those that the child's own descriptors replace. */
static bool raise_descriptor(int *descriptor)
{
    const int high = *descriptor >= 0 && *descriptor <= WIRE_LIFE ? fcntl(*descriptor, F_DUPFD_CLOEXEC, WIRE_LIFE + 1) : *descriptor;
    if (high != *descriptor) {
        close(*descriptor);
        *descriptor = high;
    }
    return high >= 0;
}

static void reap(import_process *p)
{
    pid_t reaped = -1;
    if (p->pid > 0)
        while ((reaped = waitpid(p->pid, &p->status, 0)) < 0 && errno == EINTR)
            continue;
    if (reaped < 0)
        p->status = -1;
    p->pid = 0;
}

static int64_t milliseconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000 + now.tv_nsec / 1000000;
}

/* False where it takes too long and is killed. */
static bool wait_for(import_process *p, int64_t wall_ms)
{
    const int64_t end = milliseconds() + wall_ms;
    for (;;) {
        struct pollfd ready = {.fd = p->life, .events = POLLIN};
        const int64_t left = end - milliseconds();
        const int found = left > 0 ? poll(&ready, 1, left < INT_MAX ? (int)left : INT_MAX) : 0;
        if (found > 0 || (found < 0 && errno != EINTR))
            break;
        if (left <= 0) {
            kill(p->pid, SIGKILL);
            reap(p);
            return false;
        }
    }
    reap(p);
    return true;
}

/* Why there is nothing whole. */
static bool refuse_end(const import_process *p, const char *path, bool in_time, uint64_t megabytes, uint64_t seconds, model_fault *fault)
{
    const int signal = p->status >= 0 && WIFSIGNALED(p->status) ? WTERMSIG(p->status) : 0;
    char what[128];
    if (!in_time || signal == SIGXCPU || (signal == SIGKILL && p->status >= 0))
        snprintf(what, sizeof what, "takes longer to read than the %llu s that a file of its size may take", (unsigned long long)seconds);
    else if (signal == SIGXFSZ)
        snprintf(what, sizeof what, "needs more than the %llu MiB that a file of its size may take", (unsigned long long)megabytes);
    else
        snprintf(what, sizeof what, "is damaged or needs more than %llu MiB: mangata-import ended %s%d while it read it", (unsigned long long)megabytes,
                 signal != 0 ? "by signal " : "with status ",
                 signal != 0      ? signal
                 : p->status >= 0 ? WEXITSTATUS(p->status)
                                  : -1);
    return refuse(fault, path, what);
}

/* Maps what was written, if it is whole as far as its header. */
static bool take_output(const import_process *p, model_import *out)
{
    struct stat status;
    if (fstat(p->output, &status) != 0 || status.st_size < (off_t)sizeof(wire_header))
        return false;
    void *bytes = mmap(NULL, (size_t)status.st_size, PROT_READ, MAP_PRIVATE, p->output, 0);
    if (bytes == MAP_FAILED)
        return false;
    *out = (model_import){.bytes = bytes, .length = (size_t)status.st_size};
    if (((const wire_header *)bytes)->magic == WIRE_MAGIC)
        return true;
    model_import_end(out);
    return false;
}

bool model_import_run(model_import *out, const char *path, uint64_t weight, model_fault *fault)
{
    import_process p = {.output = -1, .life = -1, .status = -1};
    const uint64_t megabytes = BASE_MEGABYTES + (weight >> 20) * PER_BYTE, seconds = (BASE_SECONDS + (weight >> 20) * SECONDS_PER_MEGABYTE) * SLOWER;
    char program[PATH_MAX], name[] = "mangata-import", parent[24], memory[24], time[24];
    char *file = strdup(path);
    char *arguments[] = {name, file, parent, memory, time, NULL};
    int ends[2] = {-1, -1};
    bool good = false;
    *out = (model_import){0};
    snprintf(parent, sizeof parent, "%ld", (long)getpid());
    snprintf(memory, sizeof memory, "%llu", (unsigned long long)megabytes);
    snprintf(time, sizeof time, "%llu", (unsigned long long)seconds);
    if (file == NULL || pipe2(ends, O_CLOEXEC) != 0 || (p.output = memfd_create("mangata-import", MFD_CLOEXEC)) < 0 || !raise_descriptor(&p.output) ||
        !raise_descriptor(&ends[1])) {
        model_fault_memory(fault);
        goto done;
    }
    p.life = ends[0];
    ends[0] = -1;
    if (!find_program(program)) {
        refuse(fault, path, "cannot be read without the program mangata-import, which is neither beside this program nor in " MGT_LIBEXEC);
        goto done;
    }
    const child_descriptors descriptors = {.standard = {-1, p.output, -1}, .extra = ends[1], .extra_place = WIRE_LIFE};
    const int code = child_process_start(&p.pid, program, arguments, &descriptors, false);
    if (code == EAGAIN || code == ENOMEM) {
        model_fault_memory(fault);
        goto done;
    }
    if (code != 0) {
        char what[128];
        snprintf(what, sizeof what, "mangata-import, which reads it, cannot be started: %s", strerror(code));
        refuse(fault, path, what);
        goto done;
    }
    close(ends[1]);
    ends[1] = -1;
    const bool in_time = wait_for(&p, (int64_t)(WALL_SECONDS + seconds * WALL_PER_SECOND) * 1000);
    good = in_time && (p.status == 0 || p.status == -1) && take_output(&p, out);
    if (!good)
        refuse_end(&p, path, in_time, megabytes, seconds, fault);
done:
    for (int i = 0; i < 2; i++)
        if (ends[i] >= 0)
            close(ends[i]);
    if (p.life >= 0)
        close(p.life);
    if (p.output >= 0)
        close(p.output);
    free(file);
    return good;
}

void model_import_end(model_import *import)
{
    if (import->bytes != NULL)
        munmap((void *)import->bytes, import->length);
    *import = (model_import){0};
}
