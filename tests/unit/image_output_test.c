/* SPDX-License-Identifier: MIT */
/* Atomic output: whole or not at all, whatever happens on the way. */
#include "image_test_folder.h"

#include <errno.h>
#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include "image/file_whole.h"
#include "image/output_file.h"
#include "image/picture.h"

/* What happens right after files get their names. */
static struct {
    int names;                     /* so many from now on, the action follows the last one */
    volatile sig_atomic_t *cancel; /* the action: sets this flag, */
    const char *foreign;           /* or creates this file, else kills the process */
    useconds_t pause;              /* after each */
} after_names;

int __real_renameat(int from, const char *old, int to, const char *name);
int __real_renameat2(int from, const char *old, int to, const char *name, unsigned flags);
int __wrap_renameat(int from, const char *old, int to, const char *name);
int __wrap_renameat2(int from, const char *old, int to, const char *name, unsigned flags);

static int named(int result)
{
    const int code = errno;
    if (result == 0 && after_names.pause > 0)
        usleep(after_names.pause);
    if (result == 0 && after_names.names > 0 && --after_names.names == 0) {
        if (after_names.cancel)
            *after_names.cancel = 1;
        else if (after_names.foreign)
            write_bytes(after_names.foreign, "theirs", 6);
        else
            kill(getpid(), SIGKILL);
    }
    errno = code;
    return result;
}

int __wrap_renameat(int from, const char *old, int to, const char *name) { return named(__real_renameat(from, old, to, name)); }

int __wrap_renameat2(int from, const char *old, int to, const char *name, unsigned flags) { return named(__real_renameat2(from, old, to, name, flags)); }

static void test_appears_only_when_finished(void **state)
{
    test_folder *folder = *state;
    char path[512];
    in_folder(folder, "road.bin", path);
    output_file *file;
    file_error error;
    assert_int_equal(output_file_open(&file, path, NULL, &error), FILE_OK);
    assert_int_equal(output_file_write(file, "hello ", 6, &error), FILE_OK);
    assert_int_equal(output_file_write(file, "world", 5, &error), FILE_OK);
    assert_int_equal(output_file_write_at(file, 0, "J", 1, &error), FILE_OK);
    assert_false(file_exists(path));
    assert_true(file_exists(output_file_temporary_path(file)));
    assert_int_equal(output_file_finish(file, &error), FILE_OK);
    size_t size;
    unsigned char *bytes = file_bytes(path, &size);
    assert_int_equal(size, 11);
    assert_memory_equal(bytes, "Jello world", 11);
    free(bytes);
    assert_int_equal(folder_entries(folder->path), 1);
}

static void test_abort_leaves_nothing(void **state)
{
    test_folder *folder = *state;
    char path[512];
    output_file *file;
    assert_int_equal(output_file_open(&file, in_folder(folder, "a", path), NULL, NULL), FILE_OK);
    assert_int_equal(output_file_write(file, "x", 1, NULL), FILE_OK);
    output_file_abort(file);
    output_file_abort(NULL);
    assert_int_equal(folder_entries(folder->path), 0);
}

static void test_existing_is_refused(void **state)
{
    test_folder *folder = *state;
    char path[512];
    in_folder(folder, "a", path);
    write_bytes(path, "old", 3);
    output_file *file;
    file_error error;
    assert_int_equal(output_file_check(path, NULL, &error), FILE_EXISTS);
    assert_int_equal(output_file_open(&file, path, NULL, &error), FILE_EXISTS);
    assert_null(file);
    assert_non_null(strstr(error.text, "exists already"));
    assert_non_null(strstr(error.text, path));

    output_options overwrite = {.overwrite = true};
    assert_int_equal(output_file_check(path, &overwrite, &error), FILE_OK);
    assert_int_equal(output_file_open(&file, path, &overwrite, &error), FILE_OK);
    assert_int_equal(output_file_write(file, "newer", 5, &error), FILE_OK);
    assert_int_equal(output_file_finish(file, &error), FILE_OK);
    size_t size;
    unsigned char *bytes = file_bytes(path, &size);
    assert_memory_equal(bytes, "newer", 5);
    free(bytes);
    assert_int_equal(folder_entries(folder->path), 1);
}

static file_status replace(const char *path, const char *text, file_error *error)
{
    return output_file_write_whole(path, text, strlen(text), &(output_options){.overwrite = true}, error);
}

static void assert_text(const char *path, const char *text)
{
    size_t size;
    unsigned char *bytes = file_bytes(path, &size);
    assert_int_equal(size, strlen(text));
    assert_memory_equal(bytes, text, size);
    free(bytes);
}

static void assert_link(const char *path)
{
    struct stat info;
    assert_int_equal(lstat(path, &info), 0);
    assert_true(S_ISLNK(info.st_mode));
}

/* A link stays, and the file that it names in the end is replaced, or created where there is none. */
static void test_links_are_followed(void **state)
{
    test_folder *folder = *state;
    char link[512], other[512], inner[512], target[512], path[512];
    file_error error;
    assert_int_equal(mkdir(in_folder(folder, "d", inner), 0700), 0);
    write_bytes(in_folder(folder, "d/a", target), "old", 3);
    assert_int_equal(symlink(in_folder(folder, "d/b", other), in_folder(folder, "l", link)), 0);
    assert_int_equal(symlink("../d/a", other), 0);
    assert_int_equal(output_file_check(link, NULL, &error), FILE_EXISTS);
    assert_int_equal(output_file_write_whole(link, "x", 1, NULL, &error), FILE_EXISTS);
    assert_non_null(strstr(error.text, link));
    assert_int_equal(replace(link, "newer", &error), FILE_OK);
    assert_text(target, "newer");
    assert_link(link);
    assert_link(other);

    assert_int_equal(unlink(target), 0);
    assert_int_equal(output_file_check(link, NULL, &error), FILE_OK);
    output_file *file;
    assert_int_equal(output_file_open(&file, link, NULL, &error), FILE_OK);
    assert_memory_equal(output_file_temporary_path(file), inner, strlen(inner)); /* beside the file itself, which may lie on another disk */
    assert_int_equal(output_file_write(file, "made", 4, &error), FILE_OK);
    assert_int_equal(output_file_finish(file, &error), FILE_OK);
    assert_text(target, "made");
    assert_link(link);
    assert_int_equal(folder_entries(folder->path), 2);
    assert_int_equal(folder_entries(inner), 2);

    static const char *const bad[][2] = {{"d", "is a directory"},
                                         {"d/", "is a directory"},
                                         {"none/a", "No such file"},
                                         {"r", "symbolic links"},
                                         {"/dev/null", "not a regular"}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        assert_int_equal(symlink(bad[i][0], in_folder(folder, "r", path)), 0);
        assert_int_equal(output_file_check(path, &(output_options){.overwrite = true}, &error), FILE_WRITE);
        assert_int_equal(replace(path, "x", &error), FILE_WRITE);
        assert_non_null(strstr(error.text, bad[i][1]));
        assert_non_null(strstr(error.text, path));
        assert_int_equal(output_file_check_kind(path, NULL), i == 2 || i == 3 ? FILE_OK : FILE_WRITE);
        assert_link(path);
        assert_int_equal(unlink(path), 0);
    }
}

/* In a folder like /tmp a link of another user leads nowhere, one of our own or of the folder's owner is followed. */
static void test_links_of_others(void **state)
{
    test_folder *folder = *state;
    char link[512], target[512];
    file_error error;
    if (geteuid() != 0)
        return;
    write_bytes(in_folder(folder, "a", target), "old", 3);
    assert_int_equal(symlink("a", in_folder(folder, "l", link)), 0);
    assert_int_equal(chmod(folder->path, 01777), 0);
    assert_int_equal(replace(link, "own", &error), FILE_OK);
    assert_int_equal(lchown(link, 65534, 65534), 0);
    assert_int_equal(replace(link, "x", &error), FILE_WRITE);
    assert_non_null(strstr(error.text, "another user's link"));
    assert_text(target, "own");
    assert_int_equal(chmod(folder->path, 0777), 0);
    assert_int_equal(replace(link, "newer", &error), FILE_OK);
    assert_text(target, "newer");
}

/* The new file has the permissions of the old one from its first byte on. */
static void test_mode_is_kept(void **state)
{
    test_folder *folder = *state;
    static const mode_t modes[] = {0600, 0640, 0755, 0444, 0666};
    char path[512];
    struct stat info;
    file_error error;
    const mode_t mask = umask(027);
    in_folder(folder, "a", path);
    for (size_t i = 0; i < sizeof modes / sizeof *modes; i++) {
        output_file *file;
        assert_int_equal(replace(path, "old", &error), FILE_OK);
        assert_int_equal(chmod(path, modes[i]), 0);
        assert_int_equal(output_file_open(&file, path, &(output_options){.overwrite = true}, &error), FILE_OK);
        assert_int_equal(stat(output_file_temporary_path(file), &info), 0);
        assert_int_equal(info.st_mode & 07777, modes[i] | 0600);
        assert_int_equal(output_file_finish(file, &error), FILE_OK);
        assert_int_equal(stat(path, &info), 0);
        assert_int_equal(info.st_mode & 07777, modes[i]);
    }
    assert_int_equal(unlink(path), 0);
    assert_int_equal(replace(path, "first", &error), FILE_OK);
    assert_int_equal(stat(path, &info), 0);
    assert_int_equal(info.st_mode & 07777, 0640);
    umask(mask);
}

/* Another process creates the name between open and finish. */
static void test_no_race_for_the_name(void **state)
{
    test_folder *folder = *state;
    char path[512];
    in_folder(folder, "a", path);
    output_file *file;
    file_error error;
    assert_int_equal(output_file_open(&file, path, NULL, &error), FILE_OK);
    write_bytes(path, "theirs", 6);
    assert_int_equal(output_file_finish(file, &error), FILE_EXISTS);
    size_t size;
    unsigned char *bytes = file_bytes(path, &size);
    assert_memory_equal(bytes, "theirs", 6);
    free(bytes);
    assert_int_equal(folder_entries(folder->path), 1);
}

static void test_bad_targets(void **state)
{
    test_folder *folder = *state;
    char path[512], fifo[512];
    output_options overwrite = {.overwrite = true};
    assert_int_equal(mkfifo(in_folder(folder, "pipe", fifo), 0600), 0);
    const char *bad[] = {"", "/", ".", "..", folder->path, in_folder(folder, "missing/a", path), fifo, "/dev/null", "/proc/a"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        output_file *file;
        file_error error = {0};
        if (i + 1 < sizeof bad / sizeof *bad) /* /proc shows its mind only when asked to create a file */
            assert_int_not_equal(output_file_check(bad[i], &overwrite, NULL), FILE_OK);
        assert_int_not_equal(output_file_open(&file, bad[i], &overwrite, &error), FILE_OK);
        assert_null(file);
        assert_true(strlen(error.text) > 10);
        assert_null(strchr(error.text, '\n'));
    }
    assert_int_equal(folder_entries(folder->path), 1);
}

static void test_long_name_and_relative_path(void **state)
{
    test_folder *folder = *state;
    char name[256], path[512], old[512];
    memset(name, 'n', 255);
    name[255] = '\0';
    assert_non_null(getcwd(old, sizeof old));
    assert_int_equal(chdir(folder->path), 0);
    output_file *file;
    file_error error;
    assert_int_equal(output_file_open(&file, name, NULL, &error), FILE_OK);
    assert_int_equal(chdir(old), 0); /* the folder was settled when it was opened */
    assert_int_equal(output_file_finish(file, &error), FILE_OK);
    assert_true(file_exists(in_folder(folder, name, path)));
    assert_int_equal(folder_entries(folder->path), 1);
}

static void test_unwritable_folder(void **state)
{
    test_folder *folder = *state;
    char path[512];
    chmod(folder->path, 0500);
    pid_t child = fork();
    if (child == 0) {
        if (geteuid() == 0 && (setgid(65534) != 0 || setuid(65534) != 0))
            _exit(3);
        output_file *file;
        file_error error = {0};
        file_status checked = output_file_check(in_folder(folder, "a", path), NULL, NULL);
        file_status status = output_file_open(&file, path, NULL, &error);
        _exit(checked == FILE_WRITE && status == FILE_WRITE && strstr(error.text, "Permission denied") ? 0 : 1);
    }
    int result;
    waitpid(child, &result, 0);
    chmod(folder->path, 0700);
    assert_int_equal(WEXITSTATUS(result), 0);
    assert_int_equal(folder_entries(folder->path), 0);
}

static void test_cancel(void **state)
{
    test_folder *folder = *state;
    char path[512];
    volatile sig_atomic_t cancel = 0;
    output_options options = {.cancel = &cancel};
    output_file *file;
    file_error error;
    assert_int_equal(output_file_open(&file, in_folder(folder, "a", path), &options, &error), FILE_OK);
    assert_int_equal(output_file_write(file, "x", 1, &error), FILE_OK);
    cancel = 1;
    assert_int_equal(output_file_write(file, "x", 1, &error), FILE_CANCELLED);
    assert_int_equal(output_file_finish(file, &error), FILE_CANCELLED);
    assert_int_equal(folder_entries(folder->path), 0);

    static uint8_t rgba[64 * 64 * 4];
    static float values[64 * 64 * 3];
    picture_layer layer = {.name = "color", .channels = 3, .pixels = values};
    metadata_list none = {0};
    assert_int_equal(picture_write_png(path, 64, 64, rgba, 0, NULL, &options, &error), FILE_CANCELLED);
    assert_int_equal(picture_write_exr(path, 64, 64, &layer, 1, NULL, &options, &error), FILE_CANCELLED);
    assert_int_equal(picture_write_pfm(path, 64, 64, &layer, &none, &options, &error), FILE_CANCELLED);
    assert_int_equal(folder_entries(folder->path), 0);
}

/* ---- full disk ---- */

enum { SIDE = 256 };

static uint8_t *noise(size_t size)
{
    uint32_t seed = 7;
    uint8_t *bytes = malloc(size);
    for (size_t i = 0; i < size; i++)
        bytes[i] = (uint8_t)test_random(&seed);
    return bytes;
}

/* Every writer must fail with ENOSPC or EFBIG and leave the folder empty. 0: all did. */
static int write_all_formats(const char *folder, const char *reason)
{
    char path[600];
    metadata_entry entry = {"key", "value"};
    metadata_list metadata = {&entry, 1};
    uint8_t *bytes = noise((size_t)SIDE * SIDE * 12);
    float *values = calloc((size_t)SIDE * SIDE * 3, sizeof *values);
    for (int i = 0; i < SIDE * SIDE * 3; i++)
        values[i] = (float)bytes[i] / (float)(1 + bytes[i + 5]);
    picture_layer layer = {.name = "color", .channels = 3, .pixels = values};
    int failures = 0;
    for (int kind = 0; kind < 3; kind++) {
        static const char *const names[] = {"a.png", "a.exr", "a.pfm"};
        file_error error = {0};
        file_status status = FILE_OK;
        snprintf(path, sizeof path, "%s/%s", folder, names[kind]);
        if (kind == 0)
            status = picture_write_png(path, SIDE, SIDE, bytes, 0, &metadata, NULL, &error);
        if (kind == 1)
            status = picture_write_exr(path, SIDE, SIDE, &layer, 1, &metadata, NULL, &error);
        if (kind == 2)
            status = picture_write_pfm(path, SIDE, SIDE, &layer, &metadata, NULL, &error);
        if (status != FILE_WRITE || !strstr(error.text, reason) || folder_entries(folder) != 0) {
            print_error("%s: %d %s\n", path, status, error.text);
            failures++;
        }
    }
    free(values);
    free(bytes);
    return failures;
}

static void test_file_size_limit(void **state)
{
    test_folder *folder = *state;
    pid_t child = fork();
    if (child == 0) {
        signal(SIGXFSZ, SIG_IGN);
        struct rlimit limit = {100000, 100000};
        setrlimit(RLIMIT_FSIZE, &limit);
        _exit(write_all_formats(folder->path, "File too large"));
    }
    int result;
    waitpid(child, &result, 0);
    assert_true(WIFEXITED(result));
    assert_int_equal(WEXITSTATUS(result), 0);
    assert_int_equal(folder_entries(folder->path), 0);
}

static void test_full_disk(void **state)
{
    enum { NO_MOUNT = 77 };
    test_folder *folder = *state;
    pid_t child = fork();
    if (child == 0) {
        /* A tmpfs of 64 KiB that only this process sees. */
        if (unshare(CLONE_NEWNS) != 0 && unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0)
            _exit(NO_MOUNT);
        if (mount("none", "/", NULL, MS_REC | MS_PRIVATE, NULL) != 0 || mount("tmpfs", folder->path, "tmpfs", 0, "size=64k") != 0)
            _exit(NO_MOUNT);
        int failures = write_all_formats(folder->path, "No space left on device");
        umount(folder->path);
        _exit(failures);
    }
    int result;
    waitpid(child, &result, 0);
    assert_true(WIFEXITED(result));
    if (WEXITSTATUS(result) == NO_MOUNT) {
        print_message("no right to mount a tmpfs here; the file size limit stands in for the full disk\n");
        skip();
    }
    assert_int_equal(WEXITSTATUS(result), 0);
}

/* ---- killed ---- */

/* A child writes the same picture over and over and is killed at an unforeseen moment: under the final name stands a whole
 * picture or none. */
static void test_kill(void **state)
{
    test_folder *folder = *state;
    char path[512], whole[512];
    uint8_t *bytes = noise((size_t)SIDE * SIDE * 4);
    file_error error;
    assert_int_equal(picture_write_png(in_folder(folder, "whole.png", whole), SIDE, SIDE, bytes, 0, NULL, NULL, &error), FILE_OK);
    in_folder(folder, "a.png", path);
    for (int round = 0; round < 12; round++) {
        pid_t child = fork();
        if (child == 0) {
            output_options overwrite = {.overwrite = true};
            for (;;)
                if (picture_write_png(path, SIDE, SIDE, bytes, 0, NULL, &overwrite, NULL) != FILE_OK)
                    _exit(1);
        }
        usleep(5000u + 7919u * (unsigned)round);
        kill(child, SIGKILL);
        int result;
        waitpid(child, &result, 0);
        assert_true(WIFSIGNALED(result));
        if (file_exists(path)) {
            assert_same_bytes(path, whole);
            unlink(path);
        }
    }
    free(bytes);
}

/* ---- a picture and its sidecar ---- */

static const char *const hashes[] = {"zero", "one", "two", "three"};

/* Writes the picture number `which` with its sidecar. */
static file_status write_pair(const char *path, int which, const output_options *options)
{
    float values[48];
    for (int i = 0; i < 48; i++)
        values[i] = (float)(which + i);
    const picture_layer layer = {.name = "color", .channels = 3, .pixels = values};
    const metadata_entry entry = {"render_hash", hashes[which]};
    return picture_write_pfm(path, 4, 4, &layer, &(metadata_list){&entry, 1}, options, NULL);
}

static file_state pair_state(const char *path, int which)
{
    file_state state = FILE_STATE_OTHER;
    file_error error;
    assert_int_equal(file_state_read(path, "render_hash", hashes[which], true, &state, &error), FILE_OK);
    return state;
}

/* A child that is killed after its first file has its name. */
static void kill_between(const char *path, int which, bool overwrite)
{
    const pid_t child = fork();
    if (child == 0) {
        after_names.names = 1;
        write_pair(path, which, &(output_options){.overwrite = overwrite});
        _exit(0);
    }
    int result;
    waitpid(child, &result, 0);
    assert_true(WIFSIGNALED(result));
}

/* A signal between the two names takes neither away. */
static void test_pair_is_not_cancelled_between(void **state)
{
    test_folder *folder = *state;
    char path[512];
    in_folder(folder, "a.pfm", path);
    for (int round = 0; round < 2; round++) {
        volatile sig_atomic_t cancel = 0;
        after_names.names = 1;
        after_names.cancel = &cancel;
        assert_int_equal(write_pair(path, round, &(output_options){.overwrite = round == 1, .cancel = &cancel}), FILE_OK);
        after_names.cancel = NULL;
        assert_int_equal(cancel, 1);
        assert_int_equal(pair_state(path, round), FILE_STATE_SAME);
        assert_int_equal(folder_entries(folder->path), 2);
    }
}

static void test_pair_killed_between(void **state)
{
    test_folder *folder = *state;
    char path[512], sidecar[512], old[512];
    in_folder(folder, "a.pfm", path);
    in_folder(folder, "a.pfm.json", sidecar);
    kill_between(path, 1, false);
    assert_false(file_exists(path));
    assert_true(file_exists(sidecar));
    assert_int_equal(write_pair(path, 0, NULL), FILE_OK);
    assert_int_equal(pair_state(path, 0), FILE_STATE_SAME);

    assert_int_equal(write_pair(in_folder(folder, "old.pfm", old), 0, NULL), FILE_OK);
    kill_between(path, 1, true);
    assert_same_bytes(path, old);
    assert_int_equal(pair_state(path, 1), FILE_STATE_DAMAGED);
    assert_int_equal(write_pair(path, 1, NULL), FILE_EXISTS);
    assert_int_equal(write_pair(path, 1, &(output_options){.overwrite = true}), FILE_OK);
    assert_int_equal(pair_state(path, 1), FILE_STATE_SAME);
}

/* Another program's file gets the name of the picture between the two: it stays, and the sidecar goes. */
static void test_pair_fails_between(void **state)
{
    test_folder *folder = *state;
    char path[512];
    after_names.names = 1;
    after_names.foreign = in_folder(folder, "a.pfm", path);
    assert_int_equal(write_pair(path, 0, NULL), FILE_EXISTS);
    after_names.foreign = NULL;
    size_t size;
    unsigned char *bytes = file_bytes(path, &size);
    assert_int_equal(size, 6);
    free(bytes);
    assert_int_equal(folder_entries(folder->path), 1);
}

/* Of several processes that write other pictures under one name, one wins, or with overwrite each in turn; the sidecar is always the picture's. */
static void test_pair_of_many_processes(void **state)
{
    enum { WRITERS = 4, ROUNDS = 30 };
    test_folder *folder = *state;
    char path[512];
    in_folder(folder, "a.pfm", path);
    for (int round = 0; round < ROUNDS; round++) {
        const bool overwrite = round % 2 == 1;
        pid_t writers[WRITERS];
        int written = 0, same = 0;
        if (round % 4 == 0)
            folder_clear(folder->path);
        if (round % 8 == 4) { /* left by a process that was killed */
            folder_clear(folder->path);
            kill_between(path, 0, false);
        }
        for (int i = 0; i < WRITERS; i++) {
            if ((writers[i] = fork()) != 0)
                continue;
            after_names.pause = 3000;
            _exit(write_pair(path, i, &(output_options){.overwrite = overwrite}));
        }
        for (int i = 0; i < WRITERS; i++) {
            int result;
            waitpid(writers[i], &result, 0);
            assert_true(WIFEXITED(result));
            assert_true(WEXITSTATUS(result) == FILE_OK || (!overwrite && WEXITSTATUS(result) == FILE_EXISTS));
            written += WEXITSTATUS(result) == FILE_OK;
        }
        assert_int_equal(written, overwrite ? WRITERS : round % 4 == 0);
        for (int i = 0; i < WRITERS; i++)
            same += pair_state(path, i) == FILE_STATE_SAME;
        assert_int_equal(same, 1);
    }
}

/* The leftover of a killed process neither blocks nor confuses the next one. */
static void test_leftover_is_no_obstacle(void **state)
{
    test_folder *folder = *state;
    char path[512], leftover[512], name[64];
    snprintf(name, sizeof name, ".mangata-%ld-0.tmp", (long)getpid());
    write_bytes(in_folder(folder, name, leftover), "stale", 5);
    output_file *file;
    assert_int_equal(output_file_open(&file, in_folder(folder, "a", path), NULL, NULL), FILE_OK);
    output_file_abort(file);
    assert_true(file_exists(leftover));
    assert_int_equal(folder_entries(folder->path), 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_appears_only_when_finished, folder_setup, folder_teardown),
        cmocka_unit_test_setup_teardown(test_abort_leaves_nothing, folder_setup, folder_teardown),
        cmocka_unit_test_setup_teardown(test_existing_is_refused, folder_setup, folder_teardown),
        cmocka_unit_test_setup_teardown(test_links_are_followed, folder_setup, folder_teardown),
        cmocka_unit_test_setup_teardown(test_links_of_others, folder_setup, folder_teardown),
        cmocka_unit_test_setup_teardown(test_mode_is_kept, folder_setup, folder_teardown),
        cmocka_unit_test_setup_teardown(test_no_race_for_the_name, folder_setup, folder_teardown),
        cmocka_unit_test_setup_teardown(test_bad_targets, folder_setup, folder_teardown),
        cmocka_unit_test_setup_teardown(test_long_name_and_relative_path, folder_setup, folder_teardown),
        cmocka_unit_test_setup_teardown(test_unwritable_folder, folder_setup, folder_teardown),
        cmocka_unit_test_setup_teardown(test_cancel, folder_setup, folder_teardown),
        cmocka_unit_test_setup_teardown(test_file_size_limit, folder_setup, folder_teardown),
        cmocka_unit_test_setup_teardown(test_full_disk, folder_setup, folder_teardown),
        cmocka_unit_test_setup_teardown(test_kill, folder_setup, folder_teardown),
        cmocka_unit_test_setup_teardown(test_pair_is_not_cancelled_between, folder_setup, folder_teardown),
        cmocka_unit_test_setup_teardown(test_pair_killed_between, folder_setup, folder_teardown),
        cmocka_unit_test_setup_teardown(test_pair_fails_between, folder_setup, folder_teardown),
        cmocka_unit_test_setup_teardown(test_pair_of_many_processes, folder_setup, folder_teardown),
        cmocka_unit_test_setup_teardown(test_leftover_is_no_obstacle, folder_setup, folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
