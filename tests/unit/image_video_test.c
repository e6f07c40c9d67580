/* SPDX-License-Identifier: MIT */
/* Films: y4m to the byte, mp4 through ffmpeg (skipped where there is none), and ffmpeg failing in every way. */
#include "image_test_folder.h"

#include <math.h>
#include <sched.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/wait.h>

#include "image/video.h"

enum { WIDTH = 63, HEIGHT = 35, FRAMES = 7 };

static const metadata_entry entries[] = {{"render_hash", "abc"}, {"method", "mangata"}};
static const metadata_list metadata = {entries, 2};

static video_desc small_film(void)
{
    return (video_desc){.width = WIDTH, .height = HEIGHT, .frames_per_second = 30.0, .crf = VIDEO_CRF_DEFAULT, .metadata = &metadata};
}

/* A smooth coloured picture that moves. */
static void paint(uint8_t *rgba, int width, int height, int frame)
{
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            uint8_t *p = rgba + 4 * ((size_t)y * (size_t)width + (size_t)x);
            p[0] = (uint8_t)(40 + 3 * x % 200);
            p[1] = (uint8_t)(200 - 4 * y % 150);
            p[2] = (uint8_t)(128 + 100 * sin(0.1 * (x + y) + 0.3 * frame));
            p[3] = 255;
        }
}

static file_status write_film(const char *path, const video_desc *desc, int frames, file_error *error)
{
    video_writer *writer;
    uint8_t *rgba = malloc((size_t)desc->width * desc->height * 4);
    file_status status = video_writer_open(&writer, path, desc, error);
    for (int f = 0; f < frames && status == FILE_OK; f++) {
        paint(rgba, (int)desc->width, (int)desc->height, f);
        status = video_writer_frame(writer, rgba, 0, error);
    }
    if (status == FILE_OK)
        status = video_writer_finish(writer, error);
    else
        video_writer_abort(writer);
    free(rgba);
    return status;
}

static bool on_path(const char *program)
{
    char command[128];
    snprintf(command, sizeof command, "command -v %s >/dev/null 2>&1", program);
    return system(command) == 0;
}

/* First line of what a shell command prints. */
static void first_line(const char *command, char *out, int size)
{
    FILE *stream = popen(command, "r");
    assert_non_null(stream);
    out[0] = '\0';
    if (!fgets(out, size, stream))
        out[0] = '\0';
    pclose(stream);
    out[strcspn(out, "\n")] = '\0';
}

/* ---- y4m ---- */

static void test_y4m_bytes(void **state)
{
    test_folder *folder = *state;
    char path[512];
    video_desc desc = {.width = 3, .height = 1, .frames_per_second = 29.97, .full_chroma = true};
    static const uint8_t rgba[12] = {255, 255, 255, 0, 0, 0, 0, 9, 255, 0, 0, 1}; /* white, black, red */
    video_writer *writer;
    file_error error;
    assert_int_equal(video_writer_open(&writer, in_folder(folder, "a.y4m", path), &desc, &error), FILE_OK);
    assert_int_equal(video_writer_frame(writer, rgba, 0, &error), FILE_OK);
    assert_int_equal(video_writer_finish(writer, &error), FILE_OK);
    static const char expected[] = "YUV4MPEG2 W3 H1 F30000:1001 Ip A1:1 C444 XCOLORRANGE=LIMITED\nFRAME\n"
                                   "\xeb\x10\x3f"
                                   "\x80\x80\x66"
                                   "\x80\x80\xf0"; /* BT.709: Y 235 16 63, Cb 128 128 102, Cr 128 128 240 */
    size_t size;
    unsigned char *bytes = file_bytes(path, &size);
    assert_int_equal(size, sizeof expected - 1);
    assert_memory_equal(bytes, expected, size);
    free(bytes);
    assert_int_equal(folder_entries(folder->path), 1); /* no metadata, no sidecar */
}

static void test_y4m_chroma_site(void **state)
{
    test_folder *folder = *state;
    char path[512];
    /* Five columns, blue in the third alone: left-sited chroma sees it in the second sample with weight 2 of 4 and in no other;
     * odd sizes round up. */
    video_desc desc = {.width = 5, .height = 3, .frames_per_second = 24};
    uint8_t rgba[3][5][4] = {{{0}}};
    for (int y = 0; y < 3; y++)
        rgba[y][2][2] = 255;
    video_writer *writer;
    assert_int_equal(video_writer_open(&writer, in_folder(folder, "a.y4m", path), &desc, NULL), FILE_OK);
    assert_int_equal(video_writer_frame(writer, &rgba[0][0][0], 0, NULL), FILE_OK);
    assert_int_equal(video_writer_finish(writer, NULL), FILE_OK);
    size_t size;
    unsigned char *bytes = file_bytes(path, &size);
    unsigned char *frame = memmem(bytes, size, "FRAME\n", 6);
    assert_non_null(frame);
    frame += 6;
    assert_int_equal(bytes + size - frame, 15 + 6 + 6);
    for (int y = 0; y < 2; y++) {
        assert_int_equal(frame[15 + 3 * y], 128);
        assert_int_equal(frame[15 + 3 * y + 1], 184); /* half of the way from 128 to 240 */
        assert_int_equal(frame[15 + 3 * y + 2], 128);
    }
    free(bytes);
}

static void test_y4m_film(void **state)
{
    test_folder *folder = *state;
    char path[512], again[512], command[1200], line[256], *value;
    video_desc desc = small_film();
    file_error error;
    assert_int_equal(write_film(in_folder(folder, "a.y4m", path), &desc, FRAMES, &error), FILE_OK);
    assert_int_equal(write_film(in_folder(folder, "b.y4m", again), &desc, FRAMES, &error), FILE_OK);
    assert_same_bytes(path, again);
    assert_int_equal(metadata_read(path, "render_hash", &value, &error), FILE_OK);
    assert_string_equal(value, "abc");
    free(value);
    assert_int_equal(folder_entries(folder->path), 4);
    assert_int_equal(write_film(path, &desc, FRAMES, &error), FILE_EXISTS);
    desc.output.overwrite = true;
    assert_int_equal(write_film(path, &desc, 2, &error), FILE_OK);
    assert_int_equal(folder_entries(folder->path), 4);
    if (!on_path("ffprobe"))
        return;
    snprintf(command, sizeof command,
             "ffprobe -v error -count_frames -show_entries stream=width,height,pix_fmt,color_range,r_frame_rate,nb_read_frames -of "
             "csv=p=0 '%s'",
             again);
    first_line(command, line, sizeof line);
    assert_string_equal(line, "63,35,yuv420p,tv,30/1,7");
}

static void test_y4m_abandoned(void **state)
{
    test_folder *folder = *state;
    char path[512];
    video_desc desc = small_film();
    static uint8_t rgba[WIDTH * HEIGHT * 4];
    volatile sig_atomic_t cancel = 0;
    desc.output.cancel = &cancel;
    video_writer *writer;
    file_error error;
    in_folder(folder, "a.y4m", path);
    assert_int_equal(video_writer_open(&writer, path, &desc, &error), FILE_OK);
    assert_int_equal(video_writer_frame(writer, rgba, 0, &error), FILE_OK);
    assert_false(file_exists(path));
    video_writer_abort(writer);
    assert_int_equal(folder_entries(folder->path), 0);

    assert_int_equal(video_writer_open(&writer, path, &desc, &error), FILE_OK);
    assert_int_equal(video_writer_finish(writer, &error), FILE_ARGUMENT); /* no frame */
    assert_int_equal(folder_entries(folder->path), 0);

    assert_int_equal(video_writer_open(&writer, path, &desc, &error), FILE_OK);
    cancel = 1;
    assert_int_equal(video_writer_frame(writer, rgba, 0, &error), FILE_CANCELLED);
    assert_int_equal(video_writer_finish(writer, &error), FILE_ARGUMENT);
    video_writer_abort(NULL);
    assert_int_equal(folder_entries(folder->path), 0);
}

static void test_bad_descriptions(void **state)
{
    test_folder *folder = *state;
    char path[512];
    video_writer *writer;
    file_error error;
    video_desc desc = small_film();
    assert_int_equal(video_writer_open(&writer, in_folder(folder, "a.avi", path), &desc, &error), FILE_ARGUMENT);
    in_folder(folder, "a.y4m", path);
    const double rates[] = {0.0, -1.0, NAN, INFINITY, 1e9};
    for (int i = 0; i < 5; i++) {
        desc.frames_per_second = rates[i];
        assert_int_equal(video_writer_open(&writer, path, &desc, &error), FILE_ARGUMENT);
    }
    desc = small_film();
    desc.width = 0;
    assert_int_equal(video_writer_open(&writer, path, &desc, &error), FILE_ARGUMENT);
    desc.width = 100000;
    assert_int_equal(video_writer_open(&writer, path, &desc, &error), FILE_ARGUMENT);
    assert_int_equal(folder_entries(folder->path), 0);
}

/* ---- mp4 ---- */

/* The film that comes out of ffmpeg is whole, tagged, padded to even sides, and shows the colours that went in. */
static void test_mp4_film(void **state)
{
    test_folder *folder = *state;
    char path[512], again[512], raw[512], command[1600], line[256], *value;
    if (!on_path("ffmpeg") || !on_path("ffprobe"))
        skip();
    video_desc desc = small_film();
    file_error error = {0};
    in_folder(folder, "a b:c.mp4", path); /* a name that is no URL */
    file_status status = write_film(path, &desc, FRAMES, &error);
    if (status != FILE_OK)
        print_error("%s\n", error.text);
    assert_int_equal(status, FILE_OK);
    assert_int_equal(write_film(in_folder(folder, "b.mp4", again), &desc, FRAMES, &error), FILE_OK);
    assert_same_bytes(path, again);
    assert_int_equal(folder_entries(folder->path), 4);
    assert_int_equal(metadata_read(path, "method", &value, &error), FILE_OK);
    assert_string_equal(value, "mangata");
    free(value);
    snprintf(command, sizeof command,
             "ffprobe -v error -count_frames -show_entries "
             "stream=codec_name,width,height,pix_fmt,color_range,color_space,color_transfer,color_primaries,r_frame_rate,nb_read_"
             "frames:format_tags=render_hash -of default=nk=1:nw=1 'file:%s' | tr '\\n' ,",
             path);
    first_line(command, line, sizeof line);
    assert_string_equal(line, "h264,64,36,yuv420p,tv,bt709,iec61966-2-1,bt709,30/1,7,abc,");

    snprintf(
        command, sizeof command,
        "ffmpeg -nostdin -v error -i 'file:%s' -vf scale=in_color_matrix=bt709:in_range=tv:out_range=pc:flags=accurate_rnd+full_chroma_int -f rawvideo -pix_fmt rgb24 'file:%s'",
        path, in_folder(folder, "raw", raw));
    assert_int_equal(system(command), 0);
    size_t size;
    unsigned char *bytes = file_bytes(raw, &size);
    assert_int_equal(size, FRAMES * 64 * 36 * 3);
    static uint8_t rgba[WIDTH * HEIGHT * 4];
    double sum[3] = {0}, squares = 0;
    for (int f = 0; f < FRAMES; f++) {
        paint(rgba, WIDTH, HEIGHT, f);
        for (int y = 0; y < HEIGHT; y++)
            for (int x = 0; x < WIDTH; x++)
                for (int c = 0; c < 3; c++) {
                    double d = bytes[((f * 36 + y) * 64 + x) * 3 + c] - (double)rgba[(y * WIDTH + x) * 4 + c];
                    sum[c] += d;
                    squares += d * d;
                }
    }
    for (int c = 0; c < 3; c++) /* the wrong matrix or range shifts them by several steps */
        assert_true(fabs(sum[c] / (FRAMES * WIDTH * HEIGHT)) < 1.5);
    assert_true(sqrt(squares / (FRAMES * WIDTH * HEIGHT * 3)) < 4.0);
    free(bytes);
}

static void test_mp4_abandoned(void **state)
{
    test_folder *folder = *state;
    char path[512];
    if (!on_path("ffmpeg"))
        skip();
    video_desc desc = small_film();
    static uint8_t rgba[WIDTH * HEIGHT * 4];
    video_writer *writer;
    file_error error;
    in_folder(folder, "a.mp4", path);
    assert_int_equal(video_writer_open(&writer, path, &desc, &error), FILE_OK);
    assert_int_equal(video_writer_frame(writer, rgba, 0, &error), FILE_OK);
    video_writer_abort(writer);
    assert_int_equal(waitpid(-1, NULL, WNOHANG), -1); /* reaped */
    assert_int_equal(folder_entries(folder->path), 0);
    write_bytes(path, "mine", 4);
    assert_int_equal(video_writer_open(&writer, path, &desc, &error), FILE_EXISTS);
    assert_int_equal(folder_entries(folder->path), 1);
}

/* Disks of many sizes, all too small or just too small: never a film that is not whole. */
static void test_mp4_full_disk(void **state)
{
    enum { NO_MOUNT = 77 };
    test_folder *folder = *state;
    if (!on_path("ffmpeg"))
        skip();
    pid_t child = fork();
    if (child == 0) {
        if (unshare(CLONE_NEWNS) != 0 && unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0)
            _exit(NO_MOUNT);
        if (mount("none", "/", NULL, MS_REC | MS_PRIVATE, NULL) != 0)
            _exit(NO_MOUNT);
        int successes = 0, refusals = 0;
        for (int kib = 4; kib <= 64; kib += 12) {
            char path[512], options[32];
            snprintf(options, sizeof options, "size=%dk", kib);
            if (mount("tmpfs", folder->path, "tmpfs", 0, options) != 0)
                _exit(NO_MOUNT);
            video_desc desc = small_film();
            file_error error = {0};
            file_status status = write_film(in_folder(folder, "a.mp4", path), &desc, 40, &error);
            if (status != FILE_OK && folder_entries(folder->path) != 0)
                _exit(1);
            if (status == FILE_OK && folder_entries(folder->path) != 2)
                _exit(2);
            if (status != FILE_OK && status != FILE_WRITE)
                _exit(3);
            successes += status == FILE_OK;
            refusals += status != FILE_OK;
            umount(folder->path);
        }
        _exit(refusals >= 1 && successes >= 1 ? 0 : 4);
    }
    int result;
    waitpid(child, &result, 0);
    assert_true(WIFEXITED(result));
    if (WEXITSTATUS(result) == NO_MOUNT)
        skip();
    assert_int_equal(WEXITSTATUS(result), 0);
}

/* ---- ffmpeg that is missing or bad: a folder of our own as the PATH ---- */

static char *replace_path(const test_folder *folder, const char *script)
{
    char name[512], value[600];
    const char *old = getenv("PATH");
    char *saved = strdup(old ? old : "/usr/bin:/bin");
    snprintf(value, sizeof value, "%s:/usr/bin:/bin", folder->path);
    if (script) {
        write_bytes(in_folder(folder, "ffmpeg", name), script, strlen(script));
        chmod(name, 0755);
        setenv("PATH", value, 1);
    } else {
        setenv("PATH", folder->path, 1);
    }
    return saved;
}

static void restore_path(char *saved)
{
    setenv("PATH", saved, 1);
    free(saved);
}

static void test_ffmpeg_missing(void **state)
{
    test_folder *folder = *state;
    char path[512];
    video_desc desc = small_film();
    video_writer *writer;
    file_error error;
    in_folder(folder, "a.mp4", path);
    char *saved = replace_path(folder, NULL);
    file_status status = video_writer_open(&writer, path, &desc, &error);
    setenv("PATH", "", 1);
    file_status empty_status = video_writer_open(&writer, path, &desc, NULL);
    restore_path(saved);
    assert_int_equal(status, FILE_UNAVAILABLE);
    assert_int_equal(empty_status, FILE_UNAVAILABLE);
    assert_null(writer);
    assert_non_null(strstr(error.text, "ffmpeg"));
    assert_int_equal(folder_entries(folder->path), 0);
}

static void test_ffmpeg_fails(void **state)
{
    test_folder *folder = *state;
    char path[512];
    static const struct {
        const char *script, *message;
    } cases[] = {
        {"#!/bin/sh\necho 'first' >&2\necho 'No such encoder' >&2\nexit 3\n", "No such encoder"},
        {"#!/bin/sh\necho 'No space left' >&2\necho 'Error of stream 0:0 -- ' >&2\nexit 1\n", "ffmpeg failed: No space left; Error of stream 0:0 --"},
        {"#!/bin/sh\nexit 3\n", "status 3"},
        {"#!/bin/sh\nhead -c 1000 >/dev/null\nkill -9 $$\n", "signal 9"},
        {"#!/bin/sh\ncat >/dev/null\nexit 1\n", "status 1"},
        {"#!/bin/sh\ncat >/dev/null\nexit 0\n", "incomplete"},                         /* success, but no file */
        {"#!/bin/sh\nfor f; do :; done\ncat >\"${f#file:}\"\nexit 0\n", "incomplete"}, /* not an mp4 */
        {"#!/bin/sh\ncat >/dev/null\nfor f; do :; done\nprintf '\\0\\0\\0\\10moov\\0\\0\\0\\40mdat' >\"${f#file:}\"\n", "incomplete"},
        {"#!/bin/sh\ncat >/dev/null\nfor f; do :; done\nprintf '\\0\\0\\0\\10moov\\0\\0\\0\\10mdat\\0\\0\\0\\40free' >\"${f#file:}\"\n", "incomplete"},
        {"#!/bin/sh\ncat >/dev/null\nfor f; do :; done\nprintf '\\0\\0\\0\\12mdatxy\\0\\0\\0\\10moov' >\"${f#file:}\"\n", "incomplete"},
        {"#!/nowhere/sh\n", "cannot start"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        video_desc desc = {.width = 640, .height = 360, .frames_per_second = 30, .metadata = &metadata};
        file_error error = {0};
        char *saved = replace_path(folder, cases[i].script);
        file_status status = write_film(in_folder(folder, "a.mp4", path), &desc, FRAMES, &error);
        restore_path(saved);
        if (!strstr(error.text, cases[i].message))
            print_error("case %zu: %d %s\n", i, status, error.text);
        assert_true(status == FILE_WRITE || status == FILE_UNAVAILABLE);
        assert_non_null(strstr(error.text, cases[i].message));
        assert_int_equal(folder_entries(folder->path), 1); /* the script */
        assert_int_equal(waitpid(-1, NULL, WNOHANG), -1);
    }
}

/* A whole file in the smallest sense passes: the check of boxes is not merely always false. */
static void test_ffmpeg_stub_succeeds(void **state)
{
    test_folder *folder = *state;
    char path[512];
    video_desc desc = small_film();
    file_error error = {0};
    char *saved = replace_path(folder, "#!/bin/sh\ncat >/dev/null\nfor f; do :; done\n"
                                       "printf '\\0\\0\\0\\10moov\\0\\0\\0\\12mdatxy' >\"${f#file:}\"\n");
    file_status status = write_film(in_folder(folder, "a.mp4", path), &desc, 1, &error);
    restore_path(saved);
    assert_int_equal(status, FILE_OK);
    assert_int_equal(folder_entries(folder->path), 3);
}

static volatile sig_atomic_t raised;

static void raise_flag(int signal_number)
{
    (void)signal_number;
    raised = 1;
}

/* One that never reads and has a child: the cancel flag ends the wait, and abort kills both. */
static void test_ffmpeg_hangs(void **state)
{
    test_folder *folder = *state;
    char path[512], mark[512], script[2000];
    static uint8_t rgba[640 * 360 * 4];
    raised = 0;
    video_desc desc = {.width = 640, .height = 360, .frames_per_second = 30, .output = {.cancel = &raised}};
    file_error error = {0};
    video_writer *writer;
    in_folder(folder, "child", mark);
    snprintf(script, sizeof script, "#!/bin/sh\nsleep 600 &\necho $! >'%s.part'\nmv '%s.part' '%s'\nwait\n", mark, mark, mark);
    char *saved = replace_path(folder, script);
    file_status status = video_writer_open(&writer, in_folder(folder, "a.mp4", path), &desc, &error);
    restore_path(saved);
    assert_int_equal(status, FILE_OK);
    for (int i = 0; i < 500 && !file_exists(mark); i++)
        usleep(10000);
    size_t size;
    unsigned char *text = file_bytes(mark, &size);
    pid_t sleeper = atoi((const char *)text);
    free(text);
    assert_true(sleeper > 1);

    /* A frame is more than the socket holds, so that the write blocks; then the handler raises the flag. */
    struct sigaction handler = {.sa_handler = raise_flag}, old;
    sigaction(SIGALRM, &handler, &old);
    alarm(1);
    status = video_writer_frame(writer, rgba, 0, &error);
    sigaction(SIGALRM, &old, NULL);
    assert_int_equal(raised, 1);
    assert_int_equal(status, FILE_CANCELLED);
    video_writer_abort(writer);
    for (int i = 0; i < 500 && kill(sleeper, 0) == 0; i++) { /* adopted by init, which may take a moment */
        char name[64], line[256] = "";
        snprintf(name, sizeof name, "/proc/%d/stat", (int)sleeper);
        FILE *stream = fopen(name, "r");
        if (!stream || !fgets(line, sizeof line, stream) || strstr(line, ") Z")) {
            if (stream)
                fclose(stream);
            break;
        }
        fclose(stream);
        usleep(10000);
        assert_true(i < 499);
    }
    assert_int_equal(folder_entries(folder->path), 2);
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, folder_setup, folder_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(test_y4m_bytes),     IN_FOLDER(test_y4m_chroma_site),      IN_FOLDER(test_y4m_film),
        IN_FOLDER(test_y4m_abandoned), IN_FOLDER(test_bad_descriptions),     IN_FOLDER(test_mp4_film),
        IN_FOLDER(test_mp4_abandoned), IN_FOLDER(test_mp4_full_disk),        IN_FOLDER(test_ffmpeg_missing),
        IN_FOLDER(test_ffmpeg_fails),  IN_FOLDER(test_ffmpeg_stub_succeeds), IN_FOLDER(test_ffmpeg_hangs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
