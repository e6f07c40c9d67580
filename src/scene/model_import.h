/* SPDX-License-Identifier: MIT
 *
 * Running mangata-import, the program that reads glTF and OBJ files.
 */
#ifndef MANGATA_SCENE_MODEL_IMPORT_H
#define MANGATA_SCENE_MODEL_IMPORT_H

#include "scene/model.h"

/* The program's output, in the form of model_wire.h. Only its header has been checked to be whole. */
typedef struct model_import {
    const char *bytes; /* mapped memory */
    size_t length;
} model_import;

/* Reads the file at `path` in a process of its own. `weight`: bytes of the file and of the files it refers to; the process may take 256 MiB and 160 times
 * `weight` of memory, and 4 s of processor time and 2 s for each MiB of `weight`. The process ends with the thread that called, however that ends. Any thread may call, also of a host with
 * threads of its own; a host that ignores SIGCHLD or waits for all children does no harm. The program is looked for beside the calling program and beside
 * the library, in ../libexec/mangata from there, and where it was installed; without it the file is refused.
 * False with *fault filled; else to be ended with model_import_end(). */
bool model_import_run(model_import *out, const char *path, uint64_t weight, model_fault *fault);
void model_import_end(model_import *import);

#endif
