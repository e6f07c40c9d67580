/* SPDX-License-Identifier: MIT */
/* The progress bar and the progress lines. */
#include "cli/common/progress.h"

#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "cli/common/console.h"

double seconds_now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

progress_mode progress_mode_auto(void) { return isatty(STDERR_FILENO) ? PROGRESS_BAR : PROGRESS_NONE; }

progress_mode progress_mode_heard(progress_mode mode, bool quiet) { return quiet && mode == PROGRESS_BAR ? PROGRESS_NONE : mode; }

bool progress_mode_from_name(const char *name, progress_mode *mode)
{
    if (strcmp(name, "auto") == 0)
        *mode = progress_mode_auto();
    else if (strcmp(name, "json") == 0)
        *mode = PROGRESS_JSON;
    else if (strcmp(name, "text") == 0)
        *mode = PROGRESS_TEXT;
    else if (strcmp(name, "openjd") == 0)
        *mode = PROGRESS_OPENJD;
    else if (strcmp(name, "none") == 0)
        *mode = PROGRESS_NONE;
    else
        return false;
    return true;
}

progress progress_start(progress_mode mode, uint64_t frames)
{
    const double now = seconds_now();
    return (progress){.mode = mode, .frames = frames, .started = now, .last_shown = now, .percent = -1};
}

static void print_json_line(json_t *line)
{
    char *text = line ? json_dumps(line, JSON_COMPACT | JSON_REAL_PRECISION(6)) : NULL;
    if (text)
        fprintf(stderr, "%s\n", text);
    free(text);
    json_decref(line);
}

/* Prints a line for each new percent, in the form that render managers read. */
static void print_percent(progress *p, double all)
{
    const int percent = (int)(100 * all);
    if (percent == p->percent)
        return;
    p->percent = percent;
    fprintf(stderr, p->mode == PROGRESS_OPENJD ? "openjd_progress: %d\n" : "Progress: %d%%\n", percent);
}

/* Fraction of all work that is done; `fraction` is that of the current frame. */
static double share_done(const progress *p, double fraction)
{
    return p->work > 0 ? (p->work_done + p->work_now * fraction) / p->work : ((double)p->frames_done + fraction) / (double)(p->frames ? p->frames : 1);
}

void progress_frame(progress *p, uint32_t frame)
{
    p->frame = frame;
    if (p->mode == PROGRESS_OPENJD)
        fprintf(stderr, "openjd_status: frame %u, %llu of %llu\n", frame, (unsigned long long)p->frames_done + 1, (unsigned long long)p->frames);
}

void progress_update(progress *p, double fraction)
{
    const double now = seconds_now();
    if (p->mode == PROGRESS_NONE || now - p->last_shown < 0.1)
        return;
    p->last_shown = now;
    const double all = share_done(p, fraction);
    if (p->mode == PROGRESS_TEXT || p->mode == PROGRESS_OPENJD) {
        print_percent(p, all);
        return;
    }
    const double left = all > 0 ? (now - p->started) * (1 - all) / all : 0;
    if (p->mode == PROGRESS_JSON) {
        print_json_line(json_pack("{s:s, s:I, s:f, s:f, s:f}", "event", "progress", "frame", (json_int_t)p->frame, "frame_fraction", fraction, "fraction", all,
                                  "seconds_left", left));
        return;
    }
    char bar[31];
    const int filled = (int)(all * (double)(sizeof bar - 1));
    for (int i = 0; i < (int)sizeof bar - 1; i++)
        bar[i] = i < filled ? '=' : i == filled ? '>' : ' ';
    bar[sizeof bar - 1] = 0;
    fprintf(stderr, "\r\033[Kframe %u [%s] %3.0f%%, %.0f s left", p->frame, bar, 100 * all, left);
    fflush(stderr);
    p->shown = true;
}

void progress_frame_done(progress *p, const char *path, double seconds)
{
    p->frames_done++;
    p->work_done += p->work_now;
    if (p->mode == PROGRESS_TEXT || p->mode == PROGRESS_OPENJD)
        print_percent(p, share_done(p, 0));
    if (p->mode == PROGRESS_JSON)
        print_json_line(json_pack("{s:s, s:I, s:o, s:f, s:I, s:I}", "event", "frame", "frame", (json_int_t)p->frame, "file", console_json_text(path), "seconds",
                                  seconds, "done", (json_int_t)p->frames_done, "frames", (json_int_t)p->frames));
}

void progress_clear(progress *p)
{
    if (p->shown)
        fputs("\r\033[K", stderr);
    p->shown = false;
}
