/* SPDX-License-Identifier: MIT */
#include "base/child_process.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

extern char **environ;

bool program_beside(const char *name, char *path, size_t size)
{
    const ssize_t length = readlink("/proc/self/exe", path, size - 1);
    if (length <= 0)
        return false;
    path[length] = 0;
    char *own = strrchr(path, '/');
    const size_t room = own ? size - (size_t)(own + 1 - path) : 0;
    return own && (size_t)snprintf(own + 1, room, "%s", name) < room && access(path, X_OK) == 0;
}

static int set_descriptors(posix_spawn_file_actions_t *actions, const child_descriptors *d)
{
    int code = 0;
    for (int i = 0; i < 3 && code == 0; i++)
        code = d->standard[i] < 0 ? posix_spawn_file_actions_addopen(actions, i, "/dev/null", i == 0 ? O_RDONLY : O_WRONLY, 0)
                                  : posix_spawn_file_actions_adddup2(actions, d->standard[i], i);
    return code == 0 && d->extra >= 0 ? posix_spawn_file_actions_adddup2(actions, d->extra, d->extra_place) : code;
}

static int set_attributes(posix_spawnattr_t *attributes, bool own_group)
{
    sigset_t none, all;
    sigemptyset(&none);
    sigfillset(&all);
    int code = own_group ? posix_spawnattr_setpgroup(attributes, 0) : 0;
    if (code == 0)
        code = posix_spawnattr_setsigmask(attributes, &none);
    if (code == 0)
        code = posix_spawnattr_setsigdefault(attributes, &all);
    const int flags = POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | (own_group ? POSIX_SPAWN_SETPGROUP : 0);
    return code == 0 ? posix_spawnattr_setflags(attributes, (short)flags) : code;
}

int child_process_start(pid_t *pid, const char *program, char *const *arguments, const child_descriptors *descriptors, bool own_group)
{
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    pid_t started = 0;
    int code = posix_spawn_file_actions_init(&actions);
    if (code != 0)
        return code;
    code = posix_spawnattr_init(&attributes);
    if (code != 0) {
        posix_spawn_file_actions_destroy(&actions);
        return code;
    }
    code = set_descriptors(&actions, descriptors);
    if (code == 0)
        code = set_attributes(&attributes, own_group);
    if (code == 0)
        code = posix_spawn(&started, program, &actions, &attributes, arguments, environ);
    if (code == 0)
        *pid = started;
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    return code;
}
